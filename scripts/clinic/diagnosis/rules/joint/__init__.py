"""Rules about joints: ranges, axes, springs, the start; and about tendons and couplings."""
