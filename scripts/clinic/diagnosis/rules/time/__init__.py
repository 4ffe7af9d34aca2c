"""Rules about time: the timestep and the integrator."""
