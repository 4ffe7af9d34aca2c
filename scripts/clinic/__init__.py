"""The MuJoCo Debugging Clinic: broken simulations that prove themselves."""

import os
import sys
from typing import Any

if sys.platform == "linux":
    os.environ.setdefault("MUJOCO_GL", "egl")  # MuJoCo reads it when it is imported


def __getattr__(name: str) -> Any:
    """`clinic.diagnose`: a reader's model in, its causes out."""
    if name == "diagnose":
        from clinic.diagnosis.process import diagnose

        return diagnose
    raise AttributeError(f"module 'clinic' has no attribute {name!r}")
