"""What pydantic finds wrong with a record, in the author's words and with the file's lines."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from typing import Any, get_args

from pydantic import BaseModel
from pydantic_core import ErrorDetails

from clinic.record.fields import Record
from clinic.record.problem import Problem, closest, listed
from clinic.record.yaml_lines import Lines, Where, dotted

EXPECTED = {
    "int_type": "a whole number",
    "int_from_float": "a whole number",
    "float_type": "a number",
    "string_type": "text",
    "list_type": "a list",
    "dict_type": "a mapping",
    "model_type": "a mapping",
}
PATTERNS = {
    "^[a-z][a-z0-9]*(?:-[a-z0-9]+)*$": "lower-case words joined by hyphens",
    "^[a-z][a-z0-9_]*$": "a lower-case word; underscores allowed",
    "^[A-Za-z0-9_-]+\\.(?:csv|json|mjs|py|txt|xml|yaml)$": "a name with .csv, .json, .mjs, .py, .txt, .xml or .yaml",
    "^[A-Za-z0-9_/]+\\.html(?:#[a-z0-9-]+)?$": "a page of the manual, as XMLreference.html#body-geom-contype",
}


def field_problems(file: str, lines: Lines, errors: Sequence[ErrorDetails], data: Any) -> Iterator[Problem]:
    """What pydantic found wrong with a record."""
    for error in errors:
        where, kind = _where(error["loc"], data)
        if error["type"] == "missing" and isinstance(error["loc"][-1], str):
            where = (*where, error["loc"][-1])
        yield Problem(file, lines.at(where), dotted(where), *_explained(error, where, kind))


def _where(loc: Where, data: Any) -> tuple[Where, str]:
    """The part of pydantic's location that stands in the file, and the last that does not: the class of a signal."""
    where: Where = ()
    kind = ""
    for part in loc:
        known = data if isinstance(data, dict) else dict(enumerate(data)) if isinstance(data, list) else {}
        if part in known:
            data, where = known[part], (*where, part)
        else:
            kind = str(part)
    return where, kind


def _explained(error: ErrorDetails, where: Where, kind: str) -> tuple[str, str, str]:
    """What was found, what was expected, and the repair."""
    said, details = error["type"], error.get("ctx", {})
    found = json.dumps(error["input"], default=str, ensure_ascii=False)
    found = found if len(found) <= 60 else found[:57] + "..."
    if said == "value_error":
        found, expected, repair = str(details["error"]).rsplit("||", 2)
        return found, expected, repair
    if said == "extra_forbidden":
        known = list(_model_at(where[:-1], kind).model_fields)
        guess = closest(str(where[-1]), known)
        repair = f"write `{guess}`" if guess else "remove the key"
        return f"the unknown key `{where[-1]}`", f"one of {listed(known, 30)}", repair
    if said == "missing" and isinstance(error["loc"][-1], str):
        return "nothing", f"the field `{where[-1]}`", f"add `{where[-1]}:`"
    if said.startswith("union_tag"):
        sources = "one of `path`, `expr`, `measure: fraction_of_starts`, `measure: image_row`"
        return found, sources, "say where the number comes from"
    if error["input"] is None:
        return "nothing", "a value", "write one, or remove the key"
    if said == "string_pattern_mismatch":
        return found, PATTERNS.get(details["pattern"], "text that is not empty"), "correct the value"
    if where[:2] == ("run", "ctrl"):
        return found, "a number, or a list of [time, value] pairs", "correct the value"
    if said in ("missing", "too_long") and error["loc"][-1] != where[-1]:
        return found, "two numbers", "correct the value"
    quoted = EXPECTED.get(said, "").endswith("number") and isinstance(error["input"], str)
    expected = EXPECTED.get(said) or error["msg"].replace("Input should be ", "").partition(" after")[0]
    return found, expected, "write its digits, without quotes" if quoted else "correct the value"


def _model_at(where: Where, kind: str) -> type[BaseModel]:
    """The class of the mapping at `where`; of several the one that `kind` names."""
    models: list[type[BaseModel]] = [Record]
    for part in where:
        fields = [model.model_fields[part] for model in models if part in model.model_fields]
        models = [inner for field in fields for inner in _models(field.annotation)] or models
    return next((model for model in models if model.__name__ == kind), models[0])


def _models(annotation: Any) -> Iterator[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for part in get_args(annotation):
        yield from _models(part)
