"""A model's text before the engine sees it, in a case."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.engine.mjcf import ModelError, check_text
from helpers import MODEL, SCRIPT_RECORD, changed, only_problem, write_case, write_folder

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


@pytest.mark.parametrize("name", ["../pendulum.xml", "absent.xml"])
def test_a_scene_of_a_script_that_names_a_file_elsewhere(tmp_path: Path, name: str) -> None:
    files = {
        "case.yaml": SCRIPT_RECORD.replace("script: script.py", "script: script.py\nfiles: [a.xml, b.xml]"),
        "script.py": "print('error = 0.5')\n",
        "a.xml": '<mujoco>\n  <include file="b.xml"/>\n</mujoco>',
        "b.xml": f'<mujocoinclude>\n\n  <include file="{name}"/>\n</mujocoinclude>',
    }
    told = only_problem(write_folder(tmp_path, "odd-script", files))
    assert (told.file, told.line) == ("cases/odd-script/b.xml", 3)
    assert told.expected == "a file of the folder: a.xml, b.xml, script.py"
