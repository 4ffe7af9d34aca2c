"""Two fingers move the same way, so that the gap between them never changes.

The factor of the coupling and the axes of two slides belong together: with opposite axes it is 1, with the same axis
-1. With one of the signs wrong a gripper carries its fingers to and fro, and grasps nothing. Fingers that nothing
couples are to close at equal controls: with the same axis and the same range they go side by side.

Bad:

    <mujoco>
      <worldbody>
        <body name="left" pos="0.03 0 1">
          <joint name="left" type="slide" axis="1 0 0" range="0 0.04"/>
          <geom type="box" size="0.01 0.01 0.04"/>
        </body>
        <body name="right" pos="-0.03 0 1">
          <joint name="right" type="slide" axis="1 0 0" range="0 0.04"/>
          <geom type="box" size="0.01 0.01 0.04"/>
        </body>
      </worldbody>
      <equality>
        <joint joint1="left" joint2="right"/>
      </equality>
    </mujoco>

Good:

    -       <joint name="right" type="slide" axis="1 0 0" range="0 0.04"/>
    +       <joint name="right" type="slide" axis="-1 0 0" range="0 0.04"/>

The number: how far the two move the same way, as a share of how far they move; 0 for fingers that close, 1 for two that
keep their distance. The axis is turned where the coupling leads within the range, and else the factor. It is the
axis of the finger whose range leads it past the middle between the two, or else of the one that follows.
Without a coupling it is two slides of one hand, one called a finger or the like, that begin at the same end of ranges
which are alike and go to one side, and stand beside each other along their axes.

When it is wrong: a telescope, whose stages follow each other; they do not hang on one body.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.engine import SLIDE, WRAP_JOINT
from clinic.diagnosis.probes.couplings import Coupling, couplings, lost
from clinic.diagnosis.probes.vector import add, dot, norm, sub, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Fingers that move the same way"
FAMILIES = ("stuck", "slips")
UNPLANTED = "no healthy model has two slides that are coupled"

MOST = 0.9
FINGER = re.compile(r"(?i)finger|gripper|claw|jaw|thumb|pinch|hand(?!le)")
ALIKE, BESIDE = 0.05, 0.7  # of the range; of the distance


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Slides of one body that do not change their distance: coupled ones, and fingers that nothing couples."""
    of = model.simulation
    yield from _uncoupled(model)
    for each, coupling in couplings(of):
        follower, leader, factors = coupling
        hang = {of.parent(of.body_of("joint", joint)) for joint in (follower, leader)}
        kinds = {of.joint_type(joint) for joint in (follower, leader)}
        if len(hang) > 1 or kinds != {SLIDE} or _together(of, each) <= MOST:
            continue
        wrong = _crossing(of, follower, leader)
        element, joint = model.element("equality", each), model.element("joint", wrong)
        axis = joint.first("axis") if joint is not None else None  # of URDF, whose <mimic> has no place of its own
        if joint is None or (element is None and axis is None):
            continue
        turned = written([-x for x in of.row("jnt_axis", wrong, 3)])
        coefficients = written([factors[0], *(-x for x in factors[1:])])
        within = lost(of, (coupling,)) <= 0.5
        edit = set_attribute(joint, "axis", turned)
        led = model.element("joint", follower)
        mimic = led.first("mimic") if led is not None else None
        if mimic is not None and mimic.get("multiplier") and not within:
            edit = set_attribute(mimic, "multiplier", f"{-factors[1]:g}")
        elif axis is not None:
            edit = set_attribute(axis, "xyz", turned)
        elif element is not None and not within:
            edit = set_attribute(element, "polycoef", coefficients)
        yield Suspect(
            tuple(of.name("joint", joint) for joint in (wrong, follower + leader - wrong)),
            edit.attribute,
            "",
            edit.value,
            (edit,),
            Probe("share of their way that two fingers go together", "", _together, (each,), dynamic=False),
            MOST,
            f"{of.name('joint', follower)} goes where {of.name('joint', leader)} goes: the gap never changes.",
            "fingers that close",
        )


def sign_lost(of: Simulation, equality: int, coupling: Coupling) -> bool:
    """Whether two fingers go together, one of them out of its range, and with the other sign neither does."""
    follower, leader, factors = coupling
    slides = all(of.joint_type(joint) == SLIDE for joint in (follower, leader))
    turned = (follower, leader, (factors[0], *(-x for x in factors[1:])))
    return slides and _together(of, equality) > MOST and lost(of, (turned,)) < ALIKE


