"""Robustness: whether a verdict outlasts a longer run, other starts, and other timesteps."""

from __future__ import annotations

from copy import copy
from functools import partial
from typing import Literal

import mujoco
import numpy as np

from clinic.engine.checks import judge
from clinic.engine.measure import measure_model
from clinic.engine.simulate import Nudge, compile_model
from clinic.engine.variant import variants
from clinic.record.case import Case
from clinic.record.fields import Record
from clinic.record.parts import Check, Strict
from clinic.record.signal import ExpressionSignal, PathSignal

STARTS = 8
NUDGE = 1e-3
SHRINK = (0.5, 0.05)
LONGER = 10.0
SEED = 20

Outcome = Literal["broken", "well", "neither"]


class Robustness(Strict):
    """How firmly a variant's verdict stands.

    Attributes:
        runs: How many runs were made from other starts: STARTS with the timestep as it is and, but for a refuted
            remedy, whose point its timestep may be, STARTS with half of it.
        same: How many of them gave the verdict of the unchanged run.
        longer: For a fix: whether it still holds after LONGER times its duration.
        shrunk: For the broken variant: the outcome at each share SHRINK of the timestep, from the unchanged start.
    """

    runs: int
    same: int
    longer: bool | None
    shrunk: dict[str, Outcome]


def robustness(case: Case) -> dict[str, Robustness]:
    """The robustness of every variant of a model case, by variant.

    Only checks of signals that a single run gives are asked; a fraction over starts is a spread of its own.
    """
    record = case.record
    made: dict[str, Robustness] = {}
    for variant in variants(case):
        model, refuted = compile_model(variant.text), variant.kind == "refuted"
        unchanged = outcome(record, model)
        rng = np.random.default_rng(SEED)
        nudges = [partial(nudge_by, *rng.uniform(-NUDGE, NUDGE, (2, model.nv))) for _ in range(STARTS)]
        seen = [outcome(record, model, shrink, nudge=n) for shrink in ((1,) if refuted else (1, 0.5)) for n in nudges]
        made[variant.id] = Robustness(
            runs=len(seen),
            same=sum((s == "well") == (unchanged == "well") if refuted else s == unchanged for s in seen),
            longer=outcome(record, model, longer=LONGER) == "well" if variant.kind == "fix" else None,
            shrunk={f"{s:g}": outcome(record, model, s) for s in SHRINK if variant.kind == "broken"},
        )
    return made


def outcome(
    record: Record, model: mujoco.MjModel, shrink: float = 1, longer: float = 1, nudge: Nudge | None = None
) -> Outcome:
    """What one run shows: `well` if every fixed check holds, `broken` if every broken one does.

    Args:
        shrink: What the model's timestep is multiplied by, for this run.
        longer: What the run's duration is multiplied by.
        nudge: Changes the start.
    """
    assert record.run is not None
    spec = record.run.model_copy(update={"duration": record.run.duration * longer})
    model = copy(model)
    model.opt.timestep *= shrink
    checked = {check.signal for check in record.checks.broken + record.checks.fixed}
    single = [n for n, s in record.signals.items() if n in checked and isinstance(s, PathSignal | ExpressionSignal)]
    _, traces = measure_model(record, model, spec, single, nudge)

    def all_hold(checks: list[Check]) -> bool:
        return all(judge(check, traces).holds for check in checks if check.signal in traces)

    if all_hold(record.checks.fixed):
        return "well"
    return "broken" if all_hold(record.checks.broken) else "neither"


def nudge_by(position: np.ndarray, velocity: np.ndarray, model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """Moves the start by `position` and `velocity`, each shape (nv,), in m or rad, m/s or rad/s."""
    mujoco.mj_integratePos(model, data.qpos, position, 1.0)
    data.qvel += velocity
