"""The checking of a case, whatever state the others are in."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml
from clinic.commands.check import Report, check_cases, report_data
from clinic.work.cache import Cache
from helpers import write_case, write_script_case

TAGS = "tags: [code]"
FOUND = (TAGS, f"{TAGS}\nfamily: wrong-numbers\ntelling: {{cause: masks, says: the error that it prints}}")


@pytest.fixture
def checkout(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("CLINIC_JOBS", "1")
    return tmp_path


def checked(checkout: Path, slug: str = "odd-script") -> Report:
    (report,) = check_cases(checkout, [slug], Cache(checkout / "cache"))
    return report


def test_sound_case(checkout: Path) -> None:
    write_script_case(checkout, FOUND)
    report = checked(checkout)
    assert report.sound
    assert report.grade == "B"
    assert report_data(report)["variants"].keys() == {"broken", "no-error"}


def test_a_case_with_all_that_grade_a_asks_for(checkout: Path) -> None:
    trial = "{id: more, title: More, edits: [{find: first, replace: '2 * first'}]}"
    write_script_case(checkout, FOUND, ("picture:", f"trials: [{trial}]\nloose: {{'error = 0.5': any}}\npicture:"))
    assert checked(checkout).grade == "B"
    words = ["Read it.", "It says so.", "Write another number.", "Read the output.", "More", "masks"]
    words += ["the error that it prints", "A script prints an error"]
    claims = {"measured": ["It prints {{ broken.error.final }}."], "advice": words}
    (checkout / "cases" / "odd-script" / "claims.yaml").write_text(yaml.safe_dump(claims), encoding="utf-8")
    assert (checked(checkout).grade, checked(checkout).breaches) == ("A", ())


def test_numbers_that_no_check_notices_are_told(checkout: Path) -> None:
    write_script_case(checkout, FOUND, ("picture:", "loose: {}\npicture:"))
    report = checked(checkout)
    assert [said.where for said in report.breaches] == ["loose", "loose"]
    assert "0.5 is halved" in report.breaches[1].found


def test_a_broken_neighbour_leaves_a_sound_case_sound(checkout: Path) -> None:
    write_script_case(checkout, FOUND)
    write_script_case(checkout, ("number: 2", "number: two"), slug="other-script")
    assert checked(checkout).sound
    other = checked(checkout, "other-script")
    assert ([problem.where for problem in other.problems], other.case) == (["number"], None)


def test_a_number_taken_twice_is_a_problem_of_both(checkout: Path) -> None:
    for slug in ("odd-script", "other-script"):
        write_script_case(checkout, FOUND, slug=slug)
    assert not checked(checkout, "odd-script").sound
    assert not checked(checkout, "other-script").sound


@pytest.mark.parametrize(
    ("change", "where"),
    [
        (("lesson: Read the output.", "lesson: It is {{ broken.eror.final }}."), "lesson"),
        ((TAGS, f"{TAGS}\nmanual: [XMLreference.html#no-such-thing]"), "manual[0]"),
        (("path: printed(error)", "path: printed(eror)"), "signals.error.path"),
    ],
    ids=["a field that resolves to nothing", "a link that leads nowhere", "a signal that is not printed"],
)
def test_what_a_strict_build_refuses_is_a_problem(checkout: Path, change: tuple[str, str], where: str) -> None:
    write_script_case(checkout, change)
    assert where in [problem.where for problem in checked(checkout).problems]


def test_mistakes_and_broken_laws_are_found_together(checkout: Path) -> None:
    write_script_case(checkout, ("above: 0.1", "below: 0.1"), ("lesson: Read", "lesson: Read {{ broken.eror.final }}"))
    report = checked(checkout)
    assert [problem.where for problem in report.problems] == ["lesson"]
    assert [said.found.split(": ")[0] for said in report.breaches] == ["no-error", "broken"]
    assert [said.where for said in report.breaches] == ["checks.broken", "checks.broken[0]"]


def test_mistakes_of_record_references_and_model_are_told_in_one_go(checkout: Path) -> None:
    write_case(
        checkout,
        ("number: 1", "number: one"),
        ("lesson: Look at the masks.\n", ""),
        ("equals: 0}", "equals: 0, tke: max}"),
        ("  contacts: {path: ncon}", "  contacts: {path: ncon, units: m}"),
        ("signal: height, between", "signal: hight, between"),
        ("find: 'timestep=\"0.002\"'", "find: 'timestep=\"0.003\"'"),
        ("camera: side", "camera: sid"),
    )
    assert [problem.where for problem in checked(checkout, "falling-box").problems] == [
        "lesson",
        "number",
        "signals.contacts.units",
        "checks.broken[0].tke",
        "refuted[0].edits[0].find",
        "picture.camera",
    ]
