"""The record's JSON Schema, asked by a validator that knows nothing of the record's classes."""

from __future__ import annotations

import copy
import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from clinic.pages.schema import FILE, MODELINE, schema, schema_text, write_schema
from clinic.record.yaml_lines import read_yaml
from helpers import RECORD, SCRIPT_RECORD

Change = Callable[[dict[str, Any]], object]


@pytest.fixture(scope="module")
def validator() -> jsonschema.Draft202012Validator:
    jsonschema.Draft202012Validator.check_schema(schema())
    return jsonschema.Draft202012Validator(schema())


def data_of(text: str) -> dict[str, Any]:
    data, _ = read_yaml(text)
    return json.loads(json.dumps(data, default=str))


def errors(validator: jsonschema.Draft202012Validator, data: dict[str, Any]) -> list[str]:
    return [f"{error.json_path}: {error.message}" for error in validator.iter_errors(data)]


def test_every_case_is_valid(slug: str, root: Path, validator: jsonschema.Draft202012Validator) -> None:
    assert errors(validator, data_of((root / "cases" / slug / "case.yaml").read_text(encoding="utf-8"))) == []


@pytest.mark.parametrize("record", [RECORD, SCRIPT_RECORD], ids=["model", "script"])
def test_tiny_records_are_valid(record: str, validator: jsonschema.Draft202012Validator) -> None:
    assert errors(validator, data_of(record)) == []


WRONG: dict[str, Change] = {
    "an unknown key": lambda record: record.update(titel="x"),
    "an unknown key inside": lambda record: record["run"].update(time=1),
    "an unknown key of a signal": lambda record: record["signals"]["height"].update(units="m"),
    "a name that is none": lambda record: record["signals"].update(Height={"path": "ncon"}),
    "text for a number": lambda record: record.update(number="one"),
    "a number for text": lambda record: record.update(title=1),
    "one for a list": lambda record: record.update(tags="contact"),
    "a word that is not known": lambda record: record["checks"]["fixed"][0].update(take="last"),
    "three numbers for two": lambda record: record["checks"]["fixed"][0].update(between=[1, 2, 3]),
    "a field left out": lambda record: record.pop("lesson"),
    "a list that is empty": lambda record: record.update(fixes=[]),
    "model and script": lambda record: record.update(script="script.py"),
    "neither model nor script": lambda record: record.pop("model"),
    "a model that is not run": lambda record: record.pop("run"),
    "an exemption from no law": lambda record: record.update(exempt={"swept": "Because."}),
}


@pytest.mark.parametrize("change", WRONG.values(), ids=WRONG)
def test_mistakes_are_refused(change: Change, validator: jsonschema.Draft202012Validator) -> None:
    record = copy.deepcopy(data_of(RECORD))
    change(record)
    assert errors(validator, record)


def test_fields_are_described_where_an_editor_looks() -> None:
    made = schema()
    parts = [made, *made["$defs"].values()]
    bare = [name for part in parts for name, field in part["properties"].items() if not field.get("description")]
    assert bare == []


def test_the_modeline_finds_the_file_from_a_case_in_the_checkout(tmp_path: Path) -> None:
    (tmp_path / "cases" / "a").mkdir(parents=True)
    (tmp_path / FILE).write_text("{}", encoding="utf-8")
    write_schema(tmp_path)
    match = re.fullmatch(r"# yaml-language-server: \$schema=(\S+)", MODELINE)
    assert match is not None
    assert (tmp_path / "cases" / "a" / match[1]).read_text(encoding="utf-8") == schema_text()