def _uncoupled(model: ReaderModel) -> Iterator[Suspect]:
    """Pairs of fingers without a coupling that equal ways carry to the same side."""
    of = model.simulation
    hands: dict[int, list[int]] = {}
    bound = {joint for _, (follower, leader, _) in couplings(of) for joint in (follower, leader)}
    for each, kind in enumerate(of.model("wrap_type")):
        if int(kind) == WRAP_JOINT:
            bound.add(int(of.model("wrap_objid")[each]))
    for joint, kind in enumerate(of.model("jnt_type")):
        if int(kind) == SLIDE and joint not in bound:
            hands.setdefault(of.parent(of.body_of("joint", joint)), []).append(joint)
    for hand, joints in hands.items():
        if len(joints) != 2 or not _fingers(of, hand, joints) or _aside(of, *joints) <= MOST:
            continue
        wrong = _crossing(of, *joints[::-1])
        axis = written([-x for x in of.row("jnt_axis", wrong, 3)])
        names = of.name("joint", wrong), of.name("joint", sum(joints) - wrong)
        edits = model.set("joint", [wrong], "axis", axis)
        probe = Probe("share of their way that two fingers go together", "", _aside, tuple(joints), dynamic=False)
        says = f"{names[0]} goes to the side of {names[1]}, and their ranges are alike."
        yield Suspect(names, "axis", "", axis, edits, probe, MOST, says, "fingers that close")


def _fingers(of: Simulation, hand: int, joints: Sequence[int]) -> bool:
    """Whether two slides are fingers by name, with ranges that are alike and go to one side, and driven alike."""
    bodies = [of.body_of("joint", joint) for joint in joints]
    names = [of.engine.name("joint", joint) for joint in joints]
    names += [of.engine.name("body", body) for body in (hand, *bodies)]
    (low, high), other = (of.row("jnt_range", joint, 2) for joint in joints)
    alike = max(abs(low - other[0]), abs(high - other[1])) < ALIKE * (high - low)
    oneway = min(abs(low), abs(high)) < ALIKE * (high - low)
    limited = all(of.model("jnt_limited")[joint] for joint in joints)
    if bodies[0] == bodies[1] or not any(map(FINGER.search, names)):
        return False
    return limited and alike and oneway and _driven(of, joints)


def _driven(of: Simulation, joints: Sequence[int]) -> bool:
    """Whether the actuators of both push to the same side of the joints at the same control."""
    sides: dict[int, list[float]] = {joint: [] for joint in joints}
    for each in range(of.count("actuator")):
        joint = of.driven_joint(each)
        if joint in sides:
            sides[joint].append(math.copysign(1.0, of.gain(each)[0] * of.gear(each)))
    return sides[joints[0]] == sides[joints[1]]


def _aside(of: Simulation, one: int, other: int) -> float:
    """The share of their way that two slides go together, where they stand beside each other along it; else 0."""
    of.begin()
    axes = [of.axis(joint) for joint in (one, other)]
    bodies = [of.body_of("joint", joint) for joint in (one, other)]
    apart = sub(of.data_row("subtree_com", bodies[0], 3), of.data_row("subtree_com", bodies[1], 3))
    if abs(dot(axes[0], apart)) <= BESIDE * norm(apart):
        return 0.0
    together = norm(add(axes[0], axes[1]))
    return together / max(together + norm(sub(axes[0], axes[1])), 1e-9)


def _crossing(of: Simulation, one: int, other: int) -> int:
    """The one of two fingers that its range leads past the middle between them; the first where both or none are."""
    of.as_written()
    places = [of.data_row("subtree_com", of.body_of("joint", joint), 3) for joint in (one, other)]
    found = []
    for joint, (own, there) in ((one, places), (other, places[::-1])):
        way = max((end - of.model("qpos0")[of.place(joint)] for end in of.row("jnt_range", joint, 2)), key=abs)
        between = sub(there, own)
        if way * dot(of.axis(joint), between) > dot(between, between) / 2:
            found.append(joint)
    return found[0] if len(found) == 1 else one


def _together(simulation: Simulation, equality: int) -> float:
    follower, leader, factors = next(found for each, found in couplings(simulation) if each == equality)
    simulation.begin()
    ways = [simulation.axis(joint) for joint in (follower, leader)]
    own = tuple(factors[1] * x for x in ways[0])
    return norm(add(own, ways[1])) / max(norm(add(own, ways[1])) + norm(sub(own, ways[1])), 1e-9)
