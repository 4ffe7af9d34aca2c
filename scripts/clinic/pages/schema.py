"""The JSON Schema of `case.yaml`, made from the record's classes, for editors and other programs."""

from __future__ import annotations

import json
import os
from functools import lru_cache
from pathlib import Path
from typing import Any

from pydantic.json_schema import GenerateJsonSchema

from clinic.record.fields import Record

FILE = "case.schema.json"
MODELINE = f"# yaml-language-server: $schema=../../{FILE}"
"""The first line of a `case.yaml`. The same address holds in the checkout and on the site."""
SOURCES: tuple[dict[str, Any], ...] = (
    {"required": ["model", "run"], "not": {"required": ["script"]}},
    {"required": ["script"], "not": {"anyOf": [{"required": ["model"]}, {"required": ["run"]}]}},
)
"""The two kinds of record, of which exactly one applies."""


class Plain(GenerateJsonSchema):
    """Without titles, which would repeat the fields' names."""

    def field_title_should_be_set(self, schema: Any) -> bool:
        """Never."""
        return False


def schema() -> dict[str, Any]:
    """The schema, in draft 2020-12."""
    made = Record.model_json_schema(schema_generator=Plain)
    _close(made)
    return {"$schema": Plain.schema_dialect, **made, "title": "The record of a case", "oneOf": list(SOURCES)}


@lru_cache
def schema_text() -> str:
    """The schema as the text of its file."""
    return json.dumps(schema(), indent=1, ensure_ascii=False) + "\n"


def write_schema(root: Path) -> None:
    """Writes the schema into the checkout, where the modelines of `cases/` find it; git ignores it."""
    text, file = schema_text(), root / FILE
    if file.is_file() and file.read_text(encoding="utf-8") == text:
        return
    part = root / f"{FILE}.{os.getpid()}"
    part.write_text(text, encoding="utf-8")
    os.replace(part, file)


def _close(node: Any) -> None:
    """Refuses, below `node`, keys of mappings that have none of the forms given."""
    if isinstance(node, dict):
        if "patternProperties" in node:
            node["additionalProperties"] = False
        for part in node.values():
            _close(part)
    elif isinstance(node, list):
        for part in node:
            _close(part)
