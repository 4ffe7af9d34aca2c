"""Rules about actuators: gains, ranges, gears."""
