"""Cases: what is read from a valid folder, and what an author is told about a wrong one, word for word."""

from __future__ import annotations

import functools
from collections.abc import Callable
from pathlib import Path
from textwrap import dedent

import pytest
from clinic.engine.script import run_script
from clinic.engine.signals import WARNINGS
from clinic.proof import evidence
from clinic.proof.evidence import collect
from clinic.record.case import Case, checks_of, load_case, load_cases
from clinic.record.fields import Check, Record
from clinic.record.problem import CaseError, listed
from helpers import (
    MODEL,
    RECORD,
    SLUG,
    SWEEP,
    changed,
    page_of,
    script_case,
    tiny_case,
    write_case,
    write_folder,
    write_script_case,
)

Change = tuple[str, str]
EDIT = "{find: ' contype=\"2\" conaffinity=\"2\"', replace: ''}"
RECORD_FIELDS = listed(Record.model_fields, 30)
CHECK_FIELDS = listed(Check.model_fields, 30)


def message_of(act: Callable[[], object]) -> str:
    with pytest.raises(CaseError) as caught:
        act()
    return str(caught.value)


def says(text: str) -> str:
    return dedent(text).strip("\n")


def wrong(name: str, changes: list[Change], message: str) -> object:
    return pytest.param(changes, says(message), id=name)


# What is read


def test_valid_case_is_read_with_its_files_and_lines(tmp_path: Path) -> None:
    case = tiny_case(tmp_path)

    assert case.slug == SLUG
    assert case.file == "cases/falling-box/case.yaml"
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


def test_checks_of_gives_every_check_with_its_place(tmp_path: Path) -> None:
    share = (
        "contacts: {path: ncon}",
        "contacts: {path: ncon}\n  share: {measure: fraction_of_starts, joint: free, index: 2, offset: [0, 1], "
        "count: 2, holds: {signal: height, above: 0}}",
    )
    found = {where: check.signal for where, check in checks_of(tiny_case(tmp_path, share).record)}
    assert found == {
        ("checks", "broken", 0): "contacts",
        ("checks", "fixed", 0): "height",
        ("signals", "share", "holds"): "height",
    }


def test_cases_are_sorted_by_number(tmp_path: Path) -> None:
    write_case(tmp_path, ("number: 1", "number: 12"), slug="a")
    write_case(tmp_path, ("number: 1", "number: 3"), slug="c")
    write_case(tmp_path, ("number: 1", "number: 7\nsee: [a, c]"), slug="b")
    assert [case.slug for case in load_cases(tmp_path / "cases")] == ["c", "b", "a"]


@pytest.mark.parametrize(
    "change",
    [
        pytest.param(("{duration: 0.4}", "{duration: 1, ctrl: {motor: 2}}"), id="constant-control"),
        pytest.param(("{duration: 0.4}", "{duration: 1, ctrl: {motor: [[0, 1], [0.5, -1]]}}"), id="control-over-time"),
        pytest.param(("{path: ncon}", "{expr: 2 * height}"), id="expression"),
        pytest.param(("{path: ncon}", "{measure: image_row, camera: side, geom: floor}"), id="image-row"),
        pytest.param(("between: [0.045, 0.051]", "equals: 0.05, within: 0.01"), id="equals-within"),
        pytest.param(("between: [0.045, 0.051]", "below: 0.051, window: [0.1, 0.2]"), id="window"),
        pytest.param(("replace: ''", "replace: ' contype=\"2\"'"), id="replace-by-part"),
        pytest.param(("title: A box falls through the floor", "title: 2024-01-02"), id="text-that-looks-like-a-date"),
        pytest.param(("number: 1", "number: 1\nwarnings: [BADQACC]"), id="warning"),
    ],
)
def test_accepted(tmp_path: Path, change: Change) -> None:
    assert tiny_case(tmp_path, change).record.number == 1


