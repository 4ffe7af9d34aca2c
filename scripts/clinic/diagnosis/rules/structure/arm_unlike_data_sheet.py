"""An arm that is called as one that is sold, and has another length or mass, or an axis that turns the other way.

Programs that reckon with the real arm's numbers, such as its inverse kinematics, miss by as much. One length is off by
a millimetre, taken from a sister model, or a sign is lost in one axis. Nothing falls and nothing shakes: it is seen
when the arm is told to go somewhere.

Bad:

    <mujoco model="ur5e">
      <worldbody>
        <body name="shoulder" pos="0 0 0.1625">
          <joint name="pan" axis="0 0 1"/>
          <geom type="sphere" size="0.05" mass="3.761"/>
          <body name="upper_arm" pos="0 0.138 0">
            <joint name="lift" axis="0 1 0"/>
            <geom type="capsule" size="0.04" fromto="0 0 0 0.425 0 0" mass="8.058"/>
            <body name="forearm" pos="0.425 -0.131 0">
              <joint name="elbow" axis="0 1 0"/>
              <geom type="capsule" size="0.03" fromto="0 0 0 0.3922 0 0" mass="2.846"/>
              <body name="wrist_1" pos="0.3922 0 0">
                <joint name="wrist_1" axis="0 1 0"/>
                <geom type="sphere" size="0.04" mass="1.37"/>
                <body name="wrist_2" pos="0 0.109 0">
                  <joint name="wrist_2" axis="0 0 -1"/>
                  <geom type="sphere" size="0.04" mass="1.3"/>
                  <body name="wrist_3" pos="0 0 -0.0997">
                    <joint name="wrist_3" axis="0 1 0"/>
                    <geom type="sphere" size="0.04" mass="0.365"/>
                  </body>
                </body>
              </body>
            </body>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -             <body name="wrist_2" pos="0 0.109 0">
    +             <body name="wrist_2" pos="0 0.1263 0">

The number: how far a distance between two axes in a row, or the offset between their two neighbours along an axis, is
from the data sheet's; more than 2 mm and 1 %, where at most two of an arm's are, and half of those that are not 0. Or
the axes, at most two, that point against those of the maker's description while all the others point along them.

Or how far the shoulder is from where the maker's base carries it, more than 2 mm; or how many times the links together
weigh what they do there, from 2 on, or from 1.02 where it is to 0.3 % what those of a sister model weigh; or by how
many degrees a range goes beyond theirs, from 3 to 45; or by how many the fingers of its own hand slide another way,
more than 5.

Lengths and axes are those of Denavit and Hartenberg, so that they do not depend on where the frames of the bodies are.
They are from the makers' own descriptions, for the arms in `probes/arms.toml`.

When it is wrong: an arm that was measured itself, or one of another series of the same name.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import SLIDE
from clinic.diagnosis.probes.arms import (
    NEAR,
    Arm,
    Measured,
    about_the_vertical,
    against,
    called,
    differs,
    direction,
    known_arms,
    longest_row,
    measured,
    rows_of_hinges,
)
from clinic.diagnosis.probes.vector import Vector, add, cross, dot, norm, sub, times, transpose, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import ENDLESS, Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "An arm unlike the data sheet of its name"
FAMILIES = ("wrong-numbers", "drifts", "wrong-mass", "passes-limit")
AFLOAT = True
UNPLANTED = "one of the 81 models of the bench is an arm that is sold"

TURNED, ACROSS = math.radians(5), 0.5  # of a hand; the sine of the angle between its fingers' way and the flange's axis
HAND = re.compile(r"^([\w/]*[_/])?(panda\d*|fr3|fer)?_?finger_joint\d$", re.IGNORECASE)  # of the makers' own hand
BASE = re.compile(r"(?<![a-z])base(?![a-z])|link_?0(?![0-9])", re.IGNORECASE)
FARTHER, ANOTHER, ROUND = math.radians(3), math.radians(45), 2 * math.pi - 0.1
HEAVY, SISTER, SAME = 2.0, 1.02, 0.003  # times the mass of the data sheet; with a sister's mass; how near to it
SUM = 0.03  # of the mass of the data sheet: how near to it one misplaced point brings the sum
LEAST = 5  # hinges in a row: no arm of the table has fewer
FEW = 2  # lengths, or axes, that may be wrong in an arm that is still the one of the data sheet


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Rows of hinges that have nearly all numbers of an arm whose name stands in the model."""
    arms = called(names_in(model)) if longest_row(model.simulation) >= LEAST else []
    for count in dict.fromkeys(len(arm.axes) for arm in arms):
        alike = [arm for arm in arms if len(arm.axes) == count]
        for row in rows_of_hinges(model.simulation, count):
            arm = min(alike, key=lambda arm: (len(_wrong(arm, row)), len(_farther(model, arm, row))))
            wrong = _wrong(arm, row)
            if len(wrong) <= FEW and 2 * len(wrong) <= sum(each > 0 for each in arm.numbers):
                yield from (_length(model, arm, row, which) for which in wrong)
                yield from _axes(model, arm, row)
                yield from _base(model, arm, row)
                yield from _hand(model, arm, row)
                yield from _mass(model, arm, row)
                yield from _ranges(model, arm, row)


