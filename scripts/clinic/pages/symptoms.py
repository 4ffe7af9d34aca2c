"""Finding a case by its symptom: nine things that readers say, and the cases that belong to each.

A case's `looks` name where it belongs. Without them its `phrases` do: a phrase that holds one of a look's words
puts the case there, so that a new case finds its place by itself. A case without a place stands at the page's end,
and a law reports it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from clinic.pages.card import Card
from clinic.pages.template import render
from clinic.record.case import Case
from clinic.record.fields import Look
from clinic.record.problem import Problem


@dataclass(frozen=True)
class Heading:
    """One thing that readers say, and where to begin with it.

    Args:
        title: The symptom in a reader's words.
        first: What to measure first, and what the answer means.
        words: Beginnings of words that phrases of such cases hold.
    """

    title: str
    first: str
    words: str


HEADINGS: dict[Look, Heading] = {
    "nothing-moves": Heading(
        "Nothing moves",
        "Print the forces: `data.qfrc_actuator`, `data.qfrc_bias`, `data.qfrc_constraint`. All zero: nothing acts. "
        "Two that cancel: something holds.",
        "does not move|not moving|frozen|ignores|"
        "does not fall|not swing|no effect on|not affect|stuck|will not|stays horizontal|stays on|"
        "stops changing",
    ),
    "moves-wrong": Heading(
        "It moves, or lies, where it should not",
        "Draw the frames of bodies and axes of joints, or print `data.xmat` and `data.xaxis` before the first step.",
        "wrong orientation|tipped|flips|spins|wrong axis|rotated|wrong direction|falls down|rolls|tumbles",
    ),
    "passes-through": Heading(
        "It passes through",
        "Count the contacts, `data.ncon`, while it happens. None: no contact was looked for. Some: they were too weak.",
        "through|penetrat|tunnel|no contact|collision not",
    ),
    "explodes": Heading(
        "It explodes",
        "Read `data.warning`, and look whether `data.time` goes back. Then run with a twentieth of the timestep.",
        "explode|unstable|nan|flies apart|blows up|resets by itself|diverges to",
    ),
    "oscillates": Heading(
        "It jitters or oscillates",
        "Halve the timestep. A frequency and an amplitude that stay belong to the model: stiffness without damping.",
        "oscillat|jitter|vibrat|shak|swinging|overshoot|wobbl",
    ),
    "sags": Heading(
        "It drifts, sags or slips",
        "Compare what holds with what pulls: stiffness times error, or friction times normal force, with the weight.",
        "sag|drift|slip|creep|too weak|cannot lift|steady state error|not reach target|droop|balanc",
    ),
    "picture-wrong": Heading(
        "The picture is wrong",
        "Print the camera: `data.cam_xpos` and `data.cam_xmat`, after `mj_forward`. The physics is not touched by it.",
        "camera|image|render|depth|pixel|picture",
    ),
    "numbers-wrong": Heading(
        "The numbers are wrong",
        "Compute one of them in a second way, by name, in the same step, right after `mj_forward`.",
        "index|wrong value|wrong number|observation|"
        "qpos order|not updated|lags|wrong after|zero after|position wrong|off by one|reads|error is|error zero|"
        "stale",
    ),
    "worked-yesterday": Heading(
        "It worked yesterday, or elsewhere",
        "Change one thing at a time: the model, the code, MuJoCo's version, the speed at which it runs. Log all four.",
        "after adding|changed after|previous episode|replay|reproduc|deterministic|only in|after upgrade|goes dead|"
        "detached",
    ),
}


def looks_of(case: Case) -> list[Look]:
    """Where a case belongs, in the order of the page."""
    if case.record.looks:
        return [look for look in HEADINGS if look in case.record.looks]
    phrases = "\n".join(case.record.phrases).lower()
    return [look for look, heading in HEADINGS.items() if re.search(rf"\b(?:{heading.words})", phrases)]


def symptom_problems(cases: Iterable[Case]) -> Iterator[Problem]:
    """Cases that no reader would find by their symptom."""
    for case in cases:
        if not looks_of(case):
            yield case.problem(
                ("phrases",),
                "no phrase that says what it looks like",
                f"a place under one of: {', '.join(HEADINGS)}",
                "add `looks: [...]`",
            )


def symptoms_page(cases: Sequence[Case], cards: Mapping[str, Card]) -> str:
    """The Markdown of the page."""
    groups = [
        (look, heading, [cards[case.slug] for case in cases if look in looks_of(case)])
        for look, heading in HEADINGS.items()
    ]
    others = [cards[case.slug] for case in cases if not looks_of(case)]
    return render("symptoms", groups=groups, others=others)
