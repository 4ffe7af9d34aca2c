"""What an author is told when a case is compiled, run and put on a page."""

from __future__ import annotations

import functools
from collections.abc import Callable
from pathlib import Path

import pytest
from clinic.engine.script import run_script
from clinic.proof import evidence
from clinic.proof.evidence import collect
from clinic.record.case import load_case
from clinic.record.problem import CaseError
from helpers import MODEL, SLUG, changed, page_of, script_case, tiny_case, write_script_case

Change = tuple[str, str]
EDIT = "{find: ' contype=\"2\" conaffinity=\"2\"', replace: ''}"
STEP = "find: 'timestep=\"0.002\"', replace: 'timestep=\"0.001\"'"


def told(act: Callable[[], object]) -> list[str]:
    """Every problem as `line: field | found | repair`, that of another file with its name before it."""
    with pytest.raises(CaseError) as caught:
        act()
    return [
        f"{p.file.partition('/')[2].partition('/')[2].removeprefix('case.yaml')}{p.line}: {p.where} | {p.found} | "
        f"{p.repair}"
        for p in caught.value.problems
    ]


@pytest.mark.parametrize(
    ("change", "problems"),
    [
        pytest.param(
            ("body(box).xpos[2]", "body(bix).xpos[2]"),
            ["13: signals.height.path | body(bix), which the model does not have | write body(box)"],
            id="signal-of-a-missing-body",
        ),
        pytest.param(
            ("body(box).xpos[2]", "body(box).xpos[3]"),
            ["13: signals.height.path | body(box).xpos[3] | correct the index"],
            id="index-out-of-range",
        ),
        pytest.param(
            (EDIT, "{find: 'contype=\"3\"', replace: ''}"),
            [
                "24: fixes[0].edits[0].find | text that does not occur in model.xml: 'contype=\"3\"' | "
                "copy the text from model.xml, character by character"
            ],
            id="edit-that-matches-nothing",
        ),
        pytest.param(
            (EDIT, "{find: '=\"2\"', replace: '=\"1\"'}"),
            [
                "24: fixes[0].edits[0].find | text that occurs 2 times in model.xml: '=\"2\"' | "
                "lengthen `find` until it names one place"
            ],
            id="edit-that-matches-twice",
        ),
        pytest.param(
            ("replace: ''", "replace: ' friktion=\"1\"'"),
            [
                "23: fixes[0].edits | after these edits: XML Error: Schema violation: unrecognized attribute: "
                "'friktion' Element 'geom', line 5 | correct `replace`"
            ],
            id="fix-that-does-not-compile",
        ),
        pytest.param(
            ("{duration: 0.4}", "{duration: 0.4, keyframe: throw, ctrl: {motor: 1}}"),
            [
                "11: run.ctrl.motor | the actuator motor, which the model does not have | correct the name",
                "11: run.keyframe | the key throw, which the model does not have | correct the name",
            ],
            id="unknown-keyframe-and-actuator",
        ),
        pytest.param(
            ("duration: 0.4", "duration: 0.0001"),
            ["11: run.duration | 0.0001 s at a timestep of 0.002 s | change the duration or the timestep"],
            id="duration-below-one-step",
        ),
        pytest.param(
            ("camera: side", "camera: sid"),
            ["33: picture.camera | sid, which is no camera of the model | write side"],
            id="missing-camera",
        ),
        pytest.param(
            (STEP, "find: '<body name=\"box\"', replace: '<body name=\"crate\"'"),
            [
                "13: signals.height.path | after the edits of small-step: body(box), which the model does not have | "
                "correct the name, or name the body in the model"
            ],
            id="name-that-an-edit-takes-away",
        ),
        pytest.param(
            ("lesson:", "snippet: |\n  text = open('model.xml').read()\n  print(text.size)\nlesson:"),
            [
                "8: snippet | AttributeError: 'str' object has no attribute 'size' (line 2 of snippet.py) | "
                "run it by hand and mend it"
            ],
            id="snippet-that-raises",
        ),
    ],
)
def test_wrong_for_the_model(tmp_path: Path, change: Change, problems: list[str]) -> None:
    case = tiny_case(tmp_path, change)
    assert told(lambda: collect(case)) == problems


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        pytest.param(("<freejoint", "<fredjoint"), "model.xml7:  | XML Error: Schema", id="bad-element"),
        pytest.param(('mass="1"', 'mass="0"'), "model.xml6:  | Error: mass and inertia", id="body-without-mass"),
        pytest.param(("    </body>\n", ""), "model.xml6:  | XML parse error", id="unclosed-element"),
    ],
)
def test_model_that_does_not_compile(tmp_path: Path, change: Change, problem: str) -> None:
    case = tiny_case(tmp_path, model=changed(MODEL, change))
    (said,) = told(lambda: collect(case))
    assert said.startswith(problem)


