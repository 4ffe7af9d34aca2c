"""The JSON Schema of `case.yaml`, made from the record's classes, for editors and other programs."""

from __future__ import annotations

import json
from functools import lru_cache
from pathlib import Path
from typing import Any

from pydantic.json_schema import GenerateJsonSchema
from pydantic_core.core_schema import DictSchema

from clinic.record.fields import Record

FILE = "case.schema.json"
MODELINE = f"# yaml-language-server: $schema=../../{FILE}"
"""The first line of a `case.yaml`. The same address holds in the checkout and on the site."""
SOURCES: tuple[dict[str, Any], ...] = (
    {"required": ["model", "run"], "not": {"required": ["script"]}},
    {"required": ["script"], "not": {"anyOf": [{"required": ["model"]}, {"required": ["run"]}]}},
)
"""The two kinds of record, of which exactly one applies."""


class _Generator(GenerateJsonSchema):
    """Leaves out titles, which would repeat the fields' names, and refuses keys of none of the forms given."""

    def field_title_should_be_set(self, schema: Any) -> bool:
        return False

    def dict_schema(self, schema: DictSchema) -> dict[str, Any]:
        made = super().dict_schema(schema)
        return made | {"additionalProperties": False} if "patternProperties" in made else made


def schema() -> dict[str, Any]:
    """The schema, in draft 2020-12."""
    made = Record.model_json_schema(schema_generator=_Generator)
    return {"$schema": _Generator.schema_dialect, **made, "title": "The record of a case", "oneOf": list(SOURCES)}


@lru_cache
def schema_text() -> str:
    """The schema as the text of its file."""
    return json.dumps(schema(), indent=1, ensure_ascii=False) + "\n"


def write_schema(root: Path) -> None:
    """Writes the schema into the checkout, where the modelines of `cases/` find it; git ignores it."""
    (root / FILE).write_text(schema_text(), encoding="utf-8")
