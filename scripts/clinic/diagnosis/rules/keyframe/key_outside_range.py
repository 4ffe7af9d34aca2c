"""A keyframe puts joints outside of their ranges.

The limits push back at the first step, and the robot jumps. A keyframe in degrees does it, one that was made before a
range was changed, and one with a joint more or less than the model.

Bad:

    <mujoco>
      <worldbody>
        <body name="upper" pos="0 0 1">
          <joint name="shoulder" axis="0 1 0" range="-90 90" damping="1" armature="0.1"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
          <body name="lower" pos="0.3 0 0">
            <joint name="elbow" axis="0 1 0" range="0 120" damping="1" armature="0.1"/>
            <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
          </body>
        </body>
      </worldbody>
      <keyframe>
        <key name="home" qpos="0.2 -1.2"/>
      </keyframe>
    </mujoco>

Good:

    -     <key name="home" qpos="0.2 -1.2"/>
    +     <key name="home" qpos="0.2 1.2"/>

The number: how far the worst joint is outside: 0.1 rad or 4 cm, and more. Where the joint's servo is told to hold it
there, and may be, the joint's range is what is told. What would be inside in degrees, with the controls that are equal
to it, or far inside with the other sign, is written so, and two that would be inside in each other's place are
exchanged; else it is put to the end of the range.

A joint that every one of several keyframes puts outside is a hint that its range is wrong. Where no servo and no other
keyframe moves it, the range may as well have the wrong sign, and nothing is edited. Of hinges without a range a whole
multiple of 15 from 30 on is told as a hint, where no other keyframe has them beyond one turn.

When it is wrong: a limit that is soft on purpose.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping
from itertools import combinations

from clinic.diagnosis.edit import Edit, set_attribute
from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.probes.key import against_range, beyond, outside, reordered, start_at, weighed
from clinic.diagnosis.probes.servo import servos
from clinic.diagnosis.probes.twins import range_of_image
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Probe, Suspect, how_many

TITLE = "A keyframe is outside of the joints' ranges"
FAMILIES = ("jumps-at-start", "explodes")
CASE = "arm-jumps-at-reset"

LIMIT = 0.1  # rad
LEAST, WHOLE = 30, 15  # degrees that are no angle in rad
TURNED = 0.25  # of the range: farther outside, and inside with the other sign


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Keyframes with joints beyond their limits; the limits where the control agrees with the keyframe."""
    of = model.simulation
    always = _always(of)
    yield from _limits(model, always)
    for key in range(of.count("key")):
        if reordered(model, key):
            continue
        off = {joint: each for joint, each in _off(of, key).items() if joint not in always}
        element = model.element("key", key)
        if element is not None and not off:
            yield from _degrees(model, key, element)
        if not off or element is None:
            continue
        held = {joint: reach for joint, reach in against_range(of, key).items() if joint in off}
        yield from _ranges(model, key, held)
        off = {joint: each for joint, each in off.items() if joint not in held and not _as_its_twin(of, key, joint)}
        if not off:
            continue
        start_at(of, key)
        qpos = list(of.data("qpos"))
        in_degrees = _in_degrees(of, off)
        meant = _meant(of, off)
        if in_degrees:  # all of them were written alike
            hinges = [joint for joint in range(of.count("joint")) if of.joint_type(joint) == HINGE]
            meant |= {joint: math.radians(of.position(joint)) for joint in hinges}
        controls = _controls(of, element) if in_degrees else ()
        for joint, position in meant.items():
            qpos[of.place(joint)] = position
        worst = max(off, key=lambda joint: weighed(of, joint, off[joint]))
        low, high = of.row("jnt_range", worst, 2)
        far = f"{abs(off[worst]):.3g} {of.unit(worst)}"
        says = f"{of.name('joint', worst)} stands {far} outside of {low:.3g} to {high:.3g}."
        if len(off) == 1 and _either(of, key, worst, off[worst]):
            yield _of_either(model, key, worst, says, written(qpos))
            continue
        yield Suspect(
            (of.name("key", key), *(of.name("joint", joint) for joint in off)),
            "qpos",
            element.get("qpos"),
            written(qpos),
            (set_attribute(element, "qpos", written(qpos)), *controls),
            outside(key),
            LIMIT,
            says + " As degrees it would be inside." * in_degrees,
            "inside of the ranges",
            excess=weighed(of, worst, off[worst]) / LIMIT,
        )


