"""What can still be judged of a record that has mistakes: the rest of it, so that all that is wrong is told at once."""

from __future__ import annotations

import copy
import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from clinic.record.fields import Record
from clinic.record.problem import Problem
from clinic.record.yaml_lines import Where

PROSE = ("title", "symptom", "diagnosis", "cause", "fix", "lesson")
ENTRIES = ("signals", "sweep", "formulas", "older", "exempt")  # mappings of which one entry can be left out


@dataclass(frozen=True)
class Salvage:
    """The sound part of a record.

    Args:
        record: The record without what is wrong, and with stand-ins for what it must have.
        left_out: Names of fields, and of entries, that are missing or stood in for.
    """

    record: Record
    left_out: frozenset[str]

    def own(self, problems: Iterable[Problem]) -> list[Problem]:
        """Those problems that do not come from what was left out."""
        return [problem for problem in problems if not self._hangs(problem)]

    def _hangs(self, problem: Problem) -> bool:
        top = problem.where.partition(".")[0].partition("[")[0]
        return top in self.left_out or problem.found.partition(",")[0] in self.left_out


def salvage(data: dict[str, Any], errors: Sequence[ErrorDetails]) -> Salvage | None:
    """The sound part of the data of a record, None if too little is left to be judged."""
    made, left_out = copy.deepcopy(data), set[str]()
    for error in errors:
        where: Where = error["loc"]
        if not where:
            return None
        top = str(where[0])
        entry = where[1] if top in ENTRIES and len(where) > 1 else None
        if isinstance(made.get(top), dict) and entry in made[top]:
            del made[top][entry]
        elif entry is None:
            made.pop(top, None)
        left_out.add(top if entry is None else str(entry))
    stand_ins: dict[str, Any] = dict.fromkeys(PROSE, "x") | {"tags": ["x"], "phrases": ["x"]}
    stand_ins["fixes"] = [{"id": "x", "title": "x", "edits": [{"find": "x", "replace": "y"}]}]
    stand_ins["run"] = {"duration": 1} if "model" in made else None
    for check in ("broken", "fixed") if made.get("signals") else ():
        stand_ins.setdefault("checks", {})[check] = [{"signal": next(iter(made["signals"])), "above": 0}]
    made = {name: value for name, value in stand_ins.items() if name in left_out and value is not None} | made
    try:
        return Salvage(Record.model_validate_json(json.dumps(made, default=str)), frozenset(left_out))
    except ValidationError:
        return None
