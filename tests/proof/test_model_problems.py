"""What only the compiled model can tell; the messages are in record/test_case.py."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.proof.model_problems import check_against_model
from clinic.record.case import Case
from clinic.record.problem import CaseError
from helpers import MODEL, only_problem, script_case, tiny_case, write_case

STARTS = (
    "{{measure: fraction_of_starts, joint: {}, index: {}, offset: [0, 1], count: 2, "
    "holds: {{signal: height, above: 0}}}}"
)


def places(case: Case) -> list[str]:
    with pytest.raises(CaseError) as caught:
        check_against_model(case)
    return [problem.where for problem in caught.value.problems]


def test_nothing_is_said_of_a_valid_case(tmp_path: Path) -> None:
    assert check_against_model(tiny_case(tmp_path / "model")) is None
    assert check_against_model(script_case(tmp_path / "script")) is None


@pytest.mark.parametrize(
    ("signal", "where"),
    [
        pytest.param(STARTS.format("fre", 2), "signals.contacts", id="joint-of-starts"),
        pytest.param(STARTS.format("free", 7), "signals.contacts", id="index-of-starts"),
        pytest.param(
            "{measure: image_row, camera: top, geom: box}", "signals.contacts.camera", id="camera-of-an-image"
        ),
        pytest.param("{measure: image_row, camera: side, geom: bix}", "signals.contacts.geom", id="geom-of-an-image"),
    ],
)
def test_names_in_measures(tmp_path: Path, signal: str, where: str) -> None:
    case = tiny_case(
        tmp_path, ("{path: ncon}", signal), ("{signal: contacts, take: max, equals: 0}", "{signal: height, below: 0}")
    )
    assert places(case) == [where]


def test_every_kind_of_problem_is_reported_at_once(tmp_path: Path) -> None:
    case = tiny_case(
        tmp_path,
        ("body(box).xpos[2]", "body(bix).xpos[2]"),
        ("{path: ncon}", "{path: 'ncon('}"),
        ("{duration: 0.4}", "{duration: 0.4, keyframe: throw}"),
        ("camera: side", "camera: top"),
    )
    assert places(case) == ["run.keyframe", "signals.height", "signals.contacts", "picture.camera"]


def test_unmatched_edits_are_reported_with_bad_paths(tmp_path: Path) -> None:
    case = tiny_case(
        tmp_path, ("{path: ncon}", "{path: 'ncon('}"), ("find: 'timestep=\"0.002\"'", "find: 'timestep=\"0.01\"'")
    )
    assert places(case) == ["signals.contacts", "refuted[0].edits[0].find"]


def test_a_mistake_in_the_model_is_reported_once_although_every_variant_has_it(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, model=MODEL.replace('name="side"', 'name="front"'))
    assert places(case) == ["picture.camera"]


def test_a_remedy_may_bring_the_name_that_the_broken_model_lacks_but_not_only_it(tmp_path: Path) -> None:
    case = tiny_case(
        tmp_path,
        ("body(box).xpos[2]", "site(tip).xpos[2]"),
        ("replace: 'timestep=\"0.001\"'", 'replace: \'timestep="0.001"/><size nuserdata="1"\''),
    )
    assert places(case) == ["signals.height"]


@pytest.mark.parametrize(
    "measure", ["{measure: image_row, camera: side, geom: box}", STARTS.format("free", 0).replace("height", "error")]
)
def test_measures_of_a_model_are_refused_in_a_script_case(tmp_path: Path, measure: str) -> None:
    case = script_case(tmp_path, ("{path: printed(error), unit: m}", "{path: printed(error)}\n  share: " + measure))
    assert places(case) == ["signals.share"]


def test_a_line_of_the_engine_s_own_source_is_none_of_the_model(tmp_path: Path) -> None:
    model = MODEL.replace("<worldbody>", '<size memory="200"/>\n<worldbody>', 1)
    told = only_problem(write_case(tmp_path, model=model))
    assert "line" in told.found
    assert told.line == 1
