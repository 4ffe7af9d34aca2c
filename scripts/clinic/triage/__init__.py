"""Triage that runs: six steps on a model, cheapest first, each of which says what it saw.

run      the model with its start and controls, recorded under a budget of time
watch    the one run that most steps look at
model, scene, motion, reduce   what the steps look for
steps    the six steps, on a case or on any model file
table    the steps against all cases, for the page
"""
