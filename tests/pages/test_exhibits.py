"""Exhibits: what a case's page shows, made once."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from clinic.pages import exhibits as exhibit
from clinic.pages.exhibits import (
    all_exhibits,
    evidence_of,
    evidence_task,
    exhibits,
    figure_task,
    measuring_tasks,
    possible_exhibits,
)
from clinic.record.case import Case
from clinic.record.problem import CaseError
from clinic.work.cache import Cache
from helpers import MODEL, script_case, tiny_case

BROKEN_RECORD = ("body(box).xpos[2]", "body(bix).xpos[2]")


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Cache:
    monkeypatch.setenv("CLINIC_JOBS", "1")
    return Cache(tmp_path / "cache")


def without_film(root: Path, *changes: tuple[str, str]) -> Case:
    return tiny_case(root, ("film: {}\n", ""), *changes)


def test_exhibits_of_a_model(tmp_path: Path, cache: Cache) -> None:
    files = exhibits(without_film(tmp_path), cache)

    assert {"evidence.json", "plot.svg", "broken.webp", "fixed.webp"} <= set(files)
    assert evidence_of(files).variants["broken"].broken
    assert files["evidence.json"].endswith(b"}\n")


def test_exhibits_of_a_script(tmp_path: Path, cache: Cache) -> None:
    files = exhibits(script_case(tmp_path), cache)

    assert set(files) == {"evidence.json", "plot.svg"}
    assert evidence_of(files).variants["no-error"].well


def test_two_makings_are_equal_to_the_last_byte(tmp_path: Path, cache: Cache) -> None:
    case = without_film(tmp_path)
    assert exhibits(case, cache) == exhibits(case, Cache(tmp_path / "another"))


def test_nothing_is_run_again_when_only_prose_changes(
    tmp_path: Path, cache: Cache, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = exhibits(without_film(tmp_path / "before"), cache)
    monkeypatch.setattr(exhibit, "collect", lambda case: pytest.fail(f"{case.slug} was run again"))

    after = without_film(tmp_path / "after", ("Look at the masks.", "Look twice."), ("A box falls", "The box falls"))

    assert exhibits(after, cache) == before


@pytest.mark.parametrize(
    "change",
    [
        pytest.param(("duration: 0.4", "duration: 0.3"), id="run"),
        pytest.param(("0.051", "0.052"), id="check"),
        pytest.param(("'timestep=\"0.001\"'", "'timestep=\"0.0005\"'"), id="edit"),
    ],
)
def test_a_case_is_run_again_when_its_experiment_changes(tmp_path: Path, change: tuple[str, str]) -> None:
    before, after = without_film(tmp_path / "before"), without_film(tmp_path / "after", change)
    assert evidence_task(before).key != evidence_task(after).key
    assert {task.key for task in measuring_tasks(before)}.isdisjoint(task.key for task in measuring_tasks(after))


def test_a_case_is_run_again_when_its_model_changes(tmp_path: Path) -> None:
    before = without_film(tmp_path / "before")
    after = replace(before, texts={"model.xml": MODEL.replace('mass="1"', 'mass="2"')})
    assert evidence_task(before).key != evidence_task(after).key


@pytest.mark.parametrize(
    "change",
    [
        pytest.param(("label: height of the box", "label: height"), id="label"),
        pytest.param(("unit: m,", "unit: metre,"), id="unit"),
        pytest.param(("duration: 0.4", "duration: 0.3"), id="run"),
    ],
)
def test_plots_are_drawn_again_when_what_they_show_changes(
    tmp_path: Path, cache: Cache, change: tuple[str, str]
) -> None:
    before, after = without_film(tmp_path / "before"), without_film(tmp_path / "after", change)
    evidence = evidence_of(exhibits(before, cache))
    assert figure_task(before, evidence).key != figure_task(after, evidence).key


def test_a_result_is_kept_though_a_later_one_fails(
    tmp_path: Path, cache: Cache, monkeypatch: pytest.MonkeyPatch
) -> None:
    def killed(case: Case) -> dict[str, bytes]:
        raise KeyboardInterrupt

    case = without_film(tmp_path)
    monkeypatch.setattr("clinic.pages.figures.pictures.pictures", killed)
    with pytest.raises(KeyboardInterrupt):
        exhibits(case, cache)
    first, robust, _ = evidence_task(case), *measuring_tasks(case)
    assert cache.get(first.key) is not None
    assert cache.get(robust.key) is not None


def test_a_case_that_cannot_be_run_holds_up_no_other(tmp_path: Path, cache: Cache) -> None:
    model, script = without_film(tmp_path, BROKEN_RECORD), script_case(tmp_path)
    made, problems = possible_exhibits([model, script], cache)
    assert made == {script.slug: exhibits(script, cache)}
    assert {problem.file for problem in problems} == {model.file}


def test_all_exhibits_are_by_slug(tmp_path: Path, cache: Cache) -> None:
    model, script = without_film(tmp_path), script_case(tmp_path)
    made = all_exhibits([model, script], cache)
    assert made == {model.slug: exhibits(model, cache), script.slug: exhibits(script, cache)}


def test_problems_of_all_cases_are_reported_and_not_remembered(tmp_path: Path, cache: Cache) -> None:
    model = without_film(tmp_path, BROKEN_RECORD)
    script = script_case(tmp_path, script="raise SystemExit('no 0.5')\n")
    for _ in range(2):
        with pytest.raises(CaseError) as caught:
            all_exhibits([model, script], cache)
        assert {problem.file for problem in caught.value.problems} == {model.file, script.file}
