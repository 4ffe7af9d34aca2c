"""Rules about time: the timestep, the integrator and the solver."""