def _controls(of: Simulation, key: Element) -> tuple[Edit, ...]:
    """The controls of a keyframe in rad, where servos are to hold the hinges where it has them in degrees."""
    ctrl = [float(each) for each in key.get("ctrl").split()]
    holds = {each.actuator: of.position(each.joint) for each in servos(of) if of.joint_type(each.joint) == HINGE}
    alike = [each for each, at in holds.items() if len(ctrl) == of.count("actuator") and ctrl[each] == at]
    if not any(abs(ctrl[each]) > 2 * math.pi for each in alike):
        return ()
    made = [math.radians(each) if actuator in alike else each for actuator, each in enumerate(ctrl)]
    return (set_attribute(key, "ctrl", written(made)),)


def _as_its_twin(of: Simulation, key: int, joint: int) -> bool:
    """Whether a keyframe keeps to the range that the joint would have as its twin's image: that tells of the range."""
    wanted = range_of_image(of, joint)
    start_at(of, key)
    return wanted is not None and wanted[0] - LIMIT <= of.position(joint) <= wanted[1] + LIMIT


def _either(of: Simulation, key: int, joint: int, beyond: float) -> bool:
    """Whether the range may have the wrong sign as well as a keyframe: no servo or other keyframe moves the joint."""
    place = of.place(joint)
    others = {qpos[place] for each, qpos in _poses(of).items() if each != key}
    start_at(of, key)
    return of.count("key") > 1 and joint not in of.drivers and len(others) == 1 and _turned(of, joint, beyond)


def _of_either(model: ReaderModel, key: int, joint: int, says: str, qpos: str) -> Suspect:
    """A joint and a keyframe of which one has the wrong sign."""
    of, unit = model.simulation, model.angle_unit if model.simulation.joint_type(joint) == HINGE else 1.0
    low, high = (x / unit for x in of.row("jnt_range", joint, 2))
    value = f"{written([-high, -low])}, or qpos {qpos}"
    says += " Either of them has the wrong sign; nothing here tells which."
    names, now = (of.name("joint", joint), of.name("key", key)), model.value("joint", joint, "range") or ""
    return Suspect(names, "range", now, value, (), outside(key), LIMIT, says, "inside of the ranges")


def _degrees(model: ReaderModel, key: int, element: Element) -> Iterator[Suspect]:
    """A keyframe in degrees, as hinges without a range tell."""
    of = model.simulation
    if not (found := _whole(of, key)):
        return
    start_at(of, key)
    qpos = list(of.data("qpos"))
    for joint in range(of.count("joint")):
        if of.joint_type(joint) == HINGE:
            qpos[of.place(joint)] = math.radians(of.position(joint))
    at = of.position(found[0])
    says = (
        f"{of.name('joint', found[0])} stands at {at:g} rad, {at / (2 * math.pi):.3g} turns. As degrees it is {at:g}."
    )
    names = (of.name("key", key), *(of.name("joint", joint) for joint in found))
    edits = (set_attribute(element, "qpos", written(qpos)),)
    probe = how_many("hinges at whole degrees for radians", _whole, key)
    now, healthy = element.get("qpos"), "angles in rad"
    yield Suspect(names, "qpos", now, written(qpos), edits, probe, 0, says, healthy, level="hint")


def _whole(of: Simulation, key: int) -> list[int]:
    """The hinges without a range that stand at a multiple of 15 in one keyframe, and at no angle beyond a turn else."""
    made, others = [], [qpos for each, qpos in _poses(of).items() if each != key]
    for joint in range(of.count("joint")):
        if not of.continuous(joint):
            continue
        place = of.place(joint)
        at = abs(_poses(of)[key][place])
        if at >= LEAST and at % WHOLE == 0 and max(abs(qpos[place]) for qpos in others) <= 2 * math.pi:
            made.append(joint)
    return made


@kept
def _poses(of: Simulation) -> dict[int, tuple[float, ...]]:
    """The `qpos` of each keyframe, and at -1 of the model's own start."""
    made = {}
    for each in range(-1, of.count("key")):
        of.engine.reset(each)
        made[each] = tuple(of.data("qpos"))
    return made


