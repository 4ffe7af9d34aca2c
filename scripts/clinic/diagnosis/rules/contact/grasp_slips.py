"""Fingers press firmly, and the friction of what they hold is too low to carry it.

A grasp holds while friction times the normal forces is more than the weight. Which friction counts is decided by
`priority`, and else the larger of the two: a slippery surface of high priority undoes the best pads.

Bad:

    <mujoco>
      <option cone="elliptic" impratio="10"/>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body name="left" pos="-0.04 0 0.06">
          <joint name="left" type="slide" axis="1 0 0"/>
          <geom type="box" size="0.005 0.015 0.04" mass="0.1"/>
        </body>
        <body name="right" pos="0.04 0 0.06">
          <joint name="right" type="slide" axis="-1 0 0"/>
          <geom type="box" size="0.005 0.015 0.04" mass="0.1"/>
        </body>
        <body name="cube" pos="0 0 0.025">
          <freejoint/>
          <geom name="cube" type="box" size="0.025 0.025 0.025" mass="0.4" friction="0.15" priority="1"/>
        </body>
      </worldbody>
      <actuator>
        <position joint="left" kp="400" kv="10" ctrlrange="0 0.03"/>
        <position joint="right" kp="400" kv="10" ctrlrange="0 0.03"/>
      </actuator>
    </mujoco>

Good:

    -       <geom name="cube" type="box" size="0.025 0.025 0.025" mass="0.4" friction="0.15" priority="1"/>
    +       <geom name="cube" type="box" size="0.025 0.025 0.025" mass="0.4" friction="1" priority="1"/>

The number: the weight of what is put between the fingers over what friction carries, once they went to one end of
their controls for 1 s; above 1 it slips. Only friction below 0.5 is told: rubber on a solid has 0.5 to 1. A hand that
lifts asks for more than the weight: where friction 1 leaves more than 0.6, the fingers are told, which are too weak.

When it is wrong: a thing that is to slip. Fingers that are too weak need force, not friction.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.grasp import Grasp, grasps, needed
from clinic.diagnosis.probes.touch import DRY, Deciding, edits_of, names_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect

TITLE = "A grasp that friction cannot hold"
FAMILIES = ("slips",)
LEVEL = "cause"
UNPLANTED = "the fingers of the healthy models hold nothing when they close"
CASE = "grasp-slips"

LOW, RESERVE = 0.5, 0.6


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """What decides the contacts of a body that fingers hold with too little friction."""
    of = model.simulation
    for found in grasps(of):
        if not would_hold(model, found):
            continue
        low = _low(found)
        least = min(each.friction for each in low)
        says = (
            f"The fingers press with {found.force:.3g} N in all, of which friction {least:g} carries "
            f"{found.carries:.3g} N; {of.name('body', found.body)} weighs {found.weight:.3g} N."
        )
        yield Suspect(
            names_of(of, low),
            "friction",
            f"{least:g}",
            "1",
            edits_of(model, low, "friction", DRY),
            needed(found),
            1.0,
            says,
            "0.5 to 1 for rubber",
        )


def would_hold(model: ReaderModel, found: Grasp) -> bool:
    """Whether the fingers would hold what they drop, with something to spare, if it and they were rougher."""
    edits = edits_of(model, _low(found), "friction", DRY) if found.weight > found.carries else ()
    return bool(edits) and model.measured(needed(found)) > 1 and model.measured(needed(found), edits) <= RESERVE


def _low(found: Grasp) -> list[Deciding]:
    return [each for each in found.deciding if each.friction < LOW]