# Wrong records: the YAML and its fields


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        wrong(
            "unknown-key-at-the-top",
            [("lesson:", "leson:")],
            f"""
            cases/falling-box/case.yaml:1: lesson
              found:    nothing
              expected: the field `lesson`
              repair:   add `lesson:`
            cases/falling-box/case.yaml:8: leson
              found:    the unknown key `leson`
              expected: one of {RECORD_FIELDS}
              repair:   write `lesson`
            """,
        ),
        wrong(
            "unknown-key-like-none",
            [("number: 1", "number: 1\nxyzzy: 2")],
            f"""
            cases/falling-box/case.yaml:2: xyzzy
              found:    the unknown key `xyzzy`
              expected: one of {RECORD_FIELDS}
              repair:   remove the key
            """,
        ),
        wrong(
            "unknown-key-that-yaml-reads-as-true",
            [("number: 1", "number: 1\non: 2")],
            f"""
            cases/falling-box/case.yaml:2: on
              found:    the unknown key `on`
              expected: one of {RECORD_FIELDS}
              repair:   remove the key
            """,
        ),
        wrong(
            "unknown-key-in-a-check",
            [("take: max", "tke: max")],
            f"""
            cases/falling-box/case.yaml:17: checks.broken[0].tke
              found:    the unknown key `tke`
              expected: one of {CHECK_FIELDS}
              repair:   write `take`
            """,
        ),
        wrong(
            "unknown-key-in-a-signal",
            [("unit: m", "units: m")],
            """
            cases/falling-box/case.yaml:13: signals.height.units
              found:    the unknown key `units`
              expected: one of unit, label, path
              repair:   write `unit`
            """,
        ),
        wrong(
            "unknown-key-in-the-run",
            [("duration: 0.4", "duration: 0.4, timestep: 0.001")],
            """
            cases/falling-box/case.yaml:11: run.timestep
              found:    the unknown key `timestep`
              expected: one of duration, keyframe, qpos, qvel, ctrl
              repair:   remove the key
            """,
        ),
        wrong(
            "missing-field",
            [("cause: The masks share no bit.\n", "")],
            """
            cases/falling-box/case.yaml:1: cause
              found:    nothing
              expected: the field `cause`
              repair:   add `cause:`
            """,
        ),
        wrong(
            "missing-field-in-a-fix",
            [("title: Remove the masks of the floor\n    ", "")],
            """
            cases/falling-box/case.yaml:21: fixes[0].title
              found:    nothing
              expected: the field `title`
              repair:   add `title:`
            """,
        ),
        wrong(
            "text-for-a-number",
            [("number: 1", "number: one")],
            """
            cases/falling-box/case.yaml:1: number
              found:    "one"
              expected: a whole number
              repair:   correct the value
            """,
        ),
        wrong(
            "quoted-number",
            [("equals: 0", 'equals: "0"')],
            """
            cases/falling-box/case.yaml:17: checks.broken[0].equals
              found:    "0"
              expected: a number
              repair:   write it without quotes
            """,
        ),
        wrong(
            "number-that-yaml-takes-for-text",
            [("equals: 0", "equals: -1e3")],
            """
            cases/falling-box/case.yaml:17: checks.broken[0].equals
              found:    "-1e3"
              expected: a number
              repair:   write -1.0e+3
            """,
        ),
        wrong(
            "number-beyond-all-measure",
            [("number: 1", "number: 100000")],
            """
            cases/falling-box/case.yaml:1: number
              found:    100000
              expected: a number of 99999 at most
              repair:   correct the value
            """,
        ),
        wrong(
            "label-beyond-all-measure",
            [("label: height of the box", f"label: {'a' * 301}")],
            """
            cases/falling-box/case.yaml:13: signals.height.label
              found:    301 characters
              expected: 300 at most
              repair:   say it in fewer words
            """,
        ),
        wrong(
            "title-of-nothing-that-is-seen",
            [("title: A box falls through the floor", 'title: " \\u200b"')],
            """
            cases/falling-box/case.yaml:2: title
              found:    " \u200b"
              expected: text that is not empty
              repair:   correct the value
            """,
        ),
        wrong(
            "files-beside-a-model",
            [("model: model.xml", "model: model.xml\nfiles: [mesh.xml]")],
            """
            cases/falling-box/case.yaml:1:
              found:    files beside model: mesh.xml
              expected: `files` beside `script`
              repair:   remove `files`; write out in the model what they hold
            """,
        ),
        wrong(
            "empty-field",
            [("lesson: Look at the masks.", "lesson:")],
            """
            cases/falling-box/case.yaml:8: lesson
              found:    nothing
              expected: a value
              repair:   write one, or remove the key
            """,
        ),
        wrong(
            "text-for-a-list",
            [("tags: [contact]", "tags: contact")],
            """
            cases/falling-box/case.yaml:9: tags
              found:    "contact"
              expected: a list
              repair:   correct the value
            """,
        ),
        wrong(
            "tag-with-a-space",
            [("tags: [contact]", "tags: [contact, Two Words]")],
            """
            cases/falling-box/case.yaml:9: tags[1]
              found:    "Two Words"
              expected: lower-case words joined by hyphens
              repair:   rename it
            """,
        ),
        wrong(
            "duration-of-zero",
            [("duration: 0.4", "duration: 0")],
            """
            cases/falling-box/case.yaml:11: run.duration
              found:    0
              expected: a number greater than 0
              repair:   correct the value
            """,
        ),
        wrong(
            "control-that-is-no-number",
            [("{duration: 0.4}", "{duration: 0.4, ctrl: {motor: full}}")],
            """
            cases/falling-box/case.yaml:11: run.ctrl.motor
              found:    "full"
              expected: a number, or a list of [time, value] pairs
              repair:   correct the value
            """,
        ),
        wrong(
            "two-comparisons",
            [("equals: 0", "equals: 0, below: 1")],
            """
            cases/falling-box/case.yaml:17: checks.broken[0]
              found:    below and equals
              expected: exactly one of above, below, between, equals
              repair:   keep one comparison a check
            """,
        ),
        wrong(
            "no-comparison",
            [(", equals: 0", "")],
            """
            cases/falling-box/case.yaml:17: checks.broken[0]
              found:    no comparison
              expected: exactly one of above, below, between, equals
              repair:   keep one comparison a check
            """,
        ),
        wrong(
            "within-without-equals",
            [("between: [0.045, 0.051]", "above: 0.045, within: 0.001")],
            """
            cases/falling-box/case.yaml:19: checks.fixed[0]
              found:    within without equals
              expected: `within` beside `equals`
              repair:   add `equals`, or remove `within`
            """,
        ),
        wrong(
            "reversed-between",
            [("[0.045, 0.051]", "[0.051, 0.045]")],
            """
            cases/falling-box/case.yaml:19: checks.fixed[0]
              found:    between: [0.051, 0.045]
              expected: a low bound below the high bound
              repair:   swap the two numbers
            """,
        ),
        wrong(
            "window-of-one-number",
            [("take: max", "window: [1]")],
            """
            cases/falling-box/case.yaml:17: checks.broken[0].window
              found:    [1]
              expected: two numbers
              repair:   correct the value
            """,
        ),
        wrong(
            "unknown-take",
            [("take: max", "take: maximum")],
            """
            cases/falling-box/case.yaml:17: checks.broken[0].take
              found:    "maximum"
              expected: 'final', 'first', 'min', 'max', 'mean', 'span' or 'onset'
              repair:   correct the value
            """,
        ),
        wrong(
            "signal-without-a-source",
            [("{path: ncon}", "{unit: m}")],
            """
            cases/falling-box/case.yaml:14: signals.contacts
              found:    {"unit": "m"}
              expected: one of `path`, `expr`, `measure: fraction_of_starts`, `measure: image_row`
              repair:   say where the number comes from
            """,
        ),
        wrong(
            "signal-with-two-sources",
            [("{path: ncon}", "{path: ncon, expr: 2 * height}")],
            """
            cases/falling-box/case.yaml:14: signals.contacts.expr
              found:    the unknown key `expr`
              expected: one of unit, label, path
              repair:   remove the key
            """,
        ),
        wrong(
            "model-and-script",
            [("model: model.xml", "model: model.xml\nscript: script.py")],
            """
            cases/falling-box/case.yaml:1:
              found:    both model and script
              expected: exactly one of `model`, `script`
              repair:   name the file that holds the bug
            """,
        ),
        wrong(
            "neither-model-nor-script",
            [("model: model.xml\n", "")],
            """
            cases/falling-box/case.yaml:1:
              found:    neither model nor script
              expected: exactly one of `model`, `script`
              repair:   name the file that holds the bug
            """,
        ),
        wrong(
            "model-without-a-run",
            [("run: {duration: 0.4}\n", "")],
            """
            cases/falling-box/case.yaml:1:
              found:    model without run
              expected: `run` beside `model`, and only there
              repair:   add `run: {duration: 1}`
            """,
        ),
        wrong(
            "empty-find",
            [(EDIT, "{find: '', replace: x}")],
            """
            cases/falling-box/case.yaml:24: fixes[0].edits[0].find
              found:    ""
              expected: text that is not empty
              repair:   correct the value
            """,
        ),
        wrong(
            "edit-that-changes-nothing",
            [(EDIT, "{find: contype, replace: contype}")],
            """
            cases/falling-box/case.yaml:24: fixes[0].edits[0]
              found:    the edit changes nothing
              expected: a `replace` that differs from `find`
              repair:   write the repaired text
            """,
        ),
        wrong(
            "fix-without-edits",
            [("- " + EDIT, "[]")],
            """
            cases/falling-box/case.yaml:23: fixes[0].edits
              found:    []
              expected: 1 or more items
              repair:   correct the value
            """,
        ),
        wrong(
            "key-twice",
            [("lesson:", "title: Another\nlesson:")],
            """
            cases/falling-box/case.yaml:8:
              found:    the key title twice
              expected: each key once
              repair:   remove or rename one
            """,
        ),
        wrong(
            "alias",
            [("cause: The masks share no bit.", "cause: &text The masks share no bit."), ("Share a bit.", "*text")],
            """
            cases/falling-box/case.yaml:7:
              found:    the alias *text
              expected: no aliases
              repair:   write the value out
            """,
        ),
        wrong(
            "yaml-syntax",
            [("lesson: Look at the masks.", "lesson: Look: at the masks.")],
            """
            cases/falling-box/case.yaml:8:
              found:    mapping values are not allowed here
              expected: valid YAML
              repair:   quote text that holds `: `, `#`, `{` or `[`; indent by two spaces
            """,
        ),
    ],
)
def test_wrong_field(tmp_path: Path, changes: list[Change], message: str) -> None:
    folder = write_case(tmp_path, *changes)
    assert message_of(lambda: load_case(folder)) == message


