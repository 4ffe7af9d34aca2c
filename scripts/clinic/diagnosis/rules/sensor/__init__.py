"""Rules about sensors and cameras."""
