"""What the playground in the browser needs to run and judge a case: `playground.json`, one file a case.

The browser and the tests of its modules read the same file; its types are in `docs/playground/record/types.js`.
"""

from __future__ import annotations

import json
import re
from collections.abc import Container, Iterable
from typing import Any

import mujoco
import numpy as np

from clinic.engine.mjcf import release_needed
from clinic.engine.signals import Path, parse_path
from clinic.engine.simulate import compile_model
from clinic.engine.variant import apply_edits
from clinic.pages.judging import guards, why
from clinic.pages.script_playground import script_playground
from clinic.pages.text.claim import claim
from clinic.proof.evidence import Evidence
from clinic.record.case import Case
from clinic.record.expression import names, parse
from clinic.record.fields import Remedy, Trial
from clinic.record.signal import ExpressionSignal, PathSignal, Signal

FILE = "playground.json"
MOTION = re.compile(r"^(?!model\.).*\b(?:xpos|xquat|xmat|xipos|qpos|qvel|cvel)\b")


def playground(case: Case, cases: Iterable[Case], evidence: Evidence | None = None) -> bytes | None:
    """The file of a case.

    Args:
        case: The case.
        cases: All, for those that name a MuJoCo warning explain it.
        evidence: What was measured; without it nothing is told of what a check guards and why a remedy does not help.

    Returns:
        None for a script that the page can do nothing with.
    """
    record = case.record
    if record.model is None:
        return script_playground(case, evidence)
    assert record.run is not None
    seen = _seen(case)
    made: dict[str, Any] = {
        "case": case.slug,
        "number": record.number,
        "title": record.title,
        "engine": mujoco.__version__,
        "name": record.model,
        "text": case.text,
        "run": record.run.model_dump(mode="json"),
        "signals": {
            name: _signal(case, name, signal) | {"seen": name in seen} for name, signal in record.signals.items()
        },
        "checks": record.checks.model_dump(mode="json", exclude_none=True),
        "trials": [_trial(case, trial) for trial in record.trials],
        "task": record.task.model_dump(mode="json"),
        "fixes": [_remedy(case, remedy) for remedy in record.fixes],
        "refuted": [
            _remedy(case, remedy) | {"why": why(case, remedy, evidence) if evidence else ""}
            for remedy in record.refuted
        ],
        "guards": guards(case, evidence) if evidence else [],
        "camera": record.picture.camera,
        "speed": record.filmed.speed if record.filmed else 1.0,
        "telling": record.filmed.overlays if record.filmed else [],
        "hints": _hints(case),
        "explained": _explained(other for other in cases if other.slug != case.slug),
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
    """The symptom in numbers, what to measure, what that gives; the last rung is the page's Diagnosis.

    The first tells what is seen, and no cause: what moves, and nothing that moves it.
    """
    record, read, seen = case.record, set[str](), _seen(case)
    for check in [*record.checks.broken, *record.checks.fixed]:
        signal = record.signals[check.signal]
        read |= names(parse(signal.expr)) if isinstance(signal, ExpressionSignal) else {check.signal}
    measured = [
        (signal.label or name) + (f", {signal.path}" if isinstance(signal, PathSignal) else "")
        for name, signal in record.signals.items()
        if name in read
    ]
    hints = [
        ("The symptom in numbers", _claims(case, seen)),
        ("What to measure", f"after every step, {'; '.join(measured)}."),
        ("What it gives", _claims(case, set(record.signals))),
    ]
    return [{"title": title, "text": text} for title, text in hints if text]


def _claims(case: Case, signals: Container[str]) -> str:
    """What the checks over these signals say of the broken model and of a repaired one."""
    told = []
    for word, (_, checks) in zip(("as it is", "repaired"), case.record.checks, strict=True):
        if claims := [claim(case, check) for check in checks if check.signal in signals]:
            told.append(f"{word}, {'; '.join(claims)}.")
    return " ".join(each if k == 0 else each[0].upper() + each[1:] for k, each in enumerate(told))


def _seen(case: Case) -> set[str]:
    """The signals that tell what is seen rather than why: the one that is plotted, and what moves."""
    signals = case.record.signals
    seen = {next(iter(signals))}
    seen |= {name for name, one in signals.items() if isinstance(one, PathSignal) and MOTION.search(one.path)}
    computed = {name: names(parse(one.expr)) for name, one in signals.items() if isinstance(one, ExpressionSignal)}
    return seen | {name for name, read in computed.items() if read <= seen}


def _explained(cases: Iterable[Case]) -> dict[str, list[dict[str, str]]]:
    """The pages of the cases that raise a warning, by warning; addresses as seen from a case's page."""
    made: dict[str, list[dict[str, str]]] = {}
    for case in cases:
        for name in case.record.warnings:
            page = {"href": f"../{case.slug}/index.html", "title": case.record.heading}
            made.setdefault(name, []).append(page)
    return made
