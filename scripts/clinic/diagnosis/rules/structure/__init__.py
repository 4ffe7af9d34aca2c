"""Rules about what hangs on what: bodies, free joints, loops."""
