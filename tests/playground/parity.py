"""Runs every variant of the cases named as arguments in this process's MuJoCo; prints what was measured as JSON.

Each argument is a playground file, which may hold repairs to judge. Images are left out, as is most of what would be
judged by images: drawing them is not the engine's work. What this MuJoCo reads in a model is told as well.
"""

from __future__ import annotations

import json
import math
import re
import sys
from dataclasses import asdict
from pathlib import Path
from typing import Any

import mujoco
from clinic.engine.checks import TAKES, judge, take
from clinic.engine.measure import measure_model
from clinic.engine.simulate import compile_model
from clinic.engine.variant import apply_edits
from clinic.proof.judge import judge_text
from clinic.record.case import load_case
from clinic.record.parts import Edit
from clinic.record.signal import RowSignal, StartsSignal

IMAGES = 3  # every how many repairs of a case with images are judged


def plain(value: float) -> float | None:
    return value if math.isfinite(value) else None


def measured(root: Path, playground: dict[str, Any]) -> dict[str, Any]:
    case = load_case(root / "cases" / playground["case"])
    record = case.record
    assert record.run is not None
    remedies = [{"id": "broken", "edits": []}, *playground["fixes"], *playground["refuted"]]
    wanted = [name for name, signal in record.signals.items() if not isinstance(signal, RowSignal)]
    found: dict[str, Any] = {}
    for remedy in remedies:
        text = apply_edits(playground["text"], [Edit(**edit) for edit in remedy["edits"]])
        if newer(remedy.get("needs")):
            continue
        run, traces = measure_model(record, compile_model(text), record.run, wanted)
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
    repairs = list(playground["repairs"].items())
    for name, text in repairs[:: 1 if len(wanted) == len(record.signals) else IMAGES]:
        found[name] = asdict(judge_text(case, text))
    return found


def newer(release: str | None) -> bool:
    """Whether a release came after this MuJoCo."""
    here, there = (tuple(map(int, each.split(".")))[:2] for each in (mujoco.__version__, release or "0.0"))
    return there > here


def schema() -> list[str]:
    """The elements that this MuJoCo reads, and each one's attributes as `element.attribute`."""
    known, element = set(), ""
    for line in mujoco.mj_printSchema(False, True).splitlines():
        if named := re.match(r"\s*(\w+) \([!*?R]\)", line[:30]):
            element = named[1]
            known.add(element)
        known |= {f"{element}.{attribute}" for attribute in line[30:].split()}
    return sorted(known)


if __name__ == "__main__":
    root, *files = map(Path, sys.argv[1:])
    records = [json.loads(file.read_text(encoding="utf-8")) for file in files]
    cases = {record["case"]: measured(root, record) for record in records}
    print(json.dumps({"engine": mujoco.__version__, "cases": cases, "schema": schema()}))