def names_in(model: ReaderModel) -> str:
    """What a model and its parts are called."""
    source, of = model.source, model.simulation
    own = [source.main, source.root.get("model"), source.root.get("name")] if source is not None else []
    return " ".join([*own, *of.names("body"), *of.names("joint"), *of.names("mesh")])


def _wrong(arm: Arm, row: Measured) -> list[int]:
    pairs = zip(row.numbers, arm.numbers, strict=True) if arm.lengths else ()
    return [which for which, pair in enumerate(pairs) if differs(*pair)]


def _length(model: ReaderModel, arm: Arm, row: Measured, which: int) -> Suspect:
    of, count = model.simulation, len(arm.lengths)
    now, right = row.numbers[which], arm.numbers[which]
    first, last = (which, which + 2) if which < count else (which - count, which - count + 3)
    joints = row.joints[first:last]
    names = tuple(of.name("joint", joint) for joint in joints)
    probe = Probe("length off the data sheet", "m", _off, (row.joints, which, right), dynamic=False)
    edits = next(_moves(model, joints[1:], right - now, probe), ())
    of_what = "between the axes of" if which < count else "along the middle one of the axes of"
    says = f"The distance {of_what} these is {1000 * now:.4g} mm; of {arm.names[0]} it is {1000 * right:.4g} mm."
    value = edits[0].value if edits else ""
    return Suspect(names, "pos", f"{now:.4g} m", value, edits, probe, NEAR, says, f"{right:.4g} m", level="hint")


def _off(of: Simulation, joints: tuple[int, ...], which: int, right: float) -> float:
    return abs(measured(of, joints).numbers[which] - right)


def _moves(model: ReaderModel, joints: tuple[int, ...], longer: float, probe: Probe) -> Iterator[tuple[Edit, ...]]:
    """Edits of one coordinate of a body that give the length of the data sheet; those of the longest first."""
    of = model.simulation
    bodies = [of.body_of("joint", joint) for joint in joints]
    places = [(body, of.row("body_pos", body, 3)) for body in bodies]
    parts = [(abs(place[axis]), body, place, axis) for body, place in places for axis in range(3) if place[axis]]
    for part, body, place, axis in sorted(parts, reverse=True):
        moved = [x * (1 + longer / part) if each == axis else x for each, x in enumerate(place)]
        edits = model.placed(body, moved)
        if edits and model.measured(probe, edits) < NEAR:
            yield edits


def _axes(model: ReaderModel, arm: Arm, row: Measured) -> Iterator[Suspect]:
    """Axes against those of the data sheet, where all others are along them."""
    standing = min(about_the_vertical(arm.axes), key=lambda axes: _unlike(row, axes))
    turned = [which for which, axis in enumerate(row.axes) if against(direction(axis), standing[which])]
    if len(turned) > (FEW if arm.lengths else 1) or _unlike(row, standing) > len(turned):
        return
    for which in turned:
        joint, right = row.joints[which], standing[which]
        edits = model.turned_axis(joint)
        now, value = direction(row.axes[which]), edits[0].value if edits else ""
        probe = Probe("axis against the data sheet's", "", _against, (row.joints, which, right), dynamic=False)
        says = f"It turns about {now} as the arm stands at 0; that of {arm.names[0]} turns about {right}."
        name = model.simulation.name("joint", joint)
        yield Suspect((name,), "axis", now, value, edits, probe, 0.5, says, right, level="hint")


def _unlike(row: Measured, axes: Sequence[str]) -> int:
    return sum(direction(axis) != right for axis, right in zip(row.axes, axes, strict=True))


