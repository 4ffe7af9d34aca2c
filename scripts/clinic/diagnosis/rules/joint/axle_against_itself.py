"""The two wheels of an axle turn, or steer, against each other.

A fixed tendon with coefficients of opposite signs drives one wheel forward and the other one back: the car turns on the
spot. An equality with a negative factor toes both front wheels in, and the car skids straight on.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="5 5 0.1"/>
        <body name="car" pos="0 0 0.1">
          <freejoint/>
          <geom type="box" size="0.2 0.08 0.02" pos="0 0 0.03"/>
          <geom size="0.05" pos="0.15 0 -0.05" friction="0.01" priority="1"/>
          <body name="left" pos="-0.1 0.15 0">
            <joint name="left" axis="0 1 0"/>
            <geom type="cylinder" size="0.1 0.02" euler="90 0 0"/>
          </body>
          <body name="right" pos="-0.1 -0.15 0">
            <joint name="right" axis="0 1 0"/>
            <geom type="cylinder" size="0.1 0.02" euler="90 0 0"/>
          </body>
        </body>
      </worldbody>
      <tendon>
        <fixed name="shaft">
          <joint joint="left" coef="0.5"/>
          <joint joint="right" coef="-0.5"/>
        </fixed>
      </tendon>
      <actuator>
        <velocity tendon="shaft" kv="0.1"/>
      </actuator>
    </mujoco>

Good:

    -       <joint joint="right" coef="-0.5"/>
    +       <joint joint="right" coef="0.5"/>

The number: tendons of two hinges without a range on one line, neither of which anything else drives, and couplings of
two hinges that carry such a hinge each, side by side along its axis, with a sign that lets the two go against each
other. The directions of the axes count.

When it is wrong: a drive that is to turn a robot on the spot.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, set_attribute
from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.probes.couplings import couplings
from clinic.diagnosis.probes.tendons import joints_of, pulled
from clinic.diagnosis.probes.vector import Vector, dot, sub, unit, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "Two wheels of an axle against each other"
FAMILIES = ("drifts", "stuck", "slips")
UNPLANTED = "no healthy model of the bench drives two wheels by a tendon, or couples a steering"

ALONG = 0.95  # cosine


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Tendons that drive, and equalities that couple, the wheels of an axle against each other."""
    of = model.simulation
    for tendon in _driven_apart(of):
        (one, _), (other, coefficient) = joints_of(of, tendon)
        element, value = model.element("tendon", tendon), f"{-coefficient:g}"
        parts = [each for each in element.children if each.tag == "joint"] if element is not None else []
        edits: tuple[Edit, ...] = (set_attribute(parts[1], "coef", value),) if len(parts) > 1 else ()
        names = tuple(of.name(*each) for each in (("tendon", tendon), ("joint", other), ("joint", one)))
        says = f"It drives {names[2]} one way and {names[1]}, on the same line, the other way."
        probe = how_many("tendons that drive an axle's wheels apart", _driven_apart)
        yield Suspect(names, "coef", f"{coefficient:g}", value, edits, probe, 0, says, "the same way")
    for each in _steered_apart(of):
        follower, leader, factors = dict(couplings(of))[each]
        now, value = written(factors), written([factors[0], -factors[1], *factors[2:]])
        edits = model.set("equality", [each], "polycoef", value)
        names = tuple(of.name(*one) for one in (("equality", each), ("joint", follower), ("joint", leader)))
        says = f"{names[1]} and {names[2]} each turn a wheel of one axle, and go against each other."
        probe = how_many("couplings that steer an axle's wheels apart", _steered_apart)
        yield Suspect(names, "polycoef", now, value, edits, probe, 0, says, "the same way")


def _driven_apart(of: Simulation) -> list[int]:
    """The tendons that drive two wheels of an axle, which nothing else drives, in opposite directions."""
    driven, made = dict.fromkeys(pulled(of).values()), []
    for tendon in driven:
        pairs = joints_of(of, tendon)
        joints = {joint for joint, _ in pairs}
        others = {joint for each in driven if each != tendon for joint, _ in joints_of(of, each)} | set(of.drivers)
        if len(joints) == 2 == len(pairs) and not joints & others and all(map(of.continuous, joints)):
            (one, first), (other, second) = pairs
            of.begin()
            same = dot(of.axis(one), of.axis(other))
            if _side_by_side(of, one, other, of.axis(one)) and abs(same) > ALONG and first * second * same < 0:
                made.append(tendon)
    return made


def _steered_apart(of: Simulation) -> list[int]:
    """The couplings that turn the wheels of an axle, each by a hinge across its own, in opposite directions."""
    made = []
    for each, (follower, leader, factors) in couplings(of):
        wheels = [_wheel(of, joint) for joint in (follower, leader)]
        if None in wheels or wheels[0] == wheels[1]:
            continue
        of.begin()
        axes = [of.axis(joint) for joint in (follower, leader)]
        spins = [of.axis(wheel) for wheel in wheels if wheel is not None]
        same = dot(*axes)
        across = abs(dot(axes[0], spins[0])) < 1 - ALONG and abs(dot(*spins)) > ALONG and abs(same) > ALONG
        if across and _side_by_side(of, follower, leader, spins[0]) and factors[1] * same < 0:
            made.append(each)
    return made


def _wheel(of: Simulation, joint: int) -> int | None:
    """The one hinge without a range on what a hinge turns; None where there is none, or several."""
    if of.joint_type(joint) != HINGE:
        return None
    below = [each for body in of.below(of.body_of("joint", joint)) for each in of.joints_of(body) if each != joint]
    return below[0] if len(below) == 1 and of.continuous(below[0]) else None


def _side_by_side(of: Simulation, one: int, other: int, axis: Vector) -> bool:
    """Whether two joints are apart along an axis, and not much across it."""
    apart = sub(of.data_row("xanchor", one, 3), of.data_row("xanchor", other, 3))
    return any(apart) and abs(dot(unit(apart), axis)) > ALONG
