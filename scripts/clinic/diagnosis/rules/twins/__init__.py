"""Rules about left and right, and other parts that are meant to be alike."""
