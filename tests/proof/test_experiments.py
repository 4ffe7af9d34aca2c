"""Experiments: what is run for a case, kept, and run again when what it depends on changes."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from clinic.proof import experiments
from clinic.proof.experiments import ALL, evidence_task, measure_case, measure_cases, measuring_tasks
from clinic.record.problem import CaseError
from clinic.work.cache import Cache
from helpers import MODEL, script_case, tiny_case

BROKEN_RECORD = ("body(box).xpos[2]", "body(bix).xpos[2]")


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Cache:
    monkeypatch.setenv("CLINIC_JOBS", "1")
    return Cache(tmp_path / "cache")


def test_a_model_and_a_script_are_measured(tmp_path: Path, cache: Cache) -> None:
    model = measure_case(tiny_case(tmp_path), cache)
    assert model.variants["broken"].broken
    assert model.robustness.keys() == {"broken", "share-a-bit", "small-step"}
    assert measure_case(script_case(tmp_path), cache).variants["no-error"].well


def test_nothing_is_run_again_when_only_words_change(
    tmp_path: Path, cache: Cache, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = measure_case(tiny_case(tmp_path / "before"), cache)
    monkeypatch.setattr(experiments, "collect", lambda case: pytest.fail(f"{case.slug} was run again"))
    words = ("Look at the masks.", "Look twice."), ("A box falls", "The box falls")
    assert measure_case(tiny_case(tmp_path / "after", *words), cache) == before


def test_numbers_are_changed_where_that_is_asked_and_once(
    tmp_path: Path, cache: Cache, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = tiny_case(tmp_path / "first", ("film: {}", "loose: {}\nfilm: {}"))
    assert measure_case(first, cache).loose is None
    before = measure_case(first, cache, ALL).loose
    assert before
    monkeypatch.setattr(experiments, "loose_numbers", lambda case, asked: pytest.fail("they were changed again"))
    reason = ("film: {}", "loose: {contype: any other bit}\nfilm: {}")
    assert measure_case(tiny_case(tmp_path / "reason", reason), cache, ALL).loose == before


@pytest.mark.parametrize(
    "change",
    [
        pytest.param(("duration: 0.4", "duration: 0.3"), id="run"),
        pytest.param(("0.051", "0.052"), id="check"),
        pytest.param(("'timestep=\"0.001\"'", "'timestep=\"0.0005\"'"), id="edit"),
    ],
)
def test_a_case_is_run_again_when_its_experiment_changes(tmp_path: Path, change: tuple[str, str]) -> None:
    before, after = tiny_case(tmp_path / "before"), tiny_case(tmp_path / "after", change)
    assert evidence_task(before).key != evidence_task(after).key
    assert {task.key for task in measuring_tasks(before)}.isdisjoint(task.key for task in measuring_tasks(after))


def test_a_case_is_run_again_when_its_model_changes(tmp_path: Path) -> None:
    before = tiny_case(tmp_path)
    after = replace(before, texts={"model.xml": MODEL.replace('mass="1"', 'mass="2"')})
    assert evidence_task(before).key != evidence_task(after).key


def test_a_case_that_cannot_be_run_holds_up_no_other(tmp_path: Path, cache: Cache) -> None:
    model, script = tiny_case(tmp_path, BROKEN_RECORD), script_case(tmp_path)
    made, problems = measure_cases([model, script], cache)
    assert made.keys() == {script.slug}
    assert {problem.file for problem in problems} == {model.file}


def test_problems_are_reported_and_not_remembered(tmp_path: Path, cache: Cache) -> None:
    script = script_case(tmp_path, script="raise SystemExit('no 0.5')\n")
    for _ in range(2):
        with pytest.raises(CaseError, match=r"no 0\.5"):
            measure_case(script, cache)


def test_a_failure_of_what_is_run_last_leaves_the_case_out(
    tmp_path: Path, cache: Cache, monkeypatch: pytest.MonkeyPatch
) -> None:
    case = tiny_case(tmp_path)
    monkeypatch.setattr(experiments, "robustness", lambda case: 1 / 0)
    made, problems = measure_cases([case], cache)
    assert made == {}
    assert [problem.found for problem in problems] == ["ZeroDivisionError: division by zero"]
    assert cache.get(evidence_task(case).key) is not None
