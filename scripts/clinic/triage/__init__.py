"""A reader's model in six steps, cheapest first: a model with its start goes in, what each step saw comes out.

It may import `record`, `engine`, `work` and `proof`.

recording   the model with its start and controls, run and recorded; most steps look at one such run
model_rules, scene_rules, motion, switch_off   what the steps look for
steps, process   the six steps, on a case or on any model file; the same in a process of its own
table   the steps against all cases, for the page
"""
