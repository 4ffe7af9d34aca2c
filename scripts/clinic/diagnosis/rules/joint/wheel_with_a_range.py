"""A wheel's joint has a range, and the wheel stops after a turn.

`type="revolute"` with limits of 3.14 in a URDF, or a default class of the arm's joints that reaches the wheels.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="5 5 0.1"/>
        <body name="car" pos="0 0 0.1">
          <freejoint/>
          <geom type="box" size="0.2 0.1 0.03"/>
          <body name="left_wheel" pos="0 0.15 0">
            <joint axis="0 1 0" range="-180 180"/>
            <geom type="cylinder" size="0.1 0.02" euler="90 0 0"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -         <joint axis="0 1 0" range="-180 180"/>
    +         <joint axis="0 1 0"/>

The number: how many wheels have a range of less than 4 turns; a wheel is a body or joint that is called so, with a
level hinge through the middle of its geoms. So is a crank, a shaft or a roller that a velocity servo turns, where its
range has less than 0.5 rad and the servo's speed crosses it in a tenth of a second.

When it is wrong: a steering wheel, or a wheel that is to turn but a little.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.probes.servo import speed_gain
from clinic.diagnosis.probes.shape import round_about
from clinic.diagnosis.probes.wheels import is_wheel
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import ENDLESS, Simulation
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "A wheel with a range"
FAMILIES = ("stuck", "drifts")
UNPLANTED = "nearly no healthy model stands on wheels"

TURNS, LEVEL_ENOUGH = 4.0, 0.3
SHORT, AT_ONCE = 0.5, 0.1  # rad, s
TURNED = re.compile(r"(?i)crank|shaft|spindle|roller|drum|rotor|propeller")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """All wheels whose hinge has a range of a few turns."""
    of = model.simulation
    of.begin()
    sped = _sped(of)
    found = [joint for joint in range(of.count("joint")) if joint in sped or _wheel(of, joint)]
    if not found:
        return
    low, high = of.row("jnt_range", found[0], 2)
    names = tuple(of.name("joint", joint) for joint in found)
    says = f"{names[0]} turns from {low:.3g} to {high:.3g} rad and no farther."
    edits = model.remove("joint", found, "range") + model.remove("joint", found, "limited")
    if any((each := model.element("joint", joint)) is None or not each.get("range") for joint in found):
        edits = model.set("joint", found, "limited", "false")  # against a range of their default class
    if model.urdf:
        placed = [each for joint in found if (each := model.element("joint", joint)) is not None]
        edits = tuple(set_attribute(each, "type", "continuous") for each in placed)
    probe = counted("wheels that a range stops", len(found))
    now = f"{low / model.angle_unit:.3g} {high / model.angle_unit:.3g}"
    yield Suspect(names, "range", now, "left out", edits, probe, 0.5, says, "a wheel without a range")


def _sped(of: Simulation) -> set[int]:
    """The cranks that a velocity servo is to keep turning, and whose range it would cross in no time."""
    made = set()
    for actuator in range(of.count("actuator")):
        joint = of.driven_joint(actuator)
        if joint is None or not speed_gain(of, actuator) or not of.model("actuator_ctrllimited")[actuator]:
            continue
        fastest = max(map(abs, of.row("actuator_ctrlrange", actuator, 2)))
        fastest /= abs(of.gear(actuator)) or 1.0
        low, high = of.ranges.get(joint, ENDLESS)
        short = of.joint_type(joint) == HINGE and high - low < min(SHORT, AT_ONCE * fastest)
        if short and TURNED.search(of.names("joint")[joint]):
            made.add(joint)
    return made


def _wheel(of: Simulation, joint: int) -> bool:
    body = of.body_of("joint", joint)
    name = f"{of.names('joint')[joint]} {of.names('body')[body]}"
    if of.joint_type(joint) != HINGE or not is_wheel(name):
        return False
    low, high = of.ranges.get(joint, ENDLESS)
    level = abs(of.axis(joint)[2]) < LEVEL_ENOUGH
    return high - low < TURNS * 2 * math.pi and level and round_about(of, joint)
