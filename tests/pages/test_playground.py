"""What the playground is given, and how fine it draws."""

from __future__ import annotations

import json
import subprocess
from dataclasses import replace
from pathlib import Path

from clinic.engine.node import executable as node
from clinic.pages.playground import playground
from helpers import tiny_case

ROOT = Path(__file__).parents[2]


def test_the_file_holds_what_the_browser_needs(tmp_path: Path) -> None:
    spin = ("  contacts: {path: ncon}\n", "  contacts: {path: ncon}\n  spin: {path: 'cvel[1][2]', unit: rad/s}\n")
    case = tiny_case(tmp_path, spin, ("picture: {camera: side}", "picture: {camera: side}\nwarnings: [BADQACC]"))

    other = replace(case, slug="another-box")
    made = json.loads(playground(case, [case, other]))

    assert made["text"] == case.text
    assert made["signals"]["spin"] == {
        "path": "cvel[1][2]",
        "unit": "rad/s",
        "label": "spin",
        "columns": [6],
        "seen": True,
    }
    assert made["signals"]["contacts"]["columns"] == []
    assert not made["signals"]["contacts"]["seen"]
    assert made["checks"]["fixed"] == [{"signal": "height", "take": "final", "between": [0.045, 0.051]}]
    assert made["explained"] == {
        "BADQACC": [{"href": "../another-box/index.html", "title": "1. A box falls through the floor"}]
    }
    symptom, measure, found = made["hints"]
    assert "contacts" not in symptom["text"]
    assert symptom["text"].endswith("epaired, height of the box, at the end: between 0.045 and 0.051 m.")
    assert "contacts" in found["text"]
    assert measure["text"] == "after every step, height of the box, body(box).xpos[2]; contacts, ncon."


def test_the_file_holds_trials_and_what_a_remedy_needs(tmp_path: Path) -> None:
    trials = (
        "trials: [{id: far, title: Far, start: {'joint(box).qpos[2]': 2}, set: {'model.body_mass[1]': 3},"
        " checks: {fixed: [{signal: contacts, above: 0.5}]}}]"
    )
    case = tiny_case(tmp_path, ("picture: {camera: side}", f"picture: {{camera: side}}\n{trials}"))

    made = json.loads(playground(case, [case]))

    assert made["trials"] == [
        {
            "title": "Far",
            "start": [{"path": "joint(box).qpos[2]", "columns": [], "value": 2}],
            "set": [{"path": "model.body_mass[1]", "columns": [], "value": 3}],
            "ctrl": {},
            "duration": None,
            "checks": {"fixed": [{"signal": "contacts", "take": "final", "above": 0.5}]},
        }
    ]
    assert made["task"] == {"may": []}
    assert [remedy["needs"] for remedy in made["fixes"]] == [""]


def test_a_late_picture_gets_coarser_and_an_early_one_finer_again() -> None:
    code = """
      const { Resolution } = await import("./docs/playground/view/resolution.js");
      const resolution = new Resolution(1.5);
      let now = 0;
      const after = (frames, interval) => {
        for (let i = 0; i < frames; i++) resolution.frameDrawn((now += interval));
        return resolution.ratio;
      };
      const seen = [after(16, 16), after(160, 40), after(200, 27), after(1600, 16), after(200, 600)];
      console.log(JSON.stringify(seen));
    """
    done = subprocess.run(
        [node(), "--input-type=module", "-e", code], cwd=ROOT, check=True, capture_output=True, text=True
    )

    assert json.loads(done.stdout) == [1.5, 0.5, 0.5, 1.5, 1.5]


def test_the_evidence_tells_what_a_check_guards_and_why_a_remedy_does_not_help(proven) -> None:
    case, evidence = proven("servo-sags")

    made = json.loads(playground(case, [case], evidence))

    assert [guard["symptom"] for guard in made["guards"]] == [True, True, False]
    assert "Raise the gain ten times" in made["guards"][0]["against"]
    whys = [remedy["why"] for remedy in made["refuted"]]
    assert all(whys)
    assert not [why for why in whys if "{{" in why or "$" in why]