@pytest.mark.parametrize("text", [pytest.param("", id="empty-file"), pytest.param("- a\n- b\n", id="list")])
def test_no_mapping(tmp_path: Path, text: str) -> None:
    folder = write_folder(tmp_path, SLUG, {"case.yaml": text})
    assert message_of(lambda: load_case(folder)) == says("""
        cases/falling-box/case.yaml:1:
          found:    no mapping
          expected: `field: value` lines
          repair:   start with `number:` and `title:`
        """)


def test_several_mistakes_are_reported_together_sorted_by_line(tmp_path: Path) -> None:
    folder = write_case(
        tmp_path,
        ("title: Halve the timestep", "titel: Halve the timestep"),
        ("number: 1", "number: 0"),
        ("[0.045, 0.051]", "[1, 0]"),
        ("tags: [contact]", "tags: []"),
    )
    assert message_of(lambda: load_case(folder)) == says("""
        cases/falling-box/case.yaml:1: number
          found:    0
          expected: a number of 1 or more
          repair:   correct the value
        cases/falling-box/case.yaml:9: tags
          found:    []
          expected: 1 or more items
          repair:   correct the value
        cases/falling-box/case.yaml:19: checks.fixed[0]
          found:    between: [1.0, 0.0]
          expected: a low bound below the high bound
          repair:   swap the two numbers
        cases/falling-box/case.yaml:26: refuted[0].title
          found:    nothing
          expected: the field `title`
          repair:   add `title:`
        cases/falling-box/case.yaml:27: refuted[0].titel
          found:    the unknown key `titel`
          expected: one of id, title, edits, why
          repair:   write `title`
        """)


