"""Evidence of a case with known numbers."""

from __future__ import annotations

import math
from pathlib import Path

import mujoco
import numpy as np
import pytest
from clinic.engine.checks import Trace
from clinic.proof.evidence import MAX_SAMPLES, Evidence, collect, samples
from clinic.record.problem import CaseError
from helpers import GRAVITY, script_case, tiny_case


@pytest.fixture(scope="module")
def evidence(tmp_path_factory: pytest.TempPathFactory) -> Evidence:
    return collect(tiny_case(tmp_path_factory.mktemp("evidence")))


def fallen(steps: int, timestep: float) -> float:
    """The height that xpos shows after so many steps: that of the last step's start."""
    return 0.06 - GRAVITY * timestep**2 * steps * (steps - 1) / 2


def test_numbers_are_those_of_free_fall(evidence: Evidence) -> None:
    assert evidence.variants["broken"].values["height"]["final"] == pytest.approx(fallen(200, 0.002), abs=1e-12)
    assert evidence.variants["small-step"].values["height"]["final"] == pytest.approx(fallen(400, 0.001), abs=1e-12)
    assert evidence.variants["broken"].values["contacts"]["max"] == 0
    assert evidence.variants["broken"].values["contacts"]["onset"] is None


def test_case_engine_and_variants_are_described(evidence: Evidence) -> None:
    assert (evidence.case, evidence.number, evidence.engine) == ("falling-box", 1, mujoco.__version__)
    assert {key: (v.kind, v.timestep, v.steps) for key, v in evidence.variants.items()} == {
        "broken": ("broken", 0.002, 200),
        "share-a-bit": ("fix", 0.002, 200),
        "small-step": ("refuted", 0.001, 400),
    }
    broken, fix, _ = evidence.variants.values()
    assert fix.edits == [{"find": ' contype="2" conaffinity="2"', "replace": ""}]
    assert fix.title == "Remove the masks of the floor"
    assert (broken.warnings, broken.messages, broken.output, evidence.snippet) == ({}, [], None, None)


def test_every_check_is_asked_of_every_variant(evidence: Evidence) -> None:
    assert {key: (v.broken, v.well) for key, v in evidence.variants.items()} == {
        "broken": (True, False),
        "share-a-bit": (False, True),
        "small-step": (True, False),
    }
    (result,) = evidence.variants["broken"].checks["fixed"]
    assert (result.signal, result.take, result.window) == ("height", "final", None)
    assert result.expected == {"between": (0.045, 0.051)}
    assert result.measured == evidence.variants["broken"].values["height"]["final"]
    assert not result.holds


def test_traces_carry_their_unit_and_both_ends(evidence: Evidence) -> None:
    trace = evidence.variants["broken"].traces["height"]
    assert trace.unit == "m"
    assert (trace.time[0], trace.time[-1]) == (0.002, 0.4)
    assert trace.value[-1] == evidence.variants["broken"].values["height"]["final"]


def test_evidence_survives_json(evidence: Evidence) -> None:
    assert Evidence.model_validate_json(evidence.model_dump_json()) == evidence


def test_script_case(tmp_path: Path) -> None:
    made = collect(script_case(tmp_path, ("lesson:", "snippet: print(open('script.py').read()[:5])\nlesson:")))

    broken, fix = made.variants.values()
    assert made.snippet == "print\n"
    assert broken.output == "first error = 0.25\nerror = 0.5\n"
    assert (broken.timestep, broken.steps) == (None, None)
    assert (broken.values["error"]["final"], fix.values["error"]["final"]) == (0.5, 0)
    assert (broken.broken, fix.well) == (True, True)


@pytest.mark.parametrize(
    ("count", "kept"),
    [
        pytest.param(0, 0, id="none"),
        pytest.param(1, 1, id="one"),
        pytest.param(MAX_SAMPLES, MAX_SAMPLES, id="as-many-as-fit"),
        pytest.param(10 * MAX_SAMPLES, MAX_SAMPLES, id="thinned"),
    ],
)
def test_samples_are_thinned_between_the_ends(count: int, kept: int) -> None:
    trace = Trace(np.arange(count) * 0.5, np.arange(count) ** 2.0)
    made = samples(trace, "m")
    assert len(made.time) == len(made.value) == kept
    assert made.value[:1] + made.value[-1:] == [float(v) for v in (*trace.value[:1], *trace.value[-1:])]
    assert made.value == [(2 * t) ** 2 for t in made.time]


@pytest.mark.parametrize(
    ("trace", "time", "value"),
    [
        pytest.param(Trace(np.arange(50.0), np.full(50, 3.0)), [0, 49], [3, 3], id="constant-is-its-two-ends"),
        pytest.param(Trace(np.arange(3.0), np.array([math.nan, 1, math.inf])), [0, 1, 2], [None, 1, None], id="holes"),
    ],
)
def test_samples_of(trace: Trace, time: list[float], value: list[float | None]) -> None:
    made = samples(trace, "")
    assert (made.time, made.value) == (time, value)


def test_a_run_that_takes_too_long_is_a_problem_of_the_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("clinic.engine.simulate.MAX_SECONDS", -1.0)
    with pytest.raises(CaseError) as caught:
        collect(tiny_case(tmp_path))
    assert {problem.where for problem in caught.value.problems} == {"run.duration"}
    assert {problem.expected for problem in caught.value.problems} == {"a run that comes to an end"}
