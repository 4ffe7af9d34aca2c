"""What the playground in the browser needs to run and judge a model case: `playground.json`, one file a case.

The browser and the tests of its modules read the same file; its types are in `docs/playground/record/types.js`.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any

import mujoco
import numpy as np

from clinic.engine.mjcf import release_needed
from clinic.engine.signals import Path, parse_path
from clinic.engine.simulate import compile_model
from clinic.engine.variant import apply_edits
from clinic.pages.text.claim import claim
from clinic.record.case import Case
from clinic.record.expression import names, parse
from clinic.record.fields import ExpressionSignal, PathSignal, Remedy, Signal, Trial

FILE = "playground.json"


def playground(case: Case, cases: Iterable[Case]) -> bytes:
    """The file of a case with a model; `cases` are all, for those that name a MuJoCo warning explain it."""
    record = case.record
    assert record.model is not None
    assert record.run is not None
    made: dict[str, Any] = {
        "case": case.slug,
        "number": record.number,
        "title": record.title,
        "engine": mujoco.__version__,
        "name": record.model,
        "text": case.text,
        "run": record.run.model_dump(mode="json"),
        "signals": {name: _signal(case, name, signal) for name, signal in record.signals.items()},
        "checks": record.checks.model_dump(mode="json", exclude_none=True),
        "trials": [_trial(case, trial) for trial in record.trials],
        "task": record.task.model_dump(mode="json"),
        "fixes": [_remedy(case, remedy) for remedy in record.fixes],
        "refuted": [_remedy(case, remedy) for remedy in record.refuted],
        "camera": record.picture.camera,
        "speed": record.filmed.speed if record.filmed else 1.0,
        "telling": record.filmed.overlays if record.filmed else [],
        "hints": _hints(case),
        "explained": _explained(cases),
    }
    return (json.dumps(made, ensure_ascii=False, allow_nan=False) + "\n").encode()


def _signal(case: Case, name: str, signal: Signal) -> dict[str, Any]:
    made = signal.model_dump(mode="json", exclude_none=True, exclude={"said"})
    made["label"] = signal.label or name
    if isinstance(signal, PathSignal):
        made["columns"] = _columns(parse_path(signal.path), case.text)
    return made


def _remedy(case: Case, remedy: Remedy) -> dict[str, Any]:
    made = remedy.model_dump(mode="json", include={"id", "title", "edits"})
    return {**made, "needs": release_needed(apply_edits(case.text, remedy.edits))}


def _trial(case: Case, trial: Trial) -> dict[str, Any]:
    made = trial.model_dump(mode="json", include={"title", "ctrl", "duration"})
    for name, numbers in (("start", trial.start), ("set", trial.set)):
        made[name] = [
            {"path": path, "columns": _columns(parse_path(path), case.text), "value": value}
            for path, value in numbers.items()
        ]
    return {**made, "checks": trial.checks.model_dump(mode="json", exclude_none=True) if trial.checks else {}}


def _columns(path: Path, xml: str) -> list[int]:
    """The lengths of all dimensions of a plain field but the first: the browser's arrays are flat."""
    if path.kind:
        return []
    model = compile_model(xml)
    value: Any = model if path.model else mujoco.MjData(model)
    for part in path.field.split("."):
        value = getattr(value, part)
    return [int(n) for n in np.shape(value)[1:]]


def _hints(case: Case) -> list[dict[str, str]]:
    """The symptom and its repair in numbers, then what to measure; the third rung is the page's Diagnosis."""
    record, read = case.record, set[str]()
    for check in [*record.checks.broken, *record.checks.fixed]:
        signal = record.signals[check.signal]
        read |= names(parse(signal.expr)) if isinstance(signal, ExpressionSignal) else {check.signal}
    measured = [
        (signal.label or name) + (f", {signal.path}" if isinstance(signal, PathSignal) else "")
        for name, signal in record.signals.items()
        if name in read
    ]
    broken, fixed = ("; ".join(claim(case, check) for check in kind) for _, kind in record.checks)
    return [
        {"title": "The symptom in numbers", "text": f"as it is, {broken}. Repaired, {fixed}."},
        {"title": "What to measure", "text": f"after every step, {'; '.join(measured)}."},
    ]


def _explained(cases: Iterable[Case]) -> dict[str, list[dict[str, str]]]:
    """The pages of the cases that raise a warning, by warning; addresses as seen from a case's page."""
    made: dict[str, list[dict[str, str]]] = {}
    for case in cases:
        for name in case.record.warnings:
            page = {"href": f"../{case.slug}/index.html", "title": case.record.heading}
            made.setdefault(name, []).append(page)
    return made
