"""The MuJoCo Debugging Clinic: broken simulations that prove themselves."""
