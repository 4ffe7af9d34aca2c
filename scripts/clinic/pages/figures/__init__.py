"""Figures: a case and its evidence go in; plots, stills and films come out, as files.

It may import `record`, `engine`, `work`, `proof` and `triage`; what a figure shows depends on nothing else.
"""