def _against(of: Simulation, joints: tuple[int, ...], which: int, right: str) -> float:
    return float(against(direction(measured(of, joints).axes[which]), right))


def _base(model: ReaderModel, arm: Arm, row: Measured) -> Iterator[Suspect]:
    """An arm whose shoulder is not where its base carries it."""
    of, height = model.simulation, arm.height
    body = of.body_of("joint", row.joints[0])
    parent = of.parent(body)
    urdf = model.urdf  # looked at afloat
    own = not of.model("body_weldid")[parent] or (
        urdf and not any(of.joints_of(each) for each in of.children[parent] if each != body)
    )
    if height is None or not own or not BASE.search(of.names("body")[parent]):
        return
    away = _away(of, row.joints, height)
    if norm(away) <= NEAR:
        return
    place = add(of.row("body_pos", body, 3), times(transpose(of.data_row("xmat", parent, 9)), away))
    edits = model.placed(body, place)
    probe = Probe("shoulder off where the base has it", "m", _sunk, (row.joints, height), dynamic=False)
    says = f"Its shoulder is {1000 * norm(away):.4g} mm off where the base of {arm.names[0]} has it: "
    says += f"{1000 * height:.4g} mm above the frame of the base."
    now, value = written(of.row("body_pos", body, 3)), written(place)
    yield Suspect((of.name("body", body),), "pos", now, value, edits, probe, NEAR, says, value, level="hint")


def _away(of: Simulation, joints: tuple[int, ...], height: float) -> Vector:
    """From where the shoulder is to where the base has it, in m."""
    row = measured(of, joints)
    of.as_written()
    parent = of.parent(of.body_of("joint", joints[0]))
    return sub(add(of.data_row("xpos", parent, 3), row.axes[0], height), row.shoulder)


def _sunk(of: Simulation, joints: tuple[int, ...], height: float) -> float:
    return norm(_away(of, joints, height))


def _hand(model: ReaderModel, arm: Arm, row: Measured) -> Iterator[Suspect]:
    """Fingers that slide another way than those of the arm's own hand: it is mounted at another angle."""
    of, last = model.simulation, model.simulation.body_of("joint", row.joints[-1])
    fingers = [
        joint
        for joint, body in enumerate(of.model("jnt_bodyid"))
        if of.joint_type(joint) == SLIDE and last in of.ancestors(int(body)) and HAND.search(of.names("joint")[joint])
    ]
    if arm.grip is None or len(fingers) != 2 or _aside(of, row.joints, fingers[0], arm.grip) <= TURNED:
        return
    off = math.degrees(_aside(of, row.joints, fingers[0], arm.grip))
    hand = of.name("body", of.parent(of.body_of("joint", fingers[0])))
    says = f"Its fingers slide {off:.0f} degrees aside from where those of {arm.names[0]} do: it is mounted so."
    names, value = (hand, *(of.name("joint", joint) for joint in fingers)), f"turned by {off:.0f} degrees"
    probe = Probe("way of the fingers off", "rad", _aside, (row.joints, fingers[0], arm.grip), dynamic=False)
    yield Suspect(names, "quat", "", value, (), probe, TURNED, says, value)


def _aside(of: Simulation, joints: tuple[int, ...], finger: int, grip: float) -> float:
    """By which angle a finger slides aside from the data sheet's way, in rad; to and fro are one way."""
    of.as_written()
    across, along, way = (of.axis(joint) for joint in (*joints[-2:], finger))
    side, front = dot(way, across), dot(way, cross(across, along))
    if math.hypot(side, front) < ACROSS:
        return 0.0
    return abs((math.atan2(side, front) - grip + math.pi / 2) % math.pi - math.pi / 2)


