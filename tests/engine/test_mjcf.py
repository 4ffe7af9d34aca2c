"""A model's text before the engine sees it, in a case."""

from __future__ import annotations

from pathlib import Path

import mujoco
import pytest
from clinic.engine.mjcf import ModelError, check_text, newer_release, release_needed
from helpers import MODEL, changed, only_problem, write_case

NAMES_A_FILE = [
    pytest.param('<include file="../other/model.xml"/>', id="include"),
    pytest.param('<asset><mesh name="m" file="m.obj"/></asset>', id="mesh"),
    pytest.param('<asset><texture type="cube" fileright="t.png"/></asset>', id="texture-of-a-side"),
]


@pytest.mark.parametrize(
    ("text", "line", "found"),
    [
        pytest.param("<mujoco>\n<body>\n</mujoco>", 3, "mismatched tag, in the <body> of line 2", id="not-closed"),
        pytest.param(
            '<mujoco>\n<geom name="a & b"/>\n</mujoco>',
            2,
            "not well-formed (invalid token), in the <mujoco> of line 1",
            id="ampersand",
        ),
        pytest.param("", 1, "no element found", id="empty"),
    ],
)
def test_malformed_text_has_its_line(text: str, line: int, found: str) -> None:
    with pytest.raises(ModelError) as caught:
        check_text(text)
    assert (caught.value.line, caught.value.found) == (line, found)


@pytest.mark.parametrize("element", NAMES_A_FILE)
def test_a_model_that_names_a_file(tmp_path: Path, element: str) -> None:
    told = only_problem(write_case(tmp_path, model=changed(MODEL, ("  <option", f"  {element}\n  <option"))))
    assert (told.file, told.line) == ("cases/falling-box/model.xml", 2)
    assert told.expected == "a model in one file"


@pytest.mark.parametrize("element", NAMES_A_FILE)
def test_an_edit_that_names_a_file(tmp_path: Path, element: str) -> None:
    find = "{find: 'timestep=\"0.002\"', replace: 'timestep=\"0.001\"'}"
    told = only_problem(write_case(tmp_path, (find, "{find: '<mujoco>', replace: '<mujoco>" + element + "'}")))
    assert told.where == "refuted[0].edits"
    assert told.found.startswith("after these edits: <")
    assert told.expected == "a model in one file"


@pytest.mark.parametrize(
    ("text", "release"),
    [
        ('<mujoco><option timestep="0.001"/></mujoco>', ""),
        ('<mujoco><option><flag speculative="enable" sleep="enable"/></option></mujoco>', "4.0"),
        ("<mujoco><actuator><pid joint='a'/></actuator></mujoco>", "3.12"),
    ],
)
def test_the_release_that_a_text_needs_is_that_of_its_newest_word(text: str, release: str) -> None:
    assert release_needed(text) == release


@pytest.mark.parametrize(
    ("refused", "said"),
    [
        ("attribute: 'speculative'\nElement 'flag'", "`speculative`; MuJoCo 4.0 does."),
        ("element\nElement 'pid'", "`pid`; MuJoCo 3.12 does."),
    ],
)
def test_what_a_newer_release_knows_is_told(refused: str, said: str) -> None:
    error = f"XML Error: Schema violation: unrecognized {refused}, line 1"

    assert newer_release(error, "3.11.0") == f"This is MuJoCo 3.11.0, which does not know {said}"


def test_of_what_no_release_knows_nothing_is_told() -> None:
    with pytest.raises(ValueError, match="unrecognized attribute") as caught:
        mujoco.MjModel.from_xml_string('<mujoco><option><flag speculation="enable"/></option></mujoco>')

    assert newer_release(str(caught.value), mujoco.__version__) == ""
