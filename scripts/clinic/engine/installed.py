"""Which release of MuJoCo is installed, asked without importing it: that takes a quarter of a second."""

from __future__ import annotations

from importlib.metadata import version

OLDEST = (3, 4)  # the first release on which a reader's model can be examined
NEEDED_BY_CASES = (4, 0)  # the release for which the cases are written


def installed() -> tuple[int, int]:
    """The release of MuJoCo that is installed, as (major, minor)."""
    major, minor = version("mujoco").split(".")[:2]
    return int(major), int(minor)


def too_old() -> str:
    """Why a reader's model cannot be examined on the release that is installed; empty if it can."""
    needed = ".".join(map(str, OLDEST))
    told = f"MuJoCo {version('mujoco')} is too old; this needs {needed} or newer: pip install -U mujoco"
    return told if installed() < OLDEST else ""