# Scripts


def test_script_that_hangs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(evidence, "run_script", functools.partial(run_script, time_limit=0.5))
    case = script_case(tmp_path, script="error = 0.5\nprint('error =', error)\nwhile error:\n    pass\n")
    assert told(lambda: collect(case)) == [
        "3: script | script.py: still running after 0.5 s | bound its loops by steps"
    ]


def test_script_that_raises_and_fix_that_raises(tmp_path: Path) -> None:
    case = script_case(tmp_path, ("replace: '0.0'", "replace: 'half'"), script="import sys\n\nprint(undefined, 0.5)\n")
    raised = "NameError: name 'undefined' is not defined (line 3 of script.py) | run it by hand and mend it"
    assert told(lambda: collect(case)) == [
        f"3: script | script.py: {raised}",
        f"21: fixes[0].edits | script.py after these edits: {raised}",
    ]


def test_path_into_mujoco_in_a_script_case(tmp_path: Path) -> None:
    case = script_case(tmp_path, ("printed(error)", "ncon"))
    assert told(lambda: collect(case)) == ["12: signals.error.path | ncon | let the script print it"]


def test_samples_that_do_not_pair_up(tmp_path: Path) -> None:
    two = (
        "error: {path: printed(error), unit: m}",
        "error: {path: printed(error)}\n  other: {path: printed(first error)}\n  sum: {expr: error + other}",
    )
    script = 'print("error = 0.5\\nerror = 2\\nerror = 3\\nfirst error = 1\\nfirst error = 2")'
    case = script_case(tmp_path, two, script=script)
    assert told(lambda: collect(case)) == [
        "14: signals.sum.expr | samples that do not pair up: error has 3, other has 2 | "
        "print each as often as the others"
    ]


@pytest.mark.parametrize(
    ("old", "new", "problem"),
    [
        ('"side"', '"top"', "25: picture.camera | side, which is no camera of the model"),
        ("<freejoint", "<fredjoint", "scene.xml7:  | XML Error: Schema violation"),
    ],
)
def test_wrong_scene_of_a_script(tmp_path: Path, old: str, new: str, problem: str) -> None:
    scene = ("script: script.py", "script: script.py\nfiles: [scene.xml]")
    folder = write_script_case(tmp_path, scene, ("camera: side", "camera: side, scene: scene.xml"))
    (folder / "scene.xml").write_text(MODEL.replace(old, new), encoding="utf-8")
    (said,) = told(lambda: collect(load_case(folder)))
    assert said.startswith(problem)


# Prose


@pytest.mark.parametrize(
    ("text", "found", "repair"),
    [
        pytest.param(
            "{{ broken.hieght.final }}", "{{ broken.hieght.final }}: hieght is no signal", "write height", id="field"
        ),
        pytest.param("{{ broken.height.final }", "{{ broken.height.final }.", "close it with }}", id="field-left-open"),
        pytest.param("$\\frac{$", "$\\frac{$: NoAvailableTokensError", "correct it", id="formula"),
    ],
)
def test_prose_that_cannot_be_shown(tmp_path: Path, text: str, found: str, repair: str) -> None:
    case = tiny_case(tmp_path, ("The masks share no bit.", f"|\n  The masks\n  share no bit: {text}."))
    proof = collect(case)
    (said,) = told(lambda: page_of(case, proof))
    assert said.startswith(f"8: cause | {found} | {repair}")


def test_case_is_usable_without_its_folder(tmp_path: Path) -> None:
    case = tiny_case(tmp_path)
    (tmp_path / "cases" / SLUG / "model.xml").unlink()
    assert set(collect(case).variants) == {"broken", "share-a-bit", "small-step"}
