"""MuJoCo and scripts run: a model's or script's text goes in; compiled models, runs, signals and images come out.

It may import `record`.
"""

import mujoco

from clinic.engine.releases import OLDEST, installed

if installed() < OLDEST:
    needed = ".".join(map(str, OLDEST))
    raise ImportError(f"MuJoCo {mujoco.__version__} is too old; this needs {needed} or newer: pip install -U mujoco")
