"""A hinge has the range or the name of a slide: its `type` was left out.

A joint without `type` is a hinge. A range of 0 to 0.04 is then no way of 4 cm but an angle of 0.04 degrees, or of 2.3
with `angle="radian"`, and a cart on a joint `slider` turns about its rail.

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
drives or a spring holds, in a range below 0.15 rad that is so narrow as it is written, too. In a URDF, which writes all
types, a revolute joint that is called a slide. And the one hinge in a narrow range of which all others slide whose
names end in the same word: `boom_ram` beside `stick_ram` and `bucket_ram`. It gets their class where it has another
one.

When it is wrong: a hinge that bends by a few degrees, such as a flexure.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.engine import HINGE, SLIDE
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A hinge with the range or the name of a slide"
FAMILIES = ("stuck", "passes-limit", "drifts")
UNPLANTED = "a joint of another type is planted as that of a pair"

NARROW = 0.15  # rad
SISTERS = 2
SLIDES = re.compile(r"(?<![a-z])(slide|slider|sliding|prismatic|linear|rail|telescop\w*)(?![a-z])", re.IGNORECASE)
HINGED = re.compile("crank|pivot|hinge|rot", re.IGNORECASE)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The hinges that are meant to slide, all together."""
    of, source = model.simulation, model.source
    if source is None:
        return
    yield from _of_another_class(model)
    ranges = _ranges(of)
    narrow = [joint for joint, wide in ranges.items() if wide < NARROW and _in_metres(model, joint)]
    called = {joint: said for joint in range(of.count("joint")) if (said := _called(model, joint))}
    found = sorted({*narrow, *called} - {*unlike_slides(of)})
    if not found:
        return
    low, high = of.row("jnt_range", found[0], 2)
    said = called.get(found[0], f"It turns from {low:.3g} to {high:.3g} rad")
    says, now, value = f"{said}: it is a hinge, for no type is written.", "left out", "slide"
    edits, element = model.set("joint", found, "type", value), model.element("joint", found[0])
    if source.urdf and element:
        says, now, value = f"{said}: it is a hinge, and turns.", element.get("type"), "prismatic"
        edits = tuple(set_attribute(each, "type", value) for joint in found if (each := model.element("joint", joint)))
    names = tuple(of.name("joint", joint) for joint in found)
    probe = how_many("hinges with the range or the name of a slide", _hinges, *found)
    yield Suspect(names, "type", now, value, edits, probe, 0, says, "a slide")


def unlike_slides(of: Simulation) -> dict[int, list[int]]:
    """The one hinge in a range in m of joints whose names end in the same word, by the slides that all others are."""
    ends: dict[str, list[int]] = {}
    for joint, name in enumerate(of.names("joint")):
        first, _, last = name.rpartition("_")
        if first and not last.isdigit():
            ends.setdefault(last, []).append(joint)
    made = {}
    for joints in ends.values():
        kinds = [of.joint_type(joint) for joint in joints]
        if kinds.count(HINGE) == 1 and kinds.count(SLIDE) == len(kinds) - 1 >= SISTERS:
            made[joints[kinds.index(HINGE)]] = [each for each in joints if of.joint_type(each) == SLIDE]
    return {joint: others for joint, others in made.items() if 0 < _ranges(of).get(joint, 0) < NARROW}


def _of_another_class(model: ReaderModel) -> Iterator[Suspect]:
    """The one hinge among slides, with their class where all have one, else their type."""
    of = model.simulation
    for joint, slides in unlike_slides(of).items():
        element, others = model.element("joint", joint), [model.element("joint", each) for each in slides]
        classes = {(each.get("class") or "") if each else "" for each in others}
        given, name = element.get("class") if element else "", of.name("joint", joint)
        attribute, now, value = "type", "hinge", "slide"
        if given and len(classes) == 1 and "" not in classes:
            attribute, now, value = "class", given, classes.pop()
        says = f"It is a hinge, and {of.name('joint', slides[0])} and {len(slides) - 1} more of its name slide."
        edits = (set_attribute(element, attribute, value),) if element else ()
        probe = how_many("hinges that are called like slides", _hinges, joint)
        yield Suspect((name,), attribute, now, value, edits, probe, 0, says, "a slide")


def _called(model: ReaderModel, joint: int) -> str:
    """What calls a hinge a slide, in words: it or each of its actuators; empty where nothing does, or MJCF its type."""
    of, element = model.simulation, model.element("joint", joint)
    typed = not model.urdf and model.value("joint", joint, "type")
    if of.joint_type(joint) != HINGE or typed or element is None:
        return ""
    name = of.names("joint")[joint]
    if SLIDES.search(name) and not (model.urdf and HINGED.search(name)):
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
    wide = {joint: high - low for joint, (low, high) in of.ranges.items() if joint in driven and high > low}
    return {joint: width for joint, width in wide.items() if of.joint_type(joint) == HINGE}
