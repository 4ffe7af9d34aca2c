"""Runs every variant of the cases named as arguments in this process's MuJoCo; prints what was measured as JSON.

Each argument is a playground file. Images are left out: drawing them is not the engine's work.
"""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path
from typing import Any

import mujoco
from clinic.engine.checks import TAKES, judge, take
from clinic.engine.measure import measure_model
from clinic.engine.simulate import compile_model
from clinic.engine.variant import apply_edits
from clinic.record.case import load_case
from clinic.record.fields import Edit, RowSignal, StartsSignal


def plain(value: float) -> float | None:
    return value if math.isfinite(value) else None


def measured(root: Path, playground: dict[str, Any]) -> dict[str, Any]:
    record = load_case(root / "cases" / playground["case"]).record
    assert record.run is not None
    remedies = [{"id": "broken", "edits": []}, *playground["fixes"], *playground["refuted"]]
    wanted = [name for name, signal in record.signals.items() if not isinstance(signal, RowSignal)]
    found = {}
    for remedy in remedies:
        text = apply_edits(playground["text"], [Edit(**edit) for edit in remedy["edits"]])
        try:
            model = compile_model(text)
        except ValueError:  # it needs a newer engine
            continue
        run, traces = measure_model(record, model, record.run, wanted)
        read = [name for name in traces if not isinstance(record.signals[name], StartsSignal)]
        values = {name: [plain(take(traces[name], which)) for which in TAKES] for name in read}
        judged = {
            kind: [judge(check, traces) if check.signal in traces else None for check in checks]
            for kind, checks in (("broken", record.checks.broken), ("fixed", record.checks.fixed))
        }
        found[remedy["id"]] = {"warnings": run.warnings, "values": values} | {
            kind: [made and {"measured": plain(made.measured), "holds": made.holds} for made in verdicts]
            for kind, verdicts in judged.items()
        }
    return found


if __name__ == "__main__":
    root, *files = map(Path, sys.argv[1:])
    records = [json.loads(file.read_text(encoding="utf-8")) for file in files]
    cases = {record["case"]: measured(root, record) for record in records}
    print(json.dumps({"engine": mujoco.__version__, "cases": cases}))
