"""Cases: what is read from a valid folder, and what an author is told about a wrong one."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.record.case import read_cases
from clinic.record.problem import CaseError
from helpers import MODEL, RECORD, SLUG, changed, refused, script_case, tiny_case, told, write_case, write_folder

Change = tuple[str, str]


# What is read


def test_valid_case_is_read_with_its_files_and_lines(tmp_path: Path) -> None:
    case = tiny_case(tmp_path)
    assert (case.slug, case.file) == (SLUG, "cases/falling-box/case.yaml")
    assert case.text == MODEL
    assert case.texts == {"model.xml": MODEL}
    assert case.record.fixes[0].edits[0].find == ' contype="2" conaffinity="2"'
    assert RECORD.splitlines()[case.lines.at(("fixes", 0, "edits")) - 1].strip() == "edits:"


def test_what_is_left_out_has_its_default(tmp_path: Path) -> None:
    record = tiny_case(tmp_path).record
    assert record.run is not None
    assert (record.run.keyframe, record.run.qpos, record.run.ctrl) == (None, {}, {})
    assert (record.see, record.files, record.warnings, record.snippet) == ([], [], [], None)
    assert record.checks.fixed[0].take == "final"
    assert record.signals["contacts"].unit == ""


def test_a_script_is_the_source_of_a_code_case(tmp_path: Path) -> None:
    case = script_case(tmp_path)
    assert case.record.source == "script.py"
    assert case.text.startswith("print(")


def test_cases_are_sorted_by_number(tmp_path: Path) -> None:
    write_case(tmp_path, ("number: 1", "number: 12"), slug="a")
    write_case(tmp_path, ("number: 1", "number: 3"), slug="c")
    write_case(tmp_path, ("number: 1", "number: 7\nsee: [a, c]"), slug="b")
    assert [case.slug for case in read_cases(tmp_path / "cases")[0]] == ["c", "b", "a"]


@pytest.mark.parametrize(
    "change",
    [
        pytest.param(("{duration: 0.4}", "{duration: 1, ctrl: {motor: 2}}"), id="constant-control"),
        pytest.param(("{duration: 0.4}", "{duration: 1, ctrl: {motor: [[0, 1], [0.5, -1]]}}"), id="control-over-time"),
        pytest.param(("{path: ncon}", "{expr: 2 * height}"), id="expression"),
        pytest.param(("{path: ncon}", "{measure: image_row, camera: side, geom: floor}"), id="image-row"),
        pytest.param(("between: [0.045, 0.051]", "equals: 0.05, within: 1e-2"), id="equals-within"),
        pytest.param(("between: [0.045, 0.051]", "below: 0.051, window: [0.1, 0.2]"), id="window"),
        pytest.param(("replace: ''", "replace: ' contype=\"2\"'"), id="replace-by-part"),
        pytest.param(("title: A box falls through the floor", "title: 2024-01-02"), id="text-that-looks-like-a-date"),
        pytest.param(("title: A box falls through the floor", "title: 'a < b, <b>'"), id="title-with-marks"),
        pytest.param(("number: 1", "number: 1\nwarnings: [BADQACC]"), id="warning"),
    ],
)
def test_accepted(tmp_path: Path, change: Change) -> None:
    assert tiny_case(tmp_path, change).record.number == 1


# Wrong folders and files


@pytest.mark.parametrize("name", ["Falling-Box", "falling_box", "falling--box", "2-boxes", "box-"])
def test_bad_slug(tmp_path: Path, name: str) -> None:
    folder = write_case(tmp_path, slug=name)
    assert refused(folder) == [
        f"cases/{name}1:  | a folder named {name} | lower-case words joined by hyphens | rename the folder"
    ]


def test_folder_without_a_record(tmp_path: Path) -> None:
    folder = write_folder(tmp_path, SLUG, {"model.xml": MODEL})
    assert refused(folder) == [
        "cases/falling-box1:  | no case.yaml | a case.yaml in every folder of cases/ | add it, or remove the folder"
    ]


def test_file_named_but_missing_and_file_that_nothing_names(tmp_path: Path) -> None:
    folder = write_folder(tmp_path, SLUG, {"case.yaml": changed(RECORD, ("model.xml", "box.xml")), "box.mjcf": MODEL})
    assert refused(folder) == [
        "cases/falling-box/box.mjcf1:  | a file that the record does not name | case.yaml, claims.yaml "
        "and the files that the record names: box.xml | name it under `files`, or delete it",
        "3: model | box.xml, which does not exist | a file of the folder: box.mjcf | correct the name, or add the file",
    ]


def test_what_is_no_text_file(tmp_path: Path) -> None:
    folder = write_case(tmp_path)
    (folder / "meshes").mkdir()
    (folder / "model.xml").write_bytes(MODEL.replace("box", "b\xf6x").encode("latin-1"))
    assert refused(folder) == [
        "cases/falling-box/meshes1:  | a folder, or no file | plain files | put the file itself into the case's folder",
        "cases/falling-box/model.xml1:  | bytes that are not UTF-8 | text in UTF-8 | save the file as UTF-8",
    ]


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("index.md", "a name with .csv, .json, .mjs, .py, .txt, .xml or .yaml"),
        ("evidence.json", "a name that the site does not use itself"),
    ],
)
def test_a_file_that_the_site_would_publish_as_its_own(tmp_path: Path, name: str, expected: str) -> None:
    with pytest.raises(CaseError) as caught:
        script_case(tmp_path, ("script: script.py", f"script: script.py\nfiles: [{name}]"))
    assert expected in [problem.expected for problem in caught.value.problems]


# Wrong relations between cases


def test_number_used_twice(tmp_path: Path) -> None:
    write_case(tmp_path, slug="a-box")
    write_case(tmp_path, slug="b-box")
    assert told(read_cases(tmp_path / "cases")[1]) == [
        "cases/a-box/case.yaml1: number | 1, the number of b-box | a number of its own | let the newer take 2",
        "cases/b-box/case.yaml1: number | 1, the number of a-box | a number of its own | let the newer take 2",
    ]


def test_see_to_nowhere(tmp_path: Path) -> None:
    write_case(tmp_path, ("tags: [contact]", "tags: [contact]\nsee: [sliding-bax, falling-box]"))
    write_case(tmp_path, ("number: 1", "number: 2"), slug="sliding-box")
    known = "a case besides this one: sliding-box"
    assert told(read_cases(tmp_path / "cases")[1]) == [
        f"10: see[0] | sliding-bax, which is no case besides this one | {known} | write sliding-box",
        f"10: see[1] | falling-box, which is no case besides this one | {known} | write sliding-box",
    ]


def test_a_tag_that_misspells_one_of_several_cases(tmp_path: Path) -> None:
    for number, (slug, tag) in enumerate({"a": "contact", "b": "contact", "c": "contacts", "d": "tendon"}.items()):
        write_case(tmp_path, ("number: 1", f"number: {number + 1}"), ("[contact]", f"[{tag}]"), slug=f"{slug}-box")
    assert told(read_cases(tmp_path / "cases")[1]) == [
        "cases/c-box/case.yaml9: tags[0] | contacts, which no other case has | a topic: contact, or a new one"
        " | write contact"
    ]


def test_problems_of_all_cases_are_reported_together(tmp_path: Path) -> None:
    write_case(tmp_path, ("tags: [contact]", "tags: [Contact]"), slug="b-box")
    write_case(tmp_path, ("duration: 0.4", "duration: 0"), slug="a-box")
    (tmp_path / "cases" / "README.md").write_text("hello", encoding="utf-8")
    assert [said.split(" |")[0] for said in told(read_cases(tmp_path / "cases")[1])] == [
        "cases/README.md1: ",
        "cases/a-box/case.yaml11: run.duration",
        "cases/b-box/case.yaml9: tags[0]",
    ]
