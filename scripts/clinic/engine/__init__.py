"""MuJoCo and scripts run: a model's or script's text goes in; compiled models, runs, signals and images come out.

It may import `record`.
"""
