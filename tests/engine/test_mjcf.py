"""A model's text before the engine sees it."""

from __future__ import annotations

import pytest
from clinic.engine import mjcf
from clinic.engine.mjcf import ModelError, check_alone, malformed, probe, references
from helpers import MODEL


def test_references_have_their_lines() -> None:
    xml = '<mujoco>\n<include file="a.xml"/>\n<compiler\n meshdir="b"/>\n</mujoco>'
    assert [(r.line, str(r)) for r in references(xml)] == [
        (2, '<include file="a.xml">'),
        (3, '<compiler meshdir="b">'),
    ]


def test_references_before_an_error_are_found() -> None:
    assert [str(r) for r in references('<mujoco><mesh file="a.obj"/></body>')] == ['<mesh file="a.obj">']


def test_a_model_alone_is_accepted() -> None:
    check_alone(MODEL)
    assert malformed(MODEL) is None


def test_malformed_text_has_its_line() -> None:
    error = malformed("<mujoco>\n<body>\n</mujoco>")
    assert error is not None
    assert (error.line, error.found) == (3, "mismatched tag")


def test_a_model_that_steps_is_silent() -> None:
    probe(MODEL)


def test_what_mujoco_says_is_told() -> None:
    with pytest.raises(ValueError, match="unrecognized element"):
        probe("<mujoco><fredjoint/></mujoco>")


def test_a_child_that_was_ended_is_made_again() -> None:
    probe(MODEL)
    assert mjcf.KEEPER.process is not None
    mjcf.KEEPER.process.kill()
    mjcf.KEEPER.process.wait()
    probe(MODEL)


def test_an_engine_that_ends_its_process_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(mjcf, "_asked", lambda xml: ("", -11))
    with pytest.raises(ModelError) as caught:
        probe(MODEL)
    assert caught.value.found == "a model that ends the process, with exit code -11"
