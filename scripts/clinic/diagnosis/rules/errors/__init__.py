"""Rules about texts that do not compile: each has the edit that mends it."""
