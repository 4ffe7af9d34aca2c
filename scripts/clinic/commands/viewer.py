"""A variant in MuJoCo's own viewer, started as the record's run starts it."""

from __future__ import annotations

import os
import sys

import mujoco

from clinic.engine.simulate import captured_messages, compile_model, controls, initial_data
from clinic.engine.variant import BROKEN, variants
from clinic.proof.examine import examine
from clinic.record.case import Case
from clinic.record.checkout import nearest
from clinic.record.problem import CaseError, LackError, listed


def view(case: Case, variant_id: str = BROKEN) -> None:
    """Opens the viewer and returns when its window is closed.

    Raises:
        CaseError: If the case has no model, or no such variant.
        LackError: If no window can be opened here.
    """
    model, data = scene(case, variant_id)
    if sys.platform == "linux" and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        raise LackError("no display here: MuJoCo's viewer needs a desktop session (DISPLAY or WAYLAND_DISPLAY)")
    import mujoco.viewer

    try:
        mujoco.viewer.launch(model, data)
    except mujoco.FatalError as error:
        raise LackError(f"MuJoCo's viewer does not open: {error}") from None


def scene(case: Case, variant_id: str) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """The variant's model, and its data at the start of the run with the controls of that moment.

    Raises:
        CaseError: If the case has no model, or no such variant, or cannot be run.
    """
    record = case.record
    if record.run is None:
        found, expected = f"a bug in {record.source}, a script", "a case with a model"
        raise CaseError([case.problem(("script",), found, expected, f"read it in cases/{case.slug}/")])
    examine(case)
    made = {variant.id: variant for variant in variants(case)}
    if variant_id not in made:
        near = nearest(variant_id, made)
        repair = f"write {' or '.join(near)}" if near else "leave `--fix` out for the broken model"
        raise CaseError(
            [case.problem(("fixes",), f"no variant {variant_id}", f"a variant: {listed(made, 30)}", repair)]
        )
    model = compile_model(made[variant_id].text)
    data = initial_data(model, record.run)
    controls(model, record.run, 1).apply(data, 0)
    with captured_messages():
        mujoco.mj_forward(model, data)
    return model, data
