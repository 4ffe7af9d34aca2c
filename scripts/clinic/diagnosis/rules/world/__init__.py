"""Rules about what is around the model: gravity, the medium, switches, memory."""
