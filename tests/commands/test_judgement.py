"""The judgement of a case, whatever state the others are in."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.commands.judgement import Judgement, Neighbours, judge_folder, plain
from clinic.work.cache import Cache
from helpers import write_script_case


@pytest.fixture
def checkout(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("CLINIC_JOBS", "1")
    return tmp_path


def judged(checkout: Path, slug: str = "odd-script") -> Judgement:
    return judge_folder(checkout / "cases" / slug, Neighbours(checkout), Cache(checkout / "cache"))


def add(checkout: Path, *changes: tuple[str, str], slug: str = "odd-script") -> None:
    write_script_case(checkout, *changes, ("tags: [code]", "tags: [code]\nlooks: [numbers-wrong]"), slug=slug)


def test_sound_case(checkout: Path) -> None:
    add(checkout)
    judgement = judged(checkout)
    assert judgement.sound
    assert plain(judgement)["variants"].keys() == {"broken", "no-error"}


def test_a_broken_neighbour_leaves_a_sound_case_sound(checkout: Path) -> None:
    add(checkout)
    add(checkout, ("number: 2", "number: two"), slug="other-script")
    assert judged(checkout).sound
    (problem,) = judged(checkout, "other-script").problems
    assert problem.where == "number"
    assert judged(checkout, "other-script").case is None


def test_a_number_taken_twice_is_a_problem_of_both(checkout: Path) -> None:
    add(checkout)
    add(checkout, slug="other-script")
    assert not judged(checkout, "odd-script").sound
    assert not judged(checkout, "other-script").sound


@pytest.mark.parametrize(
    ("change", "where"),
    [
        (("lesson: Read the output.", "lesson: It is {{ broken.eror.final }}."), "lesson"),
        (("tags: [code]", "tags: [code]\nmanual: [XMLreference.html#no-such-thing]"), "manual[0]"),
        (("path: printed(error)", "path: printed(eror)"), "signals.error.path"),
    ],
    ids=["a field that resolves to nothing", "a link that leads nowhere", "a signal that is not printed"],
)
def test_what_a_strict_build_refuses_is_a_problem(checkout: Path, change: tuple[str, str], where: str) -> None:
    extra = "tags: [code]\nlooks: [numbers-wrong]"
    write_script_case(
        checkout,
        *(
            [(change[0], change[1] + "\nlooks: [numbers-wrong]")]
            if "tags" in change[0]
            else [change, ("tags: [code]", extra)]
        ),
    )
    assert where in [problem.where for problem in judged(checkout).problems]


def test_a_case_that_nobody_would_find_is_a_problem(checkout: Path) -> None:
    write_script_case(checkout)
    assert [problem.where for problem in judged(checkout).problems] == ["phrases"]


def test_mistakes_and_broken_laws_are_found_together(checkout: Path) -> None:
    write_script_case(checkout, ("above: 0.1", "below: 0.1"))
    judgement = judged(checkout)
    assert [problem.where for problem in judgement.problems] == ["phrases"]
    assert [said.found.split(": ")[0] for said in judgement.breaches] == ["no-error", "broken"]
    assert [said.where for said in judgement.breaches] == ["checks.broken", "checks.broken[0]"]
