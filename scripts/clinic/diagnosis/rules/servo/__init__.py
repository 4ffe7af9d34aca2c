"""Rules about actuators: gains, ranges, gears; rotors and muscles too."""
