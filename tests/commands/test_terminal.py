"""What the commands print, with the tiny cases."""

from __future__ import annotations

import io
from pathlib import Path

import pytest
from clinic.commands.check import Report
from clinic.commands.terminal import case_data, case_text, cases_table, checks_table, reports_table
from clinic.pages.text.claim import claim
from clinic.proof.evidence import Evidence, collect
from clinic.record.case import Case
from clinic.record.problem import Problem
from helpers import tiny_case
from rich.console import Console, RenderableType

HIDDEN = ("The masks share no bit", "Remove the masks of the floor", "Look at the masks", "Halve the timestep")


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> tuple[Case, Evidence]:
    case = tiny_case(tmp_path_factory.mktemp("terminal"))
    return case, collect(case)


def printed(what: RenderableType) -> str:
    console = Console(file=io.StringIO(), width=120)
    console.print(what)
    return console.file.getvalue().replace("\u00a0", " ")  # type: ignore[attr-defined]


def test_list_names_number_slug_title_and_tags(made: tuple[Case, Evidence]) -> None:
    row = printed(cases_table([made[0]])).splitlines()[3]
    assert [cell.strip() for cell in row.strip("│").split("│")] == [
        "1",
        "falling-box",
        "A box falls through the floor",
        "contact",
    ]


def test_checks_are_shown_in_words_with_what_was_measured(made: tuple[Case, Evidence]) -> None:
    checks = made[0].record.checks
    lines = [" ".join(line.split()) for line in printed(checks_table(*made)).splitlines()]
    assert "1. A box falls through the floor" in lines[0]
    broken, fixed = claim(made[0], checks.broken[0]), claim(made[0], checks.fixed[0])
    assert f"│ broken │ it is broken │ {broken} │ 0 │ yes │" in lines
    assert f"│ share-a-bit, fix │ it is well │ {fixed} │ 0.04989 m │ yes │" in lines


def test_summary_counts_what_is_wrong(made: tuple[Case, Evidence]) -> None:
    problem = Problem("cases/b/case.yaml", 1, "", "x", "y", "z")
    text = printed(reports_table([Report("a", *made, ()), Report("b", None, None, (problem,), (problem, problem))]))
    assert "sound" in text
    assert "1 mistake, 2 broken laws" in text


def test_folds_are_closed_until_the_answer_is_asked_for(made: tuple[Case, Evidence]) -> None:
    closed, opened = (printed(case_text(*made, answer)) for answer in (False, True))
    assert "It falls to −0.721 m." in closed
    assert [text for text in HIDDEN if text in closed] == []
    assert [text for text in HIDDEN if text not in opened] == []
    assert "It still falls to −0.723 m." in opened
    assert "{{" not in closed + opened


def test_case_as_data(made: tuple[Case, Evidence]) -> None:
    closed, opened = (case_data(*made, answer) for answer in (False, True))
    assert closed == {
        "number": 1,
        "case": "falling-box",
        "title": "A box falls through the floor",
        "tags": ["contact"],
        "symptom": "It falls to −0.721\u00a0m.",
    }
    assert opened["fixes"][0]["diff"].splitlines()[-3:-1] == [
        '-    <geom name="floor" type="plane" size="1 1 0.1" contype="2" conaffinity="2"/>',
        '+    <geom name="floor" type="plane" size="1 1 0.1"/>',
    ]
    assert "why" in opened["refuted"][0]
    assert "why" not in opened["fixes"][0]


def test_sweeps_and_snippet_are_shown_with_the_answer(tmp_path: Path) -> None:
    snippet = ("cause: The", "snippet: print(6 * 7)\ncause: The")
    case = tiny_case(tmp_path, snippet)
    text = printed(case_text(case, collect(case), True))
    assert "print(6 * 7)" in text
    assert "It prints:\n42" in text


def test_markup_in_a_title_is_text(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("title: A box falls through the floor", "title: A [red]box[/] falls"))
    assert "A [red]box[/] falls" in printed(cases_table([case]))