# Wrong folders and files


@pytest.mark.parametrize("name", ["Falling-Box", "falling_box", "falling--box", "2-boxes", "box-"])
def test_bad_slug(tmp_path: Path, name: str) -> None:
    folder = write_case(tmp_path, slug=name)
    assert message_of(lambda: load_case(folder)) == says(f"""
        cases/{name}:1:
          found:    a folder named {name}
          expected: lower-case words joined by hyphens
          repair:   rename the folder
        """)


def test_folder_without_a_record(tmp_path: Path) -> None:
    folder = write_folder(tmp_path, SLUG, {"model.xml": MODEL})
    assert message_of(lambda: load_case(folder)) == says("""
        cases/falling-box:1:
          found:    no case.yaml
          expected: a case.yaml in every folder of cases/
          repair:   add it, or remove the folder
        """)


def test_file_named_but_missing(tmp_path: Path) -> None:
    folder = write_folder(tmp_path, SLUG, {"case.yaml": changed(RECORD, ("model.xml", "box.xml")), "box.mjcf": MODEL})
    assert message_of(lambda: load_case(folder)) == says("""
        cases/falling-box/box.mjcf:1:
          found:    a file that the record does not name
          expected: case.yaml and the files it names: box.xml
          repair:   name it under `files`, or delete it
        cases/falling-box/case.yaml:3: model
          found:    box.xml, which does not exist
          expected: a file of the folder: box.mjcf
          repair:   correct the name, or add the file
        """)


def test_orphan_file(tmp_path: Path) -> None:
    folder = write_case(tmp_path)
    (folder / "notes.txt").write_text("later", encoding="utf-8")
    assert message_of(lambda: load_case(folder)) == says("""
        cases/falling-box/notes.txt:1:
          found:    a file that the record does not name
          expected: case.yaml and the files it names: model.xml
          repair:   name it under `files`, or delete it
        """)


def test_subfolder(tmp_path: Path) -> None:
    folder = write_case(tmp_path)
    (folder / "meshes").mkdir()
    assert message_of(lambda: load_case(folder)) == says("""
        cases/falling-box/meshes:1:
          found:    a folder
          expected: plain files
          repair:   put the file itself into the case's folder
        """)


def test_symbolic_link(tmp_path: Path) -> None:
    folder = write_case(tmp_path)
    (folder / "copy.xml").symlink_to(folder / "model.xml")
    assert message_of(lambda: load_case(folder)) == says("""
        cases/falling-box/copy.xml:1:
          found:    a symbolic link
          expected: plain files
          repair:   put the file itself into the case's folder
        """)


def test_file_that_is_not_utf_8(tmp_path: Path) -> None:
    folder = write_case(tmp_path)
    (folder / "model.xml").write_bytes(MODEL.replace("box", "b\xf6x").encode("latin-1"))
    assert message_of(lambda: load_case(folder)) == says("""
        cases/falling-box/model.xml:1:
          found:    bytes that are not UTF-8
          expected: text in UTF-8
          repair:   save the file as UTF-8
        """)


