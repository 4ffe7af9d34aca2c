"""What pydantic finds wrong with a record, in the author's words and with the file's lines."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Sequence
from typing import Any

from pydantic import BaseModel
from pydantic_core import ErrorDetails

from clinic.record import fields as schema
from clinic.record import parts as record_parts
from clinic.record import sweep as record_sweep
from clinic.record.problem import Problem, closest, listed
from clinic.record.yaml_lines import Lines, Where, dotted

SIGNALS: dict[str, type[BaseModel]] = {
    "path": schema.PathSignal,
    "expr": schema.ExpressionSignal,
    "fraction_of_starts": schema.StartsSignal,
    "image_row": schema.RowSignal,
}
MODELS: dict[str | int, type[BaseModel]] = {
    "run": schema.RunSpec,
    "checks": schema.Checks,
    "broken": schema.Check,
    "fixed": schema.Check,
    "holds": schema.Check,
    "fixes": schema.Fix,
    "refuted": schema.Refuted,
    "edits": record_parts.Edit,
    "picture": schema.Picture,
    "vary": record_sweep.Parameter,
    "outcome": record_parts.Taken,
    "prediction": record_sweep.Prediction,
    "rivals": record_sweep.Rival,
    "sweep": record_sweep.Sweep,
    "film": schema.Film,
    "alike": schema.Alike,
}
EXPECTED = {
    "int_type": "a whole number",
    "int_from_float": "a whole number",
    "float_type": "a number",
    "string_type": "text",
    "list_type": "a list",
    "dict_type": "a mapping",
    "model_type": "a mapping",
    "model_attributes_type": "a mapping",
    "too_short": "{min_length} or more items",
    "too_long": "{max_length} items at most",
    "string_too_short": "text that is not empty",
    "greater_than": "a number greater than {gt:g}",
    "greater_than_equal": "a number of {ge:g} or more",
    "less_than_equal": "a number of {le:g} at most",
    "literal_error": "{expected}",
}
NUMBER = re.compile(r"(?P<whole>[-+]?\d+(?:\.\d*)?)(?:[eE](?P<power>[-+]?\d+))?")
PATTERNS = {
    "^[a-z][a-z0-9]*(?:-[a-z0-9]+)*$": "lower-case words joined by hyphens",
    "^[a-z][a-z0-9_]*$": "a lower-case word; underscores allowed",
    "^[A-Za-z0-9_-]+\\.(?:csv|json|mjs|py|txt|xml|yaml)$": "a name with .csv, .json, .mjs, .py, .txt, .xml or .yaml",
    "^[A-Za-z0-9_/]+\\.html(?:#[a-z0-9-]+)?$": "a page of the manual, as XMLreference.html#body-geom-contype",
}


def field_problems(file: str, lines: Lines, errors: Sequence[ErrorDetails], data: Any) -> Iterator[Problem]:
    """What pydantic found wrong with a record, one problem a place."""
    seen: set[Where] = set()
    for error in errors:
        where, tag = _where(error["loc"], data)
        if error["type"] == "missing" and isinstance(error["loc"][-1], str):
            where = (*where, error["loc"][-1])
        if where in seen:
            continue
        seen.add(where)
        found, expected, repair = _explained(error, where, tag)
        yield Problem(file, lines.at(where), dotted(where), found, expected, repair)


def _where(loc: Where, data: Any) -> tuple[Where, str]:
    """The part of pydantic's location that stands in the file, and the last part that does not."""
    where: Where = ()
    tag = ""
    for position, part in enumerate(loc):
        union = loc[0] == "signals" and position == 2  # pydantic's tag for the kind of signal; no file holds it
        known = isinstance(data, dict) and part in data
        if not union and (known or (isinstance(data, list) and isinstance(part, int) and part < len(data))):
            data, where = data[part], (*where, part)
        else:
            tag = str(part)
    return where, tag


def _explained(error: ErrorDetails, where: Where, tag: str) -> tuple[str, str, str]:
    message = str(error.get("ctx", {}).get("error", error["msg"]))
    match error["type"]:
        case "value_error" if message.count("||") == 2:
            found, expected, repair = message.split("||")
            return found, expected, repair
        case "extra_forbidden":
            known = list(_model_at(where[:-1], tag).model_fields)
            guess = closest(str(where[-1]), known)
            repair = f"write `{guess}`" if guess else "remove the key"
            return f"the unknown key `{where[-1]}`", f"one of {listed(known, 30)}", repair
        case "missing" if isinstance(error["loc"][-1], int):
            return _shown(error["input"]), "two numbers", "correct the value"
        case "missing":
            return "nothing", f"the field `{where[-1]}`", f"add `{where[-1]}:`"
        case "union_tag_not_found" | "union_tag_invalid":
            return (
                _shown(error["input"]),
                "one of `path`, `expr`, `measure: fraction_of_starts`, `measure: image_row`",
                "say where the number comes from",
            )
        case "string_pattern_mismatch":
            wanted = PATTERNS.get(error["ctx"]["pattern"])
            return (
                _shown(error["input"]),
                wanted or EXPECTED["string_too_short"],
                "rename it" if wanted else "correct the value",
            )
    if error["input"] is None:
        return "nothing", "a value", "write one, or remove the key"
    if where[:2] == ("run", "ctrl"):
        expected = "a number, or a list of [time, value] pairs"
    else:
        words = EXPECTED.get(error["type"])
        expected = words.format(**error.get("ctx", {})) if words else message[0].lower() + message[1:]
    repair = "correct the value"
    if error["type"] in ("int_type", "float_type") and (number := NUMBER.fullmatch(str(error["input"]))):
        whole, power = number["whole"], number["power"]
        repair = (
            f"write {whole if '.' in whole else whole + '.0'}e{int(power):+d}" if power else "write it without quotes"
        )
    return _shown(error["input"]), expected, repair


def _model_at(where: Where, tag: str) -> type[BaseModel]:
    """The class of the mapping at `where`."""
    if len(where) == 2 and where[0] == "signals":
        return SIGNALS[tag]
    if where[:1] == ("sweep",) and where[-1] == "holds":
        return record_sweep.Side
    for part in reversed(where):
        if part in MODELS:
            return MODELS[part]
    return schema.Record


def _shown(value: Any) -> str:
    text = json.dumps(value, default=str, ensure_ascii=False)
    return text if len(text) <= 60 else text[:57] + "..."
