"""Robustness: whether a verdict outlasts a longer run, other starts, and other timesteps."""

from __future__ import annotations

from typing import Literal

import mujoco
import numpy as np
from pydantic import BaseModel, ConfigDict

from clinic.engine.checks import judge
from clinic.engine.measure import measure_model
from clinic.engine.simulate import Nudge, compile_model
from clinic.engine.variant import variants
from clinic.record.case import Case
from clinic.record.fields import Check, ExpressionSignal, PathSignal, Record

STARTS = 8
NUDGE = 1e-3
SHRINK = (0.5, 0.05)
LONGER = 10.0
SEED = 20

State = Literal["broken", "well", "neither"]


class Robustness(BaseModel):
    """How firmly a variant's verdict stands.

    Attributes:
        runs: How many runs were made from other starts: STARTS with the timestep as it is and, but for a refuted
            remedy, whose point its timestep may be, STARTS with half of it.
        same: How many of them gave the verdict of the unchanged run.
        longer: For a fix: whether it still holds after LONGER times its duration.
        shrunk: For the broken variant: the state at each share SHRINK of the timestep, from the unchanged start.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    runs: int
    same: int
    longer: bool | None
    shrunk: dict[str, State]


def robustness(case: Case) -> dict[str, Robustness]:
    """The robustness of every variant of a model case, by variant.

    Only checks of signals that a single run gives are asked; a fraction over starts is a spread of its own.
    """
    record = case.record
    made: dict[str, Robustness] = {}
    for variant in variants(case):
        model = compile_model(variant.text)
        data = mujoco.MjData(model)
        nominal = state(record, model, data)
        rng = np.random.default_rng(SEED)
        nudges = [
            nudged(rng.uniform(-NUDGE, NUDGE, model.nv), rng.uniform(-NUDGE, NUDGE, model.nv)) for _ in range(STARTS)
        ]
        seen = [state(record, model, data, nudge=nudge) for nudge in nudges]
        if variant.kind != "refuted":
            seen += [state(record, model, data, shrink=0.5, nudge=nudge) for nudge in nudges]
        made[variant.id] = Robustness(
            runs=len(seen),
            same=sum((s == "well") == (nominal == "well") if variant.kind == "refuted" else s == nominal for s in seen),
            longer=state(record, model, data, longer=LONGER) == "well" if variant.kind == "fix" else None,
            shrunk={f"{s:g}": state(record, model, data, shrink=s) for s in SHRINK if variant.kind == "broken"},
        )
    return made


def state(
    record: Record,
    model: mujoco.MjModel,
    data: mujoco.MjData,
    shrink: float = 1.0,
    longer: float = 1.0,
    nudge: Nudge | None = None,
) -> State:
    """The verdict of one run, made in `data`: `well` if every fixed check holds, `broken` if every broken one does."""
    assert record.run is not None
    wanted = single_run(record)
    asked = [check for check in record.checks.broken + record.checks.fixed if check.signal in wanted]
    timestep = model.opt.timestep
    model.opt.timestep = timestep * shrink
    try:
        spec = record.run.model_copy(update={"duration": record.run.duration * longer})
        _, traces = measure_model(record, model, spec, wanted, nudge, data, last=all(check.last for check in asked))
    finally:
        model.opt.timestep = timestep

    def all_hold(checks: list[Check]) -> bool:
        return all(judge(check, traces).holds for check in checks if check.signal in traces)

    if all_hold(record.checks.fixed):
        return "well"
    return "broken" if all_hold(record.checks.broken) else "neither"


def single_run(record: Record) -> list[str]:
    """The signals of checks that one run gives."""
    asked = {check.signal for check in record.checks.broken + record.checks.fixed}
    return [n for n, s in record.signals.items() if n in asked and isinstance(s, PathSignal | ExpressionSignal)]


def nudged(position: np.ndarray, velocity: np.ndarray) -> Nudge:
    """A change of the start by `position` and `velocity`, each shape (nv,), in m or rad, m/s or rad/s."""

    def nudge(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        mujoco.mj_integratePos(model, data.qpos, position, 1.0)
        data.qvel += velocity

    return nudge
