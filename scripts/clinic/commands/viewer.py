"""A variant in MuJoCo's own viewer, started as the record's run starts it."""

from __future__ import annotations

import os
import sys

import mujoco

from clinic.engine.simulate import compile_model, controls, data_at
from clinic.engine.variant import variants
from clinic.proof.model_problems import check_against_model
from clinic.record.case import Case
from clinic.record.problem import CaseError, MissingRequirementError, listed


def open_viewer(case: Case, variant_id: str) -> None:
    """Opens the viewer and returns when its window is closed.

    Raises:
        CaseError: If the case has no model, or no such variant.
        MissingRequirementError: If there is no display.
    """
    model, data = scene(case, variant_id)
    if sys.platform == "linux" and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        needed = "a desktop session (DISPLAY or WAYLAND_DISPLAY)"
        raise MissingRequirementError(f"no display here: MuJoCo's viewer needs {needed}")
    import mujoco.viewer

    mujoco.viewer.launch(model, data)


def scene(case: Case, variant_id: str) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """The variant's model, and its data at the start of the run with the controls of that moment.

    Raises:
        CaseError: If the case has no model, or no such variant, or cannot be run.
    """
    run = case.record.run
    if run is None:
        raise CaseError([case.problem(("script",), "a script", "a case with a model", f"read {case.record.source}")])
    check_against_model(case)
    texts = {variant.id: variant.text for variant in variants(case)}
    if variant_id not in texts:
        expected = f"a variant: {listed(texts, 30)}"
        raise CaseError([case.problem(("fixes",), f"no variant {variant_id}", expected, "name one of these")])
    model = compile_model(texts[variant_id])
    data = data_at(model, run, 0)
    controls(model, run, 1)(data, 0)
    return model, data
