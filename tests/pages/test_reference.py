"""The record's reference, made from the fields' descriptions."""

from __future__ import annotations

import re

import pytest
from clinic.engine.signals import KINDS
from clinic.pages.reference import chapters, reference
from clinic.record import fields as record
from clinic.record import parts as record_parts
from clinic.record import sweep as record_sweep
from pydantic import BaseModel

CELLS = re.compile(r"(?<!\\)\|")


@pytest.fixture(scope="module")
def text() -> str:
    return reference()


@pytest.fixture(scope="module")
def rows(text: str) -> dict[str, list[list[str]]]:
    """The cells of every row of every chapter's table."""
    made = {}
    for chapter in text.split("### ")[1:]:
        title, _, body = chapter.partition("\n")
        lines = [line for line in body.splitlines() if line.startswith("| `")]
        made[title] = [[cell.strip() for cell in CELLS.split(line)[1:-1]] for line in lines]
    return made


def test_every_field_of_every_class_has_its_row(rows: dict[str, list[list[str]]]) -> None:
    for title, model in chapters().items():
        assert [row[0].strip("`") for row in rows[title]] == list(model.model_fields)


def test_every_class_of_the_record_has_a_chapter() -> None:
    classes = {
        made
        for module in (record, record_parts, record_sweep)
        for made in vars(module).values()
        if isinstance(made, type) and issubclass(made, BaseModel) and made is not BaseModel
    }
    parents = {parent for made in classes for parent in made.__mro__[1:]}
    assert classes - parents - set(chapters().values()) == set()


def test_rows_are_tables_of_three_cells(rows: dict[str, list[list[str]]]) -> None:
    assert [row for chapter in rows.values() for row in chapter if len(row) != 3] == []


def test_every_field_has_a_meaning_and_a_type_in_words(rows: dict[str, list[list[str]]]) -> None:
    for chapter in rows.values():
        for name, kind, meaning in chapter:
            assert meaning.removeprefix("**required.**").strip(), name
            assert not re.search(r"Annotated|FieldInfo|pattern|0x|<|\$'", kind), f"{name}: {kind}"
            assert kind.count("[") == kind.count("]"), f"{name}: {kind}"


@pytest.mark.parametrize(
    ("chapter", "field", "required"),
    [
        ("Record", "title", True),
        ("Record", "see", False),
        ("RunSpec", "duration", True),
        ("RunSpec", "keyframe", False),
        ("Edit", "replace", True),
    ],
)
def test_required_fields_say_so(rows: dict[str, list[list[str]]], chapter: str, field: str, required: bool) -> None:
    (meaning,) = (row[2] for row in rows[chapter] if row[0] == f"`{field}`")
    assert meaning.startswith("**required.** ") is required


def test_signal_paths_are_explained(text: str) -> None:
    explained = text.split("### Signal paths")[1]
    assert [kind for kind in (*KINDS, "warning", "contact", "printed") if kind not in explained] == []
