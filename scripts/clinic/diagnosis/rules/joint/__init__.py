"""Rules about joints: ranges, axes, springs and the start."""
