"""The files beside a case's page, made once."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.pages.case_files import drawing_tasks, files_of_case, files_of_cases
from clinic.proof.experiments import evidence_of, evidence_task, measuring_tasks
from clinic.record.case import Case
from clinic.work.cache import Cache
from helpers import script_case, tiny_case


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Cache:
    monkeypatch.setenv("CLINIC_JOBS", "1")
    return Cache(tmp_path / "cache")


def without_film(root: Path, *changes: tuple[str, str]) -> Case:
    return tiny_case(root, ("film: {}\n", ""), *changes)


def test_a_model_is_plotted_and_pictured(tmp_path: Path, cache: Cache) -> None:
    files = files_of_case(without_film(tmp_path), cache)

    assert {"evidence.json", "plot.svg", "broken.webp", "fixed.webp"} <= set(files)
    assert evidence_of(files).variants["broken"].broken
    assert files["evidence.json"].endswith(b"}\n")


def test_a_script_is_plotted(tmp_path: Path, cache: Cache) -> None:
    assert set(files_of_case(script_case(tmp_path), cache)) == {"evidence.json", "plot.svg"}


def test_two_makings_are_equal_to_the_last_byte_whatever_else_is_made(tmp_path: Path, cache: Cache) -> None:
    model, script = without_film(tmp_path), script_case(tmp_path)
    made, problems = files_of_cases([model, script], cache)
    assert problems == []
    other = Cache(tmp_path / "another")
    assert made == {case.slug: files_of_case(case, other) for case in (model, script)}


@pytest.mark.parametrize(
    "change",
    [
        pytest.param(("label: height of the box", "label: height"), id="label"),
        pytest.param(("unit: m,", "unit: metre,"), id="unit"),
        pytest.param(("duration: 0.4", "duration: 0.3"), id="run"),
    ],
)
def test_plots_are_drawn_again_when_what_they_show_changes(tmp_path: Path, change: tuple[str, str]) -> None:
    before, after = without_film(tmp_path / "before"), without_film(tmp_path / "after", change)
    measured = {"evidence.json": b"{}"}
    keys = {task.key for task in drawing_tasks(before, measured)}
    assert keys.isdisjoint(task.key for task in drawing_tasks(after, measured))


def test_a_result_is_kept_though_a_later_one_fails(
    tmp_path: Path, cache: Cache, monkeypatch: pytest.MonkeyPatch
) -> None:
    def killed(case: Case) -> dict[str, bytes]:
        raise KeyboardInterrupt

    case = without_film(tmp_path)
    monkeypatch.setattr("clinic.pages.figures.pictures.pictures", killed)
    with pytest.raises(KeyboardInterrupt):
        files_of_case(case, cache)
    assert [cache.get(task.key) for task in (evidence_task(case), *measuring_tasks(case))].count(None) == 0
