"""A reader's model in six steps, cheapest first: a model with its start goes in, what each step saw comes out.

It may import `record`, `engine`, `work` and `proof`.

run, watched_run   the model with its start and controls, recorded; the one run that most steps look at
model, scene, motion, reduce   what the steps look for
steps, child   the six steps, on a case or on any model file; the same in a process of its own
table   the steps against all cases, for the page
"""
