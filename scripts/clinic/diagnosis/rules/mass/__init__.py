"""Rules about mass and inertia."""