# Wrong references within a record


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        wrong(
            "check-of-an-unknown-signal",
            [("{signal: height, between", "{signal: hieght, between")],
            """
            cases/falling-box/case.yaml:19: checks.fixed[0].signal
              found:    hieght, which is no signal
              expected: a signal: height, contacts
              repair:   write height
            """,
        ),
        wrong(
            "bad-expression",
            [("{path: ncon}", "{expr: height if height else 0}")],
            """
            cases/falling-box/case.yaml:14: signals.contacts.expr
              found:    height if height else 0
              expected: numbers, names, + - * / **, parentheses and functions
              repair:   write plain arithmetic
            """,
        ),
        wrong(
            "expression-over-an-unknown-name",
            [("{path: ncon}", "{expr: 2 * heigth}")],
            """
            cases/falling-box/case.yaml:14: signals.contacts.expr
              found:    heigth, which is no path signal
              expected: a path signal: height
              repair:   write height
            """,
        ),
        wrong(
            "expression-with-too-many-arguments",
            [("{path: ncon}", "{path: ncon}\n  root: {expr: 'sqrt(contacts, height)'}")],
            """
            cases/falling-box/case.yaml:15: signals.root.expr
              found:    sqrt(contacts, height)
              expected: sqrt with 1 argument
              repair:   write plain arithmetic
            """,
        ),
        wrong(
            "starts-judged-by-an-expression",
            [
                (
                    "{path: ncon}",
                    "{path: ncon}\n  twice: {expr: 2 * height}\n  share: {measure: fraction_of_starts, joint: free, "
                    "index: 2, offset: [0, 1], count: 2, holds: {signal: twice, above: 0}}",
                )
            ],
            """
            cases/falling-box/case.yaml:16: signals.share.holds.signal
              found:    twice, which is no path signal
              expected: a path signal: height, contacts
              repair:   correct the name
            """,
        ),
        wrong(
            "id-taken",
            [("id: small-step", "id: share-a-bit")],
            """
            cases/falling-box/case.yaml:26: refuted[0].id
              found:    share-a-bit, which is taken
              expected: an id used once; not broken
              repair:   rename it
            """,
        ),
        wrong(
            "id-broken",
            [("id: share-a-bit", "id: broken")],
            """
            cases/falling-box/case.yaml:21: fixes[0].id
              found:    broken, which is taken
              expected: an id used once; not broken
              repair:   rename it
            """,
        ),
        wrong(
            "unknown-warning",
            [("number: 1", "number: 1\nwarnings: [BADQAC]")],
            f"""
            cases/falling-box/case.yaml:2: warnings[0]
              found:    BADQAC, which is no MuJoCo warning
              expected: a MuJoCo warning: {", ".join(WARNINGS)}
              repair:   write BADQACC
            """,
        ),
    ],
)
def test_wrong_reference(tmp_path: Path, changes: list[Change], message: str) -> None:
    folder = write_case(tmp_path, *changes)
    assert message_of(lambda: load_case(folder)) == message


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("evil.html", "a name with .csv, .json, .mjs, .py, .txt, .xml or .yaml"),
        ("evil.svg", "a name with .csv, .json, .mjs, .py, .txt, .xml or .yaml"),
        ("index.md", "a name with .csv, .json, .mjs, .py, .txt, .xml or .yaml"),
        ("evidence.json", "a name that the site does not use itself"),
        ("playground.json", "a name that the site does not use itself"),
    ],
)
def test_a_file_that_the_site_would_publish_as_its_own(tmp_path: Path, name: str, expected: str) -> None:
    folder = write_script_case(tmp_path, ("script: script.py", f"script: script.py\nfiles: [{name}]"))
    (folder / name).write_text("{}", encoding="utf-8")
    with pytest.raises(CaseError) as caught:
        load_case(folder)
    (told,) = caught.value.problems
    assert (told.where, told.expected) == ("files[0]", expected)


@pytest.mark.parametrize("unit", ["mm", "cm", "deg", "ms", "mm/s", "°"])
def test_a_unit_that_mujoco_does_not_compute_in(tmp_path: Path, unit: str) -> None:
    with pytest.raises(CaseError) as caught:
        tiny_case(tmp_path, ('body(box).xpos[2]", unit: m', f'body(box).xpos[2]", unit: {unit}'))
    assert [problem.where for problem in caught.value.problems] == ["signals.height.unit"]


@pytest.mark.parametrize("numbers", ["start: 0, stop: 8, count: 3", "start: -5, stop: 8, count: 3", "values: [0, 1]"])
def test_a_logarithmic_scale_has_no_zero(tmp_path: Path, numbers: str) -> None:
    with pytest.raises(CaseError) as caught:
        tiny_case(
            tmp_path,
            ("no_sweep: The masks are not a number.\n", SWEEP),
            ("values: [1, 2, 4, 8]", f"{numbers}, scale: log"),
        )
    [problem] = caught.value.problems
    assert (problem.where, problem.found) == (
        "sweep.fall.vary[0]",
        "a logarithmic scale from or to zero or less",
    )


# Wrong relations between cases


