"""A driven hinge has the range of a slide: its `type` was left out.

A joint without `type` is a hinge. A range of 0 to 0.04 is then no way of 4 cm but an angle of 2 degrees.

Bad:

    <mujoco>
      <compiler angle="radian"/>
      <worldbody>
        <body pos="0 0 1">
          <joint name="finger" axis="0 1 0" range="0 0.04" damping="1"/>
          <geom type="box" size="0.01 0.01 0.03"/>
        </body>
      </worldbody>
      <actuator>
        <position joint="finger" kp="100" ctrlrange="0 0.04"/>
      </actuator>
    </mujoco>

Good:

    -       <joint name="finger" axis="0 1 0" range="0 0.04" damping="1"/>
    +       <joint name="finger" type="slide" axis="0 1 0" range="0 0.04" damping="1"/>

The number: by how much the narrowest range is below 0.15 rad, of the hinges for which nobody wrote a type, which
something drives or a spring holds, and whose range is so narrow as it is written, too.

When it is wrong: a hinge that bends by a few degrees, such as a flexure.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A hinge with the range of a slide"
FAMILIES = ("stuck", "passes-limit", "drifts")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "a joint of another type is planted as that of a pair"

NARROW = 0.15  # rad


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The hinges that hardly turn, all together."""
    of, source = model.simulation, model.source
    if source is None or source.urdf:
        return
    narrow = [joint for joint, wide in _ranges(of).items() if wide < NARROW and _in_metres(model, joint)]
    if not narrow:
        return
    edits = model.set("joint", narrow, "type", "slide")
    low, high = of.row("jnt_range", narrow[0], 2)
    says = f"No type is written for it, so that it is a hinge, which turns from {low:.3g} to {high:.3g} rad."
    probe = Probe(
        "narrowest range of hinges without a type", "of 0.15 rad, below it", _below, tuple(narrow), dynamic=False
    )
    names = tuple(of.name("joint", joint) for joint in narrow)
    yield Suspect(names, "type", "left out", "slide", edits, probe, 0, says, "a slide, or a wider range", level="hint")


def _in_metres(model: ReaderModel, joint: int) -> bool:
    """Whether no type is written for a joint, and numbers for its range that are small as they stand."""
    numbers = re.findall(r"-?[\d.]+(?:[eE][-+]?\d+)?", model.value("joint", joint, "range") or "")
    small = len(numbers) == 2 and float(numbers[1]) - float(numbers[0]) < NARROW
    return small and not model.value("joint", joint, "type")


def _below(of: Simulation, *joints: int) -> float:
    """By which share of the limit the narrowest of some joints is below it; slides are not."""
    found = _ranges(of)
    return max(0.0, 1 - min((found[joint] for joint in joints if joint in found), default=NARROW) / NARROW)


def _ranges(of: Simulation) -> dict[int, float]:
    """The width in rad of the range of each hinge that is driven or has a spring."""
    driven = set(of.drivers) | {joint for joint, stiffness in enumerate(of.model("jnt_stiffness")) if stiffness}
    made = {}
    for joint in range(of.count("joint")):
        if joint in driven and of.joint_type(joint) == HINGE and of.model("jnt_limited")[joint]:
            low, high = of.row("jnt_range", joint, 2)
            made[joint] = high - low
    return {joint: wide for joint, wide in made.items() if wide > 0}
