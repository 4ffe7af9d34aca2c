"""The MuJoCo Debugging Clinic: broken simulations that prove themselves."""

import os
import sys

if sys.platform == "linux":
    os.environ.setdefault("MUJOCO_GL", "egl")  # MuJoCo reads it when it is imported