def test_number_used_twice(tmp_path: Path) -> None:
    write_case(tmp_path, slug="a-box")
    write_case(tmp_path, slug="b-box")
    assert message_of(lambda: load_cases(tmp_path / "cases")) == says("""
        cases/a-box/case.yaml:1: number
          found:    1, the number of b-box
          expected: a number of its own
          repair:   let the newer take 2
        cases/b-box/case.yaml:1: number
          found:    1, the number of a-box
          expected: a number of its own
          repair:   let the newer take 2
        """)


def test_see_to_nowhere(tmp_path: Path) -> None:
    write_case(tmp_path, ("tags: [contact]", "tags: [contact]\nsee: [sliding-bax, falling-box]"))
    write_case(tmp_path, ("number: 1", "number: 2"), slug="sliding-box")
    assert message_of(lambda: load_cases(tmp_path / "cases")) == says("""
        cases/falling-box/case.yaml:10: see[0]
          found:    sliding-bax, which is no case
          expected: a case: sliding-box
          repair:   write sliding-box
        cases/falling-box/case.yaml:10: see[1]
          found:    falling-box, this very case
          expected: a case: sliding-box
          repair:   remove it
        """)


def test_a_tag_that_misspells_one_of_several_cases(tmp_path: Path) -> None:
    for number, (slug, tag) in enumerate({"a": "contact", "b": "contact", "c": "contacts", "d": "tendon"}.items()):
        write_case(tmp_path, ("number: 1", f"number: {number + 1}"), ("[contact]", f"[{tag}]"), slug=f"{slug}-box")
    assert message_of(lambda: load_cases(tmp_path / "cases")) == says("""
        cases/c-box/case.yaml:9: tags[0]
          found:    contacts, which no other case has
          expected: a topic: contact, or a new one
          repair:   write contact
        """)


def test_file_beside_the_folders(tmp_path: Path) -> None:
    write_case(tmp_path)
    (tmp_path / "cases" / "README.md").write_text("hello", encoding="utf-8")
    assert message_of(lambda: load_cases(tmp_path / "cases")) == says("""
        cases/README.md:1:
          found:    a file
          expected: only folders, one a case
          repair:   move it into a case's folder
        """)


def test_problems_of_all_cases_are_reported_together(tmp_path: Path) -> None:
    write_case(tmp_path, ("tags: [contact]", "tags: [Contact]"), slug="b-box")
    write_case(tmp_path, ("duration: 0.4", "duration: 0"), slug="a-box")
    places = [line.split()[0] for line in message_of(lambda: load_cases(tmp_path / "cases")).splitlines()[::4]]
    assert places == ["cases/a-box/case.yaml:11:", "cases/b-box/case.yaml:9:"]


