"""The solver's options: whether it may stop early, and what MuJoCo's own are."""

from __future__ import annotations

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.reader_model import ReaderModel

USUAL = {"iterations": 100.0, "ls_iterations": 50.0, "tolerance": 1e-8}
FEW = {"iterations": 50.0, "ls_iterations": 20.0}
LOOSE = 1e-5


def early(model: ReaderModel) -> dict[str, float]:
    """The options by which the solver stops earlier than by MuJoCo's own, with their values."""
    now = {name: model.simulation.model(f"opt.{name}")[0] for name in USUAL}
    return {name: value for name, value in now.items() if (value > LOOSE if name == "tolerance" else value < FEW[name])}


def patient(model: ReaderModel) -> tuple[Edit, ...]:
    """The edits that give those options MuJoCo's own values."""
    return tuple(edit for name in early(model) for edit in model.option(name, f"{USUAL[name]:g}"))
