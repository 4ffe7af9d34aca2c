"""Hostile files: each refused with one message."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.engine import confine
from helpers import MODEL, SCRIPT_RECORD, changed, only_problem, write_case, write_folder

EDIT = "{find: ' contype=\"2\" conaffinity=\"2\"', replace: ''}"


LANDLOCK = confine.landlock_version() >= 1


# XML

ENTITIES = '<!DOCTYPE m [<!ENTITY a "lol"><!ENTITY b "&a;&a;">]>\n'


FILES = [
    pytest.param('<include file="/etc/hosts"/>', id="include-absolute"),
    pytest.param('<include file="../other/model.xml"/>', id="include-above"),
    pytest.param('<include file="model.xml"/>', id="include-itself"),
    pytest.param('<include file="&#47;etc/hosts"/>', id="include-behind-a-reference"),
    pytest.param('<asset><mesh name="m" file="/m.obj"/></asset>', id="mesh"),
    pytest.param('<asset><hfield name="h" file="../h.png" size="1 1 1 1"/></asset>', id="hfield"),
    pytest.param('<asset><texture type="2d" file="../t.png"/></asset>', id="texture"),
    pytest.param('<asset><texture type="cube" fileright="../t.png"/></asset>', id="texture-of-a-side"),
    pytest.param('<asset><model name="m" file="/m.xml"/></asset>', id="model"),
    pytest.param('<deformable><skin name="s" file="../s.skn"/></deformable>', id="skin"),
    pytest.param('<worldbody><flexcomp name="f" type="gmsh" file="../f.msh"/></worldbody>', id="flexcomp"),
    pytest.param('<compiler meshdir="/"/>', id="meshdir"),
    pytest.param('<compiler texturedir=".."/>', id="texturedir"),
    pytest.param('<compiler assetdir="../.."/>', id="assetdir"),
]


@pytest.mark.parametrize("element", FILES)
def test_a_model_that_names_a_file(tmp_path: Path, element: str) -> None:
    folder = write_case(tmp_path, model=changed(MODEL, ("  <option", f"  {element}\n  <option")))
    told = only_problem(folder)
    assert (told.file, told.line) == ("cases/falling-box/model.xml", 2)
    assert told.expected == "a model in one file"


@pytest.mark.parametrize("element", FILES)
@pytest.mark.parametrize("kind", ["fixes", "refuted"])
def test_an_edit_that_names_a_file(tmp_path: Path, element: str, kind: str) -> None:
    find = EDIT if kind == "fixes" else "{find: 'timestep=\"0.002\"', replace: 'timestep=\"0.001\"'}"
    edit = "{find: '<mujoco>', replace: '<mujoco>" + element + "'}"
    told = only_problem(write_case(tmp_path, (find, edit)))
    assert told.where == f"{kind}[0].edits"
    assert told.found.startswith("after these edits: <")
    assert told.expected == "a model in one file, that names no other"


@pytest.mark.parametrize(
    "text", [pytest.param(ENTITIES + "<mujoco/>", id="entities"), pytest.param("<!DOCTYPE m>\n<mujoco/>", id="doctype")]
)
def test_a_model_with_a_doctype(tmp_path: Path, text: str) -> None:
    told = only_problem(write_case(tmp_path, model=text))
    assert (told.file, told.line, told.found) == ("cases/falling-box/model.xml", 1, "a DOCTYPE")


def test_a_name_in_a_model_that_turns_the_reading_direction(tmp_path: Path) -> None:
    told = only_problem(
        write_case(tmp_path, model='<mujoco>\n<worldbody><geom name="a&#x202e;b"/></worldbody></mujoco>')
    )
    assert (told.line, told.found) == (2, "the character U+202E in name of <geom>")


def test_an_edit_that_adds_a_doctype(tmp_path: Path) -> None:
    told = only_problem(write_case(tmp_path, (EDIT, "{find: '<mujoco>', replace: '<!DOCTYPE m><mujoco>'}")))
    assert told.found == "after these edits: a DOCTYPE"


@pytest.mark.parametrize("name", ["/etc/hosts", "../pendulum.xml", "sub/a.xml", "absent.xml"])
def test_a_scene_of_a_script_that_leads_out(tmp_path: Path, name: str) -> None:
    files = {
        "case.yaml": SCRIPT_RECORD.replace("script: script.py", "script: script.py\nfiles: [a.xml, b.xml]"),
        "script.py": "print('error = 0.5')\n",
        "a.xml": '<mujoco>\n  <include file="b.xml"/>\n</mujoco>',
        "b.xml": f'<mujocoinclude>\n\n  <include file="{name}"/>\n</mujocoinclude>',
    }
    told = only_problem(write_folder(tmp_path, "odd-script", files))
    assert (told.file, told.line) == ("cases/odd-script/b.xml", 3)
    assert told.expected == "a file of the folder: a.xml, b.xml, script.py"


def test_xml_that_only_mujoco_reads_is_refused(tmp_path: Path) -> None:
    told = only_problem(write_case(tmp_path, model=changed(MODEL, ('name="floor"', 'name="a & b"'))))
    assert (told.line, told.expected) == (5, "well-formed XML")


@pytest.mark.parametrize(
    "element",
    [
        pytest.param('<size memory="90000G"/>', id="memory"),
        pytest.param('<size nuser_geom="2000000000"/>', id="numbers-of-a-user"),
        pytest.param('<asset><hfield name="h" size="1 1 1 1" nrow="20000" ncol="20000"/></asset>', id="height-field"),
        pytest.param(
            '<asset><texture name="h" type="2d" builtin="flat" width="90000" height="90000"/></asset>', id="texture"
        ),
        pytest.param("<worldbody>" + "<body>" * 5000 + "</body>" * 5000 + "</worldbody>", id="depth"),
        pytest.param('<worldbody><geom size="nan"/></worldbody>', id="not-a-number"),
        pytest.param('<worldbody><geom size="1e400"/></worldbody>', id="too-large-a-number"),
        pytest.param('<extension><plugin plugin="/tmp/plugin.so"/></extension>', id="plugin"),
    ],
)
def test_a_model_that_asks_for_too_much(tmp_path: Path, element: str) -> None:
    told = only_problem(write_case(tmp_path, model=changed(MODEL, ("<mujoco>", f"<mujoco>{element}"))))
    assert told.file == "cases/falling-box/model.xml"
    assert told.found


def test_a_model_that_never_compiles(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("clinic.engine.mjcf.SECONDS", 1)
    endless = '<replicate count="2000000000"><geom size=".1"/></replicate>'
    told = only_problem(write_case(tmp_path, model=changed(MODEL, ("<worldbody>", f"<worldbody>{endless}"))))
    assert told.found == "a model that takes more than 1 s"
