"""Whether a text compiles at all."""

from __future__ import annotations

from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe


def _compiles(simulation: Simulation) -> float:
    return 0.0


COMPILES = Probe("MuJoCo refuses it", "errors", _compiles, dynamic=False)  # infinite where it does not compile