# What only the model can tell


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        wrong(
            "signal-names-a-missing-body",
            [("body(box).xpos[2]", "body(bix).xpos[2]")],
            """
            cases/falling-box/case.yaml:13: signals.height.path
              found:    the body bix, which the model does not have
              expected: a body: world, box
              repair:   write box
            """,
        ),
        wrong(
            "signal-names-a-missing-field",
            [("body(box).xpos[2]", "joint(free).qpso[2]")],
            """
            cases/falling-box/case.yaml:13: signals.height.path
              found:    joint(free).qpso, which does not exist
              expected: a field of joint(free): cdof, cdof_dot, id, name, plastic, qLDiagInv, qacc, \
qacc_smooth, qacc_warmstart, qfrc_actuator, qfrc_applied, qfrc_bias, and 8 more
              repair:   write qpos
            """,
        ),
        wrong(
            "index-out-of-range",
            [("body(box).xpos[2]", "body(box).xpos[3]")],
            """
            cases/falling-box/case.yaml:13: signals.height.path
              found:    body(box).xpos[3]
              expected: 1 index(es) from 0 into 3 numbers
              repair:   correct the index
            """,
        ),
        wrong(
            "bad-path",
            [("body(box).xpos[2]", "body(box.xpos[2]")],
            """
            cases/falling-box/case.yaml:13: signals.height.path
              found:    body(box.xpos[2]
              expected: a path such as body(box).xpos[2], ncon or sensor(force)[0]
              repair:   see *Signal paths*
            """,
        ),
        wrong(
            "edit-that-matches-nothing",
            [(EDIT, "{find: 'contype=\"3\"', replace: ''}")],
            """
            cases/falling-box/case.yaml:24: fixes[0].edits[0].find
              found:    text that does not occur in model.xml: 'contype="3"'
              expected: text that occurs exactly once
              repair:   copy the text from model.xml, character by character
            """,
        ),
        wrong(
            "edit-that-matches-twice",
            [(EDIT, "{find: '=\"2\"', replace: '=\"1\"'}")],
            """
            cases/falling-box/case.yaml:24: fixes[0].edits[0].find
              found:    text that occurs 2 times in model.xml: '="2"'
              expected: text that occurs exactly once
              repair:   lengthen `find` until it names one place
            """,
        ),
        wrong(
            "edit-whose-text-an-earlier-one-removed",
            [(EDIT, EDIT + "\n      - {find: 'contype=\"2\"', replace: ''}")],
            """
            cases/falling-box/case.yaml:25: fixes[0].edits[1].find
              found:    text that does not occur in model.xml after the edits before it: 'contype="2"'
              expected: text that occurs exactly once
              repair:   copy the text from model.xml, character by character
            """,
        ),
        wrong(
            "fix-whose-model-does-not-compile",
            [("replace: ''", "replace: ' friktion=\"1\"'")],
            """
            cases/falling-box/case.yaml:23: fixes[0].edits
              found:    after these edits: XML Error: Schema violation: unrecognized attribute: 'friktion' Element \
'geom', line 5
              expected: XML that MuJoCo compiles
              repair:   correct `replace`
            """,
        ),
        wrong(
            "unknown-keyframe-and-actuator",
            [("{duration: 0.4}", "{duration: 0.4, keyframe: throw, ctrl: {motor: 1}}")],
            """
            cases/falling-box/case.yaml:11: run.ctrl.motor
              found:    the actuator motor, which the model does not have
              expected: an actuator: none
              repair:   correct the name, or name the actuator in the model
            cases/falling-box/case.yaml:11: run.keyframe
              found:    the key throw, which the model does not have
              expected: a key: none
              repair:   correct the name, or name the key in the model
            """,
        ),
        wrong(
            "start-of-a-free-joint-as-one-number",
            [("{duration: 0.4}", "{duration: 0.4, qpos: {free: 1}}")],
            """
            cases/falling-box/case.yaml:11: run.qpos.free
              found:    a joint with 7 numbers
              expected: a hinge or slide joint
              repair:   use a keyframe
            """,
        ),
        wrong(
            "duration-below-one-step",
            [("duration: 0.4", "duration: 0.0001")],
            """
            cases/falling-box/case.yaml:11: run.duration
              found:    0.0001 s at a timestep of 0.002 s
              expected: 1 to 2000000 steps
              repair:   change the duration or the timestep
            """,
        ),
        wrong(
            "missing-camera",
            [("camera: side", "camera: sid")],
            """
            cases/falling-box/case.yaml:33: picture.camera
              found:    the camera sid, which the model does not have
              expected: a camera: side
              repair:   write side
            """,
        ),
    ],
)
def test_wrong_for_the_model(tmp_path: Path, changes: list[Change], message: str) -> None:
    case = tiny_case(tmp_path, *changes)
    assert message_of(lambda: collect(case)) == message


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        wrong(
            "bad-element",
            [("<freejoint", "<fredjoint")],
            """
            cases/falling-box/model.xml:7:
              found:    XML Error: Schema violation: unrecognized element Element 'fredjoint', line 7
              expected: XML that MuJoCo compiles
              repair:   correct the model
            """,
        ),
        wrong(
            "body-without-mass",
            [('mass="1"', 'mass="0"')],
            """
            cases/falling-box/model.xml:6:
              found:    Error: mass and inertia of moving bodies must be larger than mjMINVAL Element name 'box', \
id 1, line 6
              expected: XML that MuJoCo compiles
              repair:   correct the model
            """,
        ),
        wrong(
            "unclosed-element",
            [("    </body>\n", "")],
            """
            cases/falling-box/model.xml:9:
              found:    mismatched tag, in the <body> of line 6
              expected: well-formed XML
              repair:   correct the model
            """,
        ),
    ],
)
def test_model_that_does_not_compile(tmp_path: Path, changes: list[Change], message: str) -> None:
    case = tiny_case(tmp_path, model=changed(MODEL, *changes))
    assert message_of(lambda: collect(case)) == message


def test_name_that_an_edit_takes_away(tmp_path: Path) -> None:
    case = tiny_case(
        tmp_path,
        (
            "find: 'timestep=\"0.002\"', replace: 'timestep=\"0.001\"'",
            "find: '<body name=\"box\"', replace: '<body name=\"crate\"'",
        ),
    )
    assert message_of(lambda: collect(case)) == says("""
        cases/falling-box/case.yaml:13: signals.height.path
          found:    after the edits of small-step: the body box, which the model does not have
          expected: a body: world, crate
          repair:   correct the name, or name the body in the model
        """)


# What only running can tell