def _mass(model: ReaderModel, arm: Arm, row: Measured) -> Iterator[Suspect]:
    """An arm many times as heavy, or as light, as its links are, or one with the mass of a sister model."""
    of, weight = model.simulation, _weight(model.simulation, row.joints)
    if arm.mass is None:
        return
    off = max(weight / arm.mass, arm.mass / max(weight, 1e-9))
    sister = next((name for name, mass in _sisters(arm) if abs(weight / mass - 1) < SAME), "")
    if off <= (SISTER if sister else HEAVY):
        return
    alone = _shifted(of, row.joints, arm.mass)
    names = tuple(of.name("body", body) for body in ([alone[0]] if alone else _links(of, row.joints)))
    says = f"The links weigh {weight:.3g} kg together; those of {arm.names[0]} {arm.mass:.3g} kg."
    says += f" It is what those of {sister} weigh." if sister else ""
    probe = Probe("mass over the data sheet's", "", _heavy, (row.joints, arm.mass), dynamic=False)
    now, value, most = f"{weight:.3g} kg", f"{arm.mass:.3g} kg", SISTER if sister else HEAVY
    if alone:
        own = of.model("body_mass")[alone[0]]
        now, value = f"{own:.4g} kg", f"{own * alone[1]:.4g} kg"
        total = weight + own * (alone[1] - 1)
        says += f" With {value} in place of {now} for {names[0]} it is {total:.3g} kg: its point is misplaced."
    yield Suspect(names, "mass", now, value, (), probe, most, says, f"{arm.mass:.3g} kg", excess=off)


def _shifted(of: Simulation, joints: tuple[int, ...], right: float) -> tuple[int, float] | None:
    """The one link that with its mass times a power of ten brings the sum to the data sheet's, and that power."""
    masses, weight = of.model("body_mass"), _weight(of, joints)
    found = [
        (body, 10.0**power)
        for body in _links(of, joints)
        for power in (-3, -2, -1, 1, 2, 3)
        if abs((weight + masses[body] * (10.0**power - 1)) / right - 1) < SUM
    ]
    return found[0] if len(found) == 1 else None


def _sisters(arm: Arm) -> list[tuple[str, float]]:
    """Name and mass of the arms of as many axes whose name begins with the same letters: those of one maker."""
    stem = re.compile(re.sub("[^a-z].*", "", arm.names[0]) + "(?![a-z])")
    others = (each for each in known_arms() if len(each.axes) == len(arm.axes) and each != arm)
    return [(each.names[0], each.mass) for each in others if each.mass and stem.match(each.names[0])]


def _ranges(model: ReaderModel, arm: Arm, row: Measured) -> Iterator[Suspect]:
    """Joints that turn farther than those of the arm; where the axes are the same, so that their signs are."""
    of, beyond = model.simulation, _farther(model, arm, row)
    if not beyond or (any(arm.axes) and _unlike(row, arm.axes)):
        return
    unit = model.angle_unit
    worst = max(beyond, key=lambda joint: _beyond(of, joint, beyond[joint]))
    values = {joint: written([end / unit for end in right]) for joint, right in beyond.items()}
    now = written([end / unit for end in of.row("jnt_range", worst, 2)])
    edits = model.set_each("joint", "range", values)
    low, high = (math.degrees(end) for end in beyond[worst])
    says = (
        f"{of.name('joint', worst)} turns {math.degrees(_beyond(of, worst, beyond[worst])):.0f} degrees farther than "
    )
    says += f"that of {arm.names[0]}, which has {low:.0f} to {high:.0f} degrees."
    probe = Probe("range beyond the data sheet's", "rad", _beyond, (worst, beyond[worst]), dynamic=False)
    names = tuple(of.name("joint", joint) for joint in beyond)
    yield Suspect(names, "range", now, values[worst], edits, probe, FARTHER, says, values[worst], level="hint")


def _farther(model: ReaderModel, arm: Arm, row: Measured) -> dict[int, tuple[float, float]]:
    """The joints of a row that turn farther than the arm's, with the arm's ranges."""
    ranges = zip(row.joints, arm.ranges, strict=False)
    return {joint: right for joint, right in ranges if _beyond(model.simulation, joint, right) > FARTHER}


def _beyond(of: Simulation, joint: int, right: tuple[float, float]) -> float:
    """How much farther a joint turns, in rad; 0 for one that turns round, or has another zero."""
    low, high = of.ranges.get(joint, ENDLESS)
    if high - low > ROUND:
        return 0.0
    over = right[0] - low, high - right[1]
    return max(over) if max(map(abs, over)) < ANOTHER else 0.0


def _links(of: Simulation, joints: tuple[int, ...]) -> list[int]:
    return list(dict.fromkeys(of.body_of("joint", joint) for joint in joints))


def _weight(of: Simulation, joints: tuple[int, ...]) -> float:
    return sum(of.model("body_mass")[body] for body in _links(of, joints))


def _heavy(of: Simulation, joints: tuple[int, ...], right: float) -> float:
    over = _weight(of, joints) / right
    return max(over, 1 / max(over, 1e-9))
