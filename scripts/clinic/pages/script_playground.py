"""What the browser needs of a code case: its script to run and judge there, its instrument; `playground.json` too.

Its types are in `docs/playground/script/types.js`.
"""

from __future__ import annotations

import json

from clinic.pages.judging import guards, why
from clinic.proof.evidence import Evidence
from clinic.record.case import Case
from clinic.record.folder import INSTRUMENT

REMEDY = {"id", "title", "edits"}


def script_playground(case: Case, evidence: Evidence | None) -> bytes | None:
    """The file of a case with a script; None for one in Python that has no instrument."""
    record = case.record
    assert record.script is not None
    instrument = case.texts.get(INSTRUMENT)
    if record.language != "javascript" and instrument is None:
        return None
    made = {
        "case": case.slug,
        "title": record.title,
        "language": record.language,
        "name": record.script,
        "text": case.text,
        "files": {name: case.texts[name] for name in record.files},
        "instrument": instrument,
        "signals": {
            name: {**signal.model_dump(mode="json", exclude_none=True, exclude={"said"}), "label": signal.label or name}
            for name, signal in record.signals.items()
        },
        "checks": record.checks.model_dump(mode="json", exclude_none=True),
        "trials": [
            {
                **trial.model_dump(mode="json", include={"title", "file", "edits"}),
                "checks": trial.checks.model_dump(mode="json", exclude_none=True) if trial.checks else {},
            }
            for trial in record.trials
        ],
        "fixes": [remedy.model_dump(mode="json", include=REMEDY) for remedy in record.fixes],
        "refuted": [
            remedy.model_dump(mode="json", include=REMEDY) | {"why": why(case, remedy, evidence) if evidence else ""}
            for remedy in record.refuted
        ],
        "guards": guards(case, evidence) if evidence else [],
    }
    return (json.dumps(made, ensure_ascii=False, allow_nan=False) + "\n").encode()
