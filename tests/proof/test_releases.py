"""Releases of MuJoCo: what differs is told, and explained or not."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from clinic.proof.releases import (
    LOCKS,
    Behaviour,
    Locked,
    behaviour,
    differences,
    differing,
    files_digest,
    lock_text,
    release_problems,
    seen_in,
)
from helpers import evidence_of_variants, tiny_case, variant_evidence

WELL = Behaviour(fixed=True, checks={"broken": [0.0], "fixed": [0.5]})


@pytest.mark.parametrize(
    ("other", "said"),
    [
        pytest.param(WELL, [], id="same"),
        pytest.param(WELL.model_copy(update={"checks": {"broken": [1e-7], "fixed": [0.5001]}}), [], id="noise"),
        pytest.param(
            WELL.model_copy(update={"checks": {"broken": [0.0], "fixed": [0.51]}}),
            ["a measures other numbers"],
            id="digit",
        ),
        pytest.param(WELL.model_copy(update={"fixed": False}), ["a is judged otherwise"], id="verdict"),
        pytest.param(
            WELL.model_copy(update={"warnings": {"BADQACC": 1}}), ["a warns BADQACC instead of none"], id="warning"
        ),
        pytest.param(Behaviour(error="no such flag"), ["a does not run (no such flag)"], id="error"),
        pytest.param(None, ["a does not run (not measured)"], id="missing"),
    ],
)
def test_what_differs_is_said(other: Behaviour | None, said: list[str]) -> None:
    assert list(differences({"a": WELL}, {} if other is None else {"a": other})) == said


def test_what_a_case_does_here_is_what_its_evidence_shows(tmp_path: Path) -> None:
    seen = behaviour(tiny_case(tmp_path))
    assert seen["broken"].broken
    assert seen["share-a-bit"].fixed
    shown = evidence_of_variants(broken=variant_evidence(height=[0.123456789])).variants["broken"]
    assert seen_in(shown).warnings == {}


def test_differences_are_those_of_the_releases_in_the_evidence() -> None:
    evidence = evidence_of_variants(broken=variant_evidence(height=[0.1]))
    seen = {"broken": seen_in(evidence.variants["broken"])}
    shown = evidence.model_copy(update={"releases": {"3.9.0": {"broken": {"error": "no such flag"}}, "4.0.0": seen}})
    assert differing(shown) == {"3.9.0": ["broken does not run (no such flag)"], "4.0.0": []}


def test_a_difference_needs_a_reason_and_a_reason_a_difference(tmp_path: Path) -> None:
    case = tiny_case(tmp_path)
    found = {"3.4.0": ["a is judged otherwise"], "3.10.0": [], "4.0.0": []}
    (told,) = release_problems(case, found)
    assert told.found == "on 3.4.0, a is judged otherwise"
    for older, said in [({"<3.10": "It came."}, []), ({"<4": "It came."}, ["none on 3.10.0"])]:
        explained = replace(case, record=case.record.model_copy(update={"older": older}))
        assert [problem.found for problem in release_problems(explained, found)] == said


def test_the_lock_is_read_as_it_was_written_and_tells_an_edited_case(tmp_path: Path) -> None:
    case = tiny_case(tmp_path / "one")
    lock = {"falling-box": Locked(files=files_digest(case), releases={"3.10.0": {"a": WELL}, "3.9.0": {"a": WELL}})}
    text = lock_text(lock)
    assert LOCKS.validate_json(text) == lock
    assert text.index("3.9.0") < text.index("3.10.0")
    assert files_digest(tiny_case(tmp_path / "two", ("duration: 0.4", "duration: 0.5"))) != files_digest(case)
