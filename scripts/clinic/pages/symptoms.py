"""Finding a case by its symptom: nine things that readers say, and the cases whose `looks` name them.

A case without a place stands at the page's end.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from clinic.pages.cases import CasePage
from clinic.pages.text.template import render
from clinic.record.fields import SymptomId


class Heading(NamedTuple):
    """A symptom in a reader's words, and what to measure first."""

    title: str
    first: str


HEADINGS: dict[SymptomId, Heading] = {
    "nothing-moves": Heading(
        "Nothing moves",
        "Print the forces: `data.qfrc_actuator`, `data.qfrc_bias`, `data.qfrc_constraint`. All zero: nothing acts. "
        "Two that cancel: something holds.",
    ),
    "moves-wrong": Heading(
        "It moves, or lies, where it should not",
        "Draw the frames of bodies and axes of joints, or print `data.xmat` and `data.xaxis` before the first step.",
    ),
    "passes-through": Heading(
        "It passes through",
        "Count the contacts, `data.ncon`, while it happens. None: no contact was looked for. Some: they were too weak.",
    ),
    "explodes": Heading(
        "It explodes",
        "Read `data.warning`, and look whether `data.time` goes back. Then run with a twentieth of the timestep.",
    ),
    "oscillates": Heading(
        "It jitters or oscillates",
        "Halve the timestep. A frequency and an amplitude that stay belong to the model: stiffness without damping.",
    ),
    "sags": Heading(
        "It drifts, sags or slips",
        "Compare what holds with what pulls: stiffness times error, or friction times normal force, with the weight.",
    ),
    "picture-wrong": Heading(
        "The picture is wrong",
        "Print the camera: `data.cam_xpos` and `data.cam_xmat`, after `mj_forward`. The physics is not touched by it.",
    ),
    "numbers-wrong": Heading(
        "The numbers are wrong",
        "Compute one of them in a second way, by name, in the same step, right after `mj_forward`.",
    ),
    "worked-yesterday": Heading(
        "It worked yesterday, or elsewhere",
        "Change one thing at a time: the model, the code, MuJoCo's version, the speed at which it runs. Log all four.",
    ),
}


def symptoms_page(shown: Sequence[CasePage]) -> str:
    """The Markdown of the page."""
    groups: list[tuple[str, Heading, list[CasePage]]] = [
        (look, heading, [one for one in shown if look in one.case.record.looks]) for look, heading in HEADINGS.items()
    ]
    if others := [one for one in shown if not one.case.record.looks]:
        groups.append(("other", Heading("Something else", "These have no place yet."), others))
    return render("symptoms", groups=groups)
