"""What an author is told of a wrong record."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.record.families import families
from clinic.record.fields import Record
from clinic.record.parts import WARNINGS, Check
from clinic.record.problem import listed
from helpers import SWEEP, changed, refused, write_case

Change = tuple[str, str]
RECORD_FIELDS = listed(Record.model_fields, 30)
CHECK_FIELDS = listed(Check.model_fields, 30)
EDIT = "{find: ' contype=\"2\" conaffinity=\"2\"', replace: ''}"
SHARE = (
    "{path: ncon}\n  twice: {expr: 2 * height}\n  share: {measure: fraction_of_starts, joint: free, index: 2, "
    "offset: [0, 1], count: 2, holds: {signal: %s, above: 0}}"
)


def wrong(name: str, old: str, new: str, *problems: str) -> object:
    return pytest.param((old, new), list(problems), id=name)


@pytest.mark.parametrize(
    ("change", "problems"),
    [
        wrong(
            "unknown-key-at-the-top",
            "lesson:",
            "leson:",
            "1: lesson | nothing | the field `lesson` | add `lesson:`",
            f"8: leson | the unknown key `leson` | one of {RECORD_FIELDS} | write `lesson`",
        ),
        wrong(
            "unknown-key-like-none",
            "number: 1",
            "number: 1\non: 2",
            f"2: on | the unknown key `on` | one of {RECORD_FIELDS} | remove the key",
        ),
        wrong(
            "unknown-key-in-a-check",
            "take: max",
            "tke: max",
            f"17: checks.broken[0].tke | the unknown key `tke` | one of {CHECK_FIELDS} | write `take`",
        ),
        wrong(
            "unknown-key-in-a-signal",
            "unit: m",
            "units: m",
            "13: signals.height.units | the unknown key `units` | one of unit, label, said, path | write `unit`",
        ),
        wrong(
            "unknown-key-in-the-run",
            "duration: 0.4",
            "duration: 0.4, timestep: 0.001",
            "11: run.timestep | the unknown key `timestep` | one of duration, keyframe, qpos, qvel, ctrl"
            " | remove the key",
        ),
        wrong(
            "missing-field-in-a-fix",
            "title: Remove the masks of the floor\n    ",
            "",
            "21: fixes[0].title | nothing | the field `title` | add `title:`",
        ),
        wrong(
            "contrast-without-checks",
            "fixes:\n",
            "trials: [{id: drop, title: Dropped, contrast: true}]\nfixes:\n",
            "20: trials[0] | a `contrast` without `checks` | `checks` of its own | add `checks`, or remove `contrast`",
        ),
        wrong(
            "release-that-is-none",
            "fixes:\n",
            'older: {"3.4": because}\nfixes:\n',
            "20: older.3.4 | 3.4, which names no releases | such as <3.13 or ==3.9.* | correct it",
        ),
        wrong(
            "bars-in-a-value",
            "number: 1",
            "number: 1\nfamily: a||b",
            "2: family | a||b, which is no family | one of " + ", ".join(families()) + " | write wrong-numbers",
        ),
        wrong(
            "quoted-number",
            "equals: 0",
            'equals: "0"',
            '17: checks.broken[0].equals | "0" | a number | write its digits, without quotes',
        ),
        wrong(
            "number-in-another-base",
            "number: 1",
            "number: 0x1F",
            '1: number | "0x1F" | a whole number | write its digits, without quotes',
        ),
        wrong(
            "number-beyond-all-measure",
            "number: 1",
            "number: 100000",
            "1: number | 100000 | less than or equal to 99999 | correct the value",
        ),
        wrong(
            "title-of-nothing-that-is-seen",
            "title: A box falls through the floor",
            'title: " \\u200b"',
            '2: title | " \u200b" | text that is not empty | correct the value',
        ),
        wrong(
            "empty-field",
            "lesson: Look at the masks.",
            "lesson:",
            "8: lesson | nothing | a value | write one, or remove the key",
        ),
        wrong(
            "text-for-a-list", "tags: [contact]", "tags: contact", '9: tags | "contact" | a list | correct the value'
        ),
        wrong(
            "tag-with-a-space",
            "tags: [contact]",
            "tags: [contact, Two Words]",
            '9: tags[1] | "Two Words" | lower-case words joined by hyphens | correct the value',
        ),
        wrong(
            "duration-of-zero",
            "duration: 0.4",
            "duration: 0",
            "11: run.duration | 0 | greater than 0 | correct the value",
        ),
        wrong(
            "control-that-is-no-number",
            "{duration: 0.4}",
            "{duration: 0.4, ctrl: {motor: full}}",
            '11: run.ctrl.motor | "full" | a number, or a list of [time, value] pairs | correct the value',
        ),
        wrong(
            "two-comparisons",
            "equals: 0",
            "equals: 0, below: 1",
            "17: checks.broken[0] | below and equals | exactly one of above, below, between, equals"
            " | keep one comparison a check",
        ),
        wrong(
            "within-without-equals",
            "between: [0.045, 0.051]",
            "above: 0.045, within: 0.001",
            "19: checks.fixed[0] | within without equals | `within` beside `equals` | add `equals`, or remove `within`",
        ),
        wrong(
            "reversed-between",
            "[0.045, 0.051]",
            "[0.051, 0.045]",
            "19: checks.fixed[0] | between: [0.051, 0.045] | a low bound below the high bound | swap the two numbers",
        ),
        wrong(
            "window-of-one-number",
            "take: max",
            "window: [1]",
            "17: checks.broken[0].window | [1] | two numbers | correct the value",
        ),
        wrong(
            "unknown-take",
            "take: max",
            "take: maximum",
            "17: checks.broken[0].take | \"maximum\" | 'final', 'first', 'min', 'max', 'mean', 'span' or 'onset'"
            " | correct the value",
        ),
        wrong(
            "signal-without-a-source",
            "{path: ncon}",
            "{unit: m}",
            '14: signals.contacts | {"unit": "m"} | one of `path`, `expr`, `measure: fraction_of_starts`, '
            "`measure: image_row` | say where the number comes from",
        ),
        wrong(
            "signal-with-two-sources",
            "{path: ncon}",
            "{path: ncon, expr: 2 * height}",
            "14: signals.contacts.expr | the unknown key `expr` | one of unit, label, said, path | remove the key",
        ),
        wrong(
            "neither-model-nor-script",
            "model: model.xml\n",
            "",
            "1:  | neither model nor script | exactly one of `model`, `script` | name the file that holds the bug",
        ),
        wrong(
            "model-without-a-run",
            "run: {duration: 0.4}\n",
            "",
            "1:  | model without run | `run` beside `model`, and only there | add `run: {duration: 1}`",
        ),
        wrong(
            "edit-that-changes-nothing",
            EDIT,
            "{find: contype, replace: contype}",
            "24: fixes[0].edits[0] | the edit changes nothing | a `replace` that differs from `find`"
            " | write the repaired text",
        ),
        wrong(
            "fix-without-edits",
            "- " + EDIT,
            "[]",
            "23: fixes[0].edits | [] | List should have at least 1 item | correct the value",
        ),
        wrong(
            "key-twice",
            "lesson:",
            "title: Another\nlesson:",
            "8:  | the key title twice | `field: value` lines of YAML"
            " | give each field once; indent by two spaces; quote text that holds `: `, `#`, `{` or `[`",
        ),
        wrong(
            "sweep-without-end",
            "no_sweep: The masks are not a number.\n",
            changed(SWEEP, ("values: [1, 2, 4, 8]", "start: 1, stop: 2, count: 1001")),
            "37: sweep.fall.vary[0].count | 1001 | less than or equal to 1000 | correct the value",
        ),
        wrong(
            "logarithmic-scale-from-zero",
            "no_sweep: The masks are not a number.\n",
            changed(SWEEP, ("values: [1, 2, 4, 8]", "start: 0, stop: 8, count: 3, scale: log")),
            "36: sweep.fall.vary[0] | a logarithmic scale from or to zero or less | numbers above zero"
            " | write `scale: linear`",
        ),
        wrong(
            "unknown-signal-in-a-check",
            "{signal: height, between",
            "{signal: hieght, between",
            "19: checks.fixed[0].signal | hieght, which is no signal | a signal: height, contacts | write height",
        ),
        wrong(
            "bad-expression",
            "{path: ncon}",
            "{expr: height if height else 0}",
            "14: signals.contacts.expr | height if height else 0 | numbers, names, + - * / **, parentheses and "
            "functions | write plain arithmetic",
        ),
        wrong(
            "expression-over-an-unknown-name",
            "{path: ncon}",
            "{expr: 2 * heigth}",
            "14: signals.contacts.expr | heigth, which is no path signal | a path signal: height | write height",
        ),
        wrong(
            "starts-judged-by-an-expression",
            "{path: ncon}",
            SHARE % "twice",
            "16: signals.share.holds.signal | twice, which is no path signal | a path signal: height, contacts"
            " | correct the name",
        ),
        wrong(
            "prediction-over-an-unknown-name",
            "no_sweep: The masks are not a number.\n",
            changed(SWEEP, ("expr: 0.06 - g * 0.4 * 0.398 / 2", "expr: 0.06 - gg * 0.4")),
            "40: sweep.fall.prediction.expr | gg, which is no name that a prediction can read | a name that a "
            "prediction can read: g, height, contacts, omega_max, omega_one_link | write g",
        ),
        wrong(
            "id-taken",
            "id: small-step",
            "id: share-a-bit",
            "26: refuted[0].id | share-a-bit, which is taken | an id used once; not broken | rename it",
        ),
        wrong(
            "id-broken",
            "id: share-a-bit",
            "id: broken",
            "21: fixes[0].id | broken, which is taken | an id used once; not broken | rename it",
        ),
        wrong(
            "unknown-warning",
            "number: 1",
            "number: 1\nwarnings: [BADQAC]",
            f"2: warnings[0] | BADQAC, which is no MuJoCo warning | a MuJoCo warning: {', '.join(WARNINGS)}"
            " | write BADQACC",
        ),
        wrong(
            "unit-that-mujoco-does-not-compute-in",
            'xpos[2]", unit: m',
            'xpos[2]", unit: mm',
            "13: signals.height.unit | mm | the unit that MuJoCo computes in, such as m, rad, s, kg, N"
            " | write it; convert in prose, `{{ broken.x.final | mm }}`, or by `expr`",
        ),
    ],
)
def test_wrong_record(tmp_path: Path, change: Change, problems: list[str]) -> None:
    folder = write_case(tmp_path, change)
    assert refused(folder) == problems


def test_several_mistakes_are_reported_together_sorted_by_line(tmp_path: Path) -> None:
    folder = write_case(
        tmp_path,
        ("title: Halve the timestep", "titel: Halve the timestep"),
        ("number: 1", "number: 0"),
        ("[0.045, 0.051]", "[1, 0]"),
        ("tags: [contact]", "tags: []"),
    )
    assert [said.split(" |")[0] for said in refused(folder)] == [
        "1: number",
        "9: tags",
        "19: checks.fixed[0]",
        "26: refuted[0].title",
        "27: refuted[0].titel",
    ]