def _ranges(model: ReaderModel, key: int, held: Mapping[int, tuple[float, float]]) -> Iterator[Suspect]:
    """The ranges of joints that keyframe and control are outside of, with the other sign or those of the control."""
    of = model.simulation
    for joint, reach in held.items():
        start_at(of, key)
        at, (low, high) = of.position(joint), of.row("jnt_range", joint, 2)
        wanted = (-high, -low) if -high <= at <= -low else reach
        unit = model.angle_unit if of.joint_type(joint) == HINGE else 1.0
        value = written([x / unit for x in wanted])
        says = f"{of.name('key', key)} puts {of.name('joint', joint)} at {at:.3g}, and its servo is to hold it there; "
        says += f"the range ends at {low if at < low else high:.3g} {of.unit(joint)}."
        yield Suspect(
            (of.name("joint", joint), of.name("key", key)),
            "range",
            model.value("joint", joint, "range") or written([x / unit for x in (low, high)]),
            value,
            model.set("joint", [joint], "range", value),
            Probe("joint outside of its range at the keyframe", "rad", _beyond, (key, joint), dynamic=False),
            LIMIT,
            says,
            "keyframe, control and range agree",
        )


def _beyond(of: Simulation, key: int, joint: int) -> float:
    return weighed(of, joint, beyond(of, key).get(joint, 0.0))


def _in_degrees(of: Simulation, off: Collection[int]) -> bool:
    """Whether joints were meant in degrees: one is more than a turn away, and all would be inside."""
    farther = any(abs(of.position(joint)) > 2 * math.pi for joint in off)
    return farther and all(_inside(of, joint, math.radians(of.position(joint))) for joint in off)


def _inside(of: Simulation, joint: int, at: float) -> bool:
    low, high = of.row("jnt_range", joint, 2)
    return of.joint_type(joint) == HINGE and low <= at <= high


def _off(of: Simulation, key: int) -> dict[int, float]:
    return {joint: each for joint, each in beyond(of, key).items() if weighed(of, joint, each) > LIMIT}


def _meant(of: Simulation, off: Mapping[int, float]) -> dict[int, float]:
    """Where joints were meant to be: in each other's place, with the other sign, or at the end of their ranges."""
    at = {joint: of.position(joint) for joint in off}
    made = {joint: -at[joint] if _turned(of, joint, off[joint]) else at[joint] - off[joint] for joint in off}
    for one, other in combinations(off, 2):
        if _inside(of, one, at[other]) and _inside(of, other, at[one]):
            made |= {one: at[other], other: at[one]}
    return made


def _turned(of: Simulation, joint: int, beyond: float) -> bool:
    """Whether a joint is far outside of its range, and inside with the other sign."""
    low, high = of.row("jnt_range", joint, 2)
    return low <= -of.position(joint) <= high and abs(beyond) > TURNED * (high - low)


def _always(of: Simulation) -> set[int]:
    """The joints that all of several keyframes put outside of their ranges, and nothing tells where else."""
    found = []
    for key in range(of.count("key")):
        off = _off(of, key)
        meant = _meant(of, off)
        ends = {joint for joint in off if meant[joint] == of.position(joint) - off[joint]}
        found.append(set() if _in_degrees(of, off) else ends)
    return set.intersection(*found) if len(found) > 1 else set()


def _limits(model: ReaderModel, always: Collection[int]) -> Iterator[Suspect]:
    """The limits of joints that no keyframe keeps to, taken off."""
    of = model.simulation
    for joint in always:
        low, high = of.row("jnt_range", joint, 2)
        says = f"Each of the {of.count('key')} keyframes puts {of.name('joint', joint)} outside"
        says += f" of {low:.3g} to {high:.3g} {of.unit(joint)}."
        probe = Probe("joint outside of its range at a keyframe", of.unit(joint), _beyond, (0, joint), dynamic=False)
        edits = model.set("joint", [joint], "limited", "false")
        now = model.value("joint", joint, "range") or ""
        yield Suspect((of.name("joint", joint),), "range", now, "no limit", edits, probe, LIMIT, says, level="hint")