@pytest.fixture
def half_a_second(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(evidence, "run_script", functools.partial(run_script, seconds=0.5))


@pytest.mark.usefixtures("half_a_second")
def test_script_that_hangs(tmp_path: Path) -> None:
    case = script_case(tmp_path, script="error = 0.5\nprint('error =', error)\nwhile error:\n    pass\n")
    assert message_of(lambda: collect(case)) == says("""
        cases/odd-script/case.yaml:3: script
          found:    script.py: still running after 0.5 s
          expected: a script that ends by itself
          repair:   bound its loops by steps
        """)


def test_script_that_raises_and_fix_that_raises(tmp_path: Path) -> None:
    case = script_case(tmp_path, ("replace: '0.0'", "replace: 'half'"), script="import sys\n\nprint(undefined, 0.5)\n")
    assert message_of(lambda: collect(case)) == says("""
        cases/odd-script/case.yaml:3: script
          found:    script.py: NameError: name 'undefined' is not defined (line 3 of script.py)
          expected: a script that ends by itself
          repair:   run it by hand and mend it
        cases/odd-script/case.yaml:21: fixes[0].edits
          found:    script.py after these edits: NameError: name 'undefined' is not defined (line 3 of script.py)
          expected: a script that ends by itself
          repair:   run it by hand and mend it
        """)


def test_snippet_that_raises(tmp_path: Path) -> None:
    case = tiny_case(
        tmp_path, ("lesson:", "snippet: |\n  text = open('model.xml').read()\n  print(text.size)\nlesson:")
    )
    assert message_of(lambda: collect(case)) == says("""
        cases/falling-box/case.yaml:8: snippet
          found:    AttributeError: 'str' object has no attribute 'size' (line 2 of snippet.py)
          expected: code that runs as it stands
          repair:   run it by hand and mend it
        """)


def test_path_into_mujoco_in_a_script_case(tmp_path: Path) -> None:
    case = script_case(tmp_path, ("printed(error)", "ncon"))
    assert message_of(lambda: collect(case)) == says("""
        cases/odd-script/case.yaml:12: signals.error.path
          found:    ncon
          expected: printed(name): this case is a script
          repair:   let the script print it
        """)


def test_samples_that_do_not_pair_up(tmp_path: Path) -> None:
    two = (
        "error: {path: printed(error), unit: m}",
        "error: {path: printed(error)}\n  other: {path: printed(first error)}\n  sum: {expr: error + other}",
    )
    case = script_case(
        tmp_path, two, script='print("error = 0.5\\nerror = 2\\nerror = 3\\nfirst error = 1\\nfirst error = 2")'
    )
    assert message_of(lambda: collect(case)) == says("""
        cases/odd-script/case.yaml:14: signals.sum.expr
          found:    samples that do not pair up: error has 3, other has 2
          expected: signals with equally many samples
          repair:   print each as often as the others
        """)


@pytest.mark.parametrize(
    ("scene", "message"),
    [
        pytest.param(
            MODEL.replace('"side"', '"top"'),
            says("""
            cases/odd-script/case.yaml:25: picture.camera
              found:    the camera side, which the model does not have
              expected: a camera: top
              repair:   correct the name, or name the camera in the model
            """),
            id="missing-camera",
        ),
        pytest.param(
            MODEL.replace("<freejoint", "<fredjoint"),
            says("""
            cases/odd-script/scene.xml:7:
              found:    XML Error: Schema violation: unrecognized element Element 'fredjoint', line 7
              expected: XML that MuJoCo compiles
              repair:   correct the model
            """),
            id="does-not-compile",
        ),
    ],
)
def test_wrong_scene_of_a_script(tmp_path: Path, scene: str, message: str) -> None:
    folder = write_script_case(
        tmp_path,
        ("script: script.py", "script: script.py\nfiles: [scene.xml]"),
        ("camera: side", "camera: side, scene: scene.xml"),
    )
    (folder / "scene.xml").write_text(scene, encoding="utf-8")
    assert message_of(lambda: collect(load_case(folder))) == message


# What only the evidence can tell


@pytest.mark.parametrize(
    ("field", "found", "expected", "repair"),
    [
        pytest.param(
            "borken.height.final",
            "{{ borken.height.final }}: borken is no variant",
            "a variant: broken, share-a-bit, small-step",
            "write broken",
            id="variant",
        ),
        pytest.param(
            "broken.hieght.final",
            "{{ broken.hieght.final }}: hieght is no signal",
            "a signal: height, contacts, timestep, duration, warning",
            "write height",
            id="signal",
        ),
        pytest.param(
            "broken.height.last",
            "{{ broken.height.last }}: last is no take",
            "a take: final, first, min, max, mean, span, onset",
            "correct the field",
            id="take",
        ),
        pytest.param(
            "broken.height.final | deg",
            "the filter deg on broken.height.final in m",
            "mm, cm, 2, 3, ...: the digits to keep",
            "change the filter",
            id="filter",
        ),
    ],
)
def test_prose_with_an_unknown_field(tmp_path: Path, field: str, found: str, expected: str, repair: str) -> None:
    case = tiny_case(tmp_path, ("The masks share no bit.", f"It is {{{{ {field} }}}}."))
    assert message_of(lambda: page_of(case, collect(case))) == (
        f"cases/falling-box/case.yaml:6: cause\n  found:    {found}\n  expected: {expected}\n  repair:   {repair}"
    )


def test_case_is_usable_without_its_folder(tmp_path: Path) -> None:
    case: Case = tiny_case(tmp_path)
    (tmp_path / "cases" / SLUG / "model.xml").unlink()
    assert set(collect(case).variants) == {"broken", "share-a-bit", "small-step"}
