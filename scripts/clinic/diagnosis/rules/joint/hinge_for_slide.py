"""A hinge has the range or the name of a slide: its `type` was left out.

A joint without `type` is a hinge. A range of 0 to 0.04 is then no way of 4 cm but an angle of 2 degrees, and a cart on
a joint `slider` turns about its rail.

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

The number: hinges for which nobody wrote a type, and which are called a slide, or their actuator is; or which something
drives or a spring holds, in a range below 0.15 rad that is so narrow as it is written, too.

When it is wrong: a hinge that bends by a few degrees, such as a flexure.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A hinge with the range or the name of a slide"
FAMILIES = ("stuck", "passes-limit", "drifts")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "a joint of another type is planted as that of a pair"

NARROW = 0.15  # rad
SLIDES = re.compile(r"(?<![a-z])(slide|slider|sliding|prismatic|linear|rail)(?![a-z])", re.IGNORECASE)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The hinges that are meant to slide, all together."""
    of, source = model.simulation, model.source
    if source is None or source.urdf:
        return
    ranges = _ranges(of)
    narrow = [joint for joint, wide in ranges.items() if wide < NARROW and _in_metres(model, joint)]
    called = {joint: said for joint in range(of.count("joint")) if (said := _called(model, joint))}
    found = sorted({*narrow, *called})
    if not found:
        return
    low, high = of.row("jnt_range", found[0], 2)
    says = (
        f"{called.get(found[0], f'It turns from {low:.3g} to {high:.3g} rad')}: it is a hinge, for no type is written."
    )
    names, edits = tuple(of.name("joint", joint) for joint in found), model.set("joint", found, "type", "slide")
    probe = how_many("hinges with the range or the name of a slide", _hinges, *found)
    yield Suspect(names, "type", "left out", "slide", edits, probe, 0, says, "a slide")


def _called(model: ReaderModel, joint: int) -> str:
    """What calls a joint without a type a slide, in words: it or each of its actuators; empty where nothing does."""
    of = model.simulation
    if of.joint_type(joint) != HINGE or model.value("joint", joint, "type") or model.element("joint", joint) is None:
        return ""
    if SLIDES.search(of.names("joint")[joint]):
        return "It is called a slide"
    drivers = of.drivers.get(joint, [])
    if drivers and all(SLIDES.search(of.names("actuator")[each]) for each in drivers):
        return f"{of.name('actuator', drivers[0])} drives it"
    return ""


def _in_metres(model: ReaderModel, joint: int) -> bool:
    """Whether no type is written for a joint, and numbers for its range that are small as they stand."""
    numbers = re.findall(r"-?[\d.]+(?:[eE][-+]?\d+)?", model.value("joint", joint, "range") or "")
    small = len(numbers) == 2 and float(numbers[1]) - float(numbers[0]) < NARROW
    return small and not model.value("joint", joint, "type")


def _hinges(of: Simulation, *joints: int) -> list[int]:
    return [joint for joint in joints if of.joint_type(joint) == HINGE]


def _ranges(of: Simulation) -> dict[int, float]:
    """The width in rad of the range of each hinge that is driven or has a spring."""
    driven = set(of.drivers) | {joint for joint, stiffness in enumerate(of.model("jnt_stiffness")) if stiffness}
    made = {}
    for joint in range(of.count("joint")):
        if joint in driven and of.joint_type(joint) == HINGE and of.model("jnt_limited")[joint]:
            low, high = of.row("jnt_range", joint, 2)
            made[joint] = high - low
    return {joint: wide for joint, wide in made.items() if wide > 0}
