"""Rules about contacts: whether things touch, and how."""
