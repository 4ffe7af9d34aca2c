"""The folder of a new case: what it holds, and what is refused."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.commands.scaffold import SOURCES, case_texts, free_number, write_case
from clinic.pages.schema import MODELINE
from clinic.record.case import load_case
from clinic.record.fields import Record
from clinic.record.problem import CaseError
from helpers import write_folder


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    (tmp_path / "cases").mkdir()
    return tmp_path


@pytest.mark.parametrize("kind", SOURCES)
def test_record_is_read_with_its_title_and_number(checkout: Path, kind: str) -> None:
    case = load_case(write_case(checkout, "it-moves", "It moves: on  its 'own' #1.", kind, "drifts"))
    assert (case.record.title, case.record.number) == ("It moves: on its 'own' #1", 1)
    assert (case.record.script is None) == (kind == "model")


@pytest.mark.parametrize("kind", SOURCES)
def test_a_new_record_reads_well(kind: str) -> None:
    """Its first line is the editor's, every field follows a comment, and no line is longer than those of cases."""
    lines = case_texts("it-moves", "It moves", kind, 1, "drifts")["case.yaml"].splitlines()
    assert lines[0] == MODELINE
    fields = [k for k, line in enumerate(lines) if line.split(":")[0] in Record.model_fields]
    assert [lines[k] for k in fields if not lines[k - 1].startswith("#")] == []
    assert [line for line in lines if len(line) > 118] == []


def test_number_is_the_next_free_one_though_a_record_is_broken(checkout: Path) -> None:
    write_folder(checkout, "second", {"case.yaml": "title: [A box\nnumber: 2 # two\n"})
    assert free_number(checkout) == 1
    write_folder(checkout, "first", {"case.yaml": "number: 1\n"})
    write_folder(checkout, "none", {})
    assert free_number(checkout) == 3


@pytest.mark.parametrize("name", ["It Moves", "7-moves", "../moves", "", "taken"])
def test_bad_slug_is_refused(checkout: Path, name: str) -> None:
    write_folder(checkout, "taken", {"mine.txt": "kept"})
    with pytest.raises(CaseError, match="lower-case words joined by hyphens"):
        write_case(checkout, name, "It moves", "model", "drifts")
    assert [path.name for path in checkout.rglob("*.*")] == ["mine.txt"]


@pytest.mark.parametrize("title", ["  ", "x" * 91])
def test_a_title_that_the_record_refuses_leaves_nothing_behind(checkout: Path, title: str) -> None:
    with pytest.raises(CaseError, match="title"):
        write_case(checkout, "it-moves", title, "model", "drifts")
    assert list((checkout / "cases").iterdir()) == []


def test_a_family_that_does_not_exist_is_refused_with_those_near_to_it(checkout: Path) -> None:
    with pytest.raises(CaseError, match="family") as caught:
        write_case(checkout, "it-moves", "It moves", "model", "osillates")
    assert [problem.repair for problem in caught.value.problems] == ["write oscillates"]
    assert list((checkout / "cases").iterdir()) == []
