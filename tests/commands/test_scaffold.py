"""The folder of a new case: what it holds, and what is refused."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from clinic.commands.scaffold import MAX_TITLE, Kind, files, free_number, start
from clinic.pages.reference import CHAPTERS
from clinic.pages.schema import MODELINE
from clinic.record.case import load_case
from clinic.record.fields import Record
from clinic.record.problem import CaseError
from helpers import write_case

ELSEWHERE = {"signals: measure: fraction_of_starts", "signals: measure: image_row"}


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    (tmp_path / "cases").mkdir()
    return tmp_path


def problems_of(checkout: Path, slug: str, title: str = "It moves") -> list[tuple[str, str]]:
    with pytest.raises(CaseError) as caught:
        start(checkout, slug, title, Kind.model)
    return [(problem.found, problem.repair) for problem in caught.value.problems]


@pytest.mark.parametrize("kind", Kind)
def test_record_is_read_with_its_title_and_number(checkout: Path, kind: Kind) -> None:
    case = load_case(start(checkout, "it-moves", "It moves: on  its 'own' #1", kind))
    assert (case.record.title, case.record.number) == ("It moves: on its 'own' #1", 1)
    assert (case.record.script is None) == (kind is Kind.model)


def test_every_field_of_the_record_is_explained_in_a_comment_or_stands_there() -> None:
    text = files("it-moves", "It moves", Kind.model, 1)["case.yaml"]
    named = {
        (chapter, field)
        for chapter, made in CHAPTERS.items()
        if chapter not in ELSEWHERE
        for field in made.model_fields
        if not any(f"{mark}{field}" in text for mark in (" ", "\n", "{", "`", "_")) and field not in ("script", "scene")
    }
    assert named == set()


def test_every_field_of_a_new_record_follows_a_comment() -> None:
    for kind in Kind:
        lines = files("it-moves", "It moves", kind, 1)["case.yaml"].splitlines()
        fields = [k for k, line in enumerate(lines) if line.split(":")[0] in Record.model_fields]
        assert [lines[k] for k in fields if not lines[k - 1].startswith("#")] == []


def test_first_line_is_the_editor_s(checkout: Path) -> None:
    for kind in Kind:
        assert files("it-moves", "It moves", kind, 1)["case.yaml"].splitlines()[0] == MODELINE


def test_lines_are_of_the_length_that_cases_keep() -> None:
    for kind in Kind:
        text = files("it-moves", "It moves", kind, 1)["case.yaml"]
        assert [line for line in text.splitlines() if len(line) > 118] == []


def test_number_is_the_next_free_one_though_a_record_is_broken(checkout: Path) -> None:
    write_case(checkout, ("number: 1", "number: 2"), slug="second")
    assert free_number(checkout) == 1
    write_case(checkout, ("title: A box", "title: [A box"), slug="first")
    assert free_number(checkout) == 3


def test_number_is_found_beside_what_is_no_record(checkout: Path) -> None:
    for name in ("a-pipe", "a-folder", "a-number"):
        (checkout / "cases" / name).mkdir()
    os.mkfifo(checkout / "cases" / "a-pipe" / "case.yaml")
    (checkout / "cases" / "a-folder" / "case.yaml").mkdir()
    (checkout / "cases" / "a-number" / "case.yaml").write_text("number: " + "1" * 5000 + "\n", encoding="utf-8")
    assert free_number(checkout) == 1


@pytest.mark.parametrize(
    ("name", "repair"),
    [
        ("It Moves", "write it-moves"),
        ("it_moves", "write it-moves"),
        ("7-moves", "write moves"),
        ("../moves", "write moves"),
        ("", "name the symptom: box-falls-through-floor"),
        ("a" * 200, "name the symptom in fewer words"),
    ],
)
def test_bad_slug_is_refused_with_a_good_one(checkout: Path, name: str, repair: str) -> None:
    assert [said for _, said in problems_of(checkout, name)] == [repair]
    assert list((checkout / "cases").iterdir()) == []


def test_slug_that_is_taken_is_refused_and_its_folder_left_alone(checkout: Path) -> None:
    folder = write_case(checkout, slug="taken")
    before = {path: path.read_bytes() for path in folder.iterdir()}
    assert problems_of(checkout, "taken") == [("a folder that is there", "take another name")]
    assert {path: path.read_bytes() for path in folder.iterdir()} == before


@pytest.mark.parametrize(
    "title", ["", "  ", "It moves.", "x" * (MAX_TITLE + 1), "It \x1b[31mmoves", "\u202eIt", "\udcff", "\u200b"]
)
def test_bad_title_is_refused(checkout: Path, title: str) -> None:
    assert len(problems_of(checkout, "it-moves", title)) == 1


def test_the_longest_title_is_the_record_s(checkout: Path) -> None:
    assert load_case(start(checkout, "it-moves", "x" * MAX_TITLE, Kind.model)).record.title == "x" * MAX_TITLE
    metadata = Record.model_fields["title"].metadata
    assert MAX_TITLE in [getattr(rule, "max_length", None) for rule in metadata]


def test_a_folder_is_written_whole_or_not_at_all(checkout: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> None:
        raise OSError("no space")

    monkeypatch.setattr(os, "rename", fail)
    with pytest.raises(OSError, match="no space"):
        start(checkout, "it-moves", "It moves", Kind.model)
    assert list((checkout / "cases").iterdir()) == []
    assert list((checkout / ".cache").iterdir()) == []
