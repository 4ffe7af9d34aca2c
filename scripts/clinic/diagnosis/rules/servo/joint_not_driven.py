"""A joint has no actuator, and those that are like it have.

A line of `<actuator>` was forgotten, or a coupling: of left and right, or of all fingers, one hangs loose.

Bad:

    <mujoco>
      <worldbody>
        <body name="trunk" pos="0 0 1">
          <geom type="box" size="0.1 0.1 0.1"/>
          <body name="left_arm" pos="0 0.15 0">
            <joint name="left_arm" axis="0 1 0" damping="0.1"/>
            <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.02"/>
          </body>
          <body name="right_arm" pos="0 -0.15 0">
            <joint name="right_arm" axis="0 1 0" damping="0.1"/>
            <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.02"/>
          </body>
        </body>
      </worldbody>
      <actuator>
        <motor joint="left_arm" gear="10" ctrlrange="-1 1"/>
      </actuator>
    </mujoco>

Good:

          <motor joint="left_arm" gear="10" ctrlrange="-1 1"/>
    +     <motor joint="right_arm" gear="10" ctrlrange="-1 1"/>

The number: joints that no actuator, tendon, coupling or spring of their own moves, and that are like one that is moved:
the twin of left and right; the one of three and more that are called alike but for a number or a finger, unless the
others hang as deep as each other and it does not; or the one of two that are called so, on the same body, with the same
range and mass. The only loose joint with a range of a robot that has eight others and more is told as well. Where it
would be more than two, they are meant to be loose.

When it is wrong: a mechanism that is driven on one side, and whose other side the load closes.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence

from clinic.diagnosis.engine import TRN_IN_PARENT, TRN_TENDON, WRAP_JOINT
from clinic.diagnosis.probes.equalities import CONNECT, COUPLED, WELD, held, kind_of, sited
from clinic.diagnosis.probes.shape import root_of
from clinic.diagnosis.probes.siblings import groups
from clinic.diagnosis.probes.twins import twins
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A joint without an actuator among others that have one"
FAMILIES = ("stuck", "sags", "drifts")
UNPLANTED = "no kind of fault in the bench takes an actuator away"

MOST, MANY, NUMBER = 2, 8, re.compile(r"\d+")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The joints that hang loose, all together."""
    of = model.simulation
    found = _loose(of)
    if not 0 < len(found) <= MOST:
        return
    joint, like = next(iter(found.items()))
    says = f"Nothing drives {of.name('joint', joint)}, and {of.name('joint', like)} is driven."
    probe = how_many("joints that nothing drives beside others that are driven", _loose)
    names = tuple(of.name("joint", each) for each in found)
    yield Suspect(names, "joint", "no actuator", "an actuator", (), probe, 0, says, "each joint driven as its twin")


def _loose(of: Simulation) -> dict[int, int]:
    """The joints that nothing moves, and one that is like each and is moved."""
    moved = _moved(of)
    if not moved:
        return {}
    springs, made = of.model("jnt_stiffness"), {}
    for pair in twins(of).pairs["joint"]:
        some = [joint for joint in pair if joint in _moved_of(pair, moved, springs)]
        if len(some) == 1 and _turns(of, *pair):
            made[pair[0] + pair[1] - some[0]] = some[0]
    for group in (*groups(of, "joint"), *_pairs(of)):
        still = [joint for joint in group if joint not in _moved_of(group, moved, springs)]
        if len(still) == 1 and _turns(of, *group) and not _elsewhere(of, still[0], group):
            made[still[0]] = next(joint for joint in group if joint != still[0])
    return made or _only_one(of, moved | {joint for joint, stiffness in enumerate(springs) if stiffness})


def _moved_of(group: Collection[int], moved: Collection[int], springs: Sequence[float]) -> set[int]:
    """Those of alike joints that something moves: a spring does where it is not one that a driven joint has too."""
    usual = {springs[joint] for joint in group if joint in moved}
    return {joint for joint in group if joint in moved or (springs[joint] and springs[joint] not in usual)}


def _only_one(of: Simulation, moved: Collection[int]) -> dict[int, int]:
    """The one hinge or slide of a robot that nothing moves, where it has a range, and one that is moved."""
    roots, made = root_of(of), {}
    for root in set(roots):
        joints = [each for each in of.scalar_joints if roots[of.body_of("joint", each)] == root]
        loose = [each for each in joints if each not in moved]
        if root and len(joints) > MANY and len(loose) == 1 and loose[0] in of.ranges:
            made[loose[0]] = next(each for each in joints if each in moved)
    return made


def _pairs(of: Simulation) -> list[list[int]]:
    """Two joints that are called alike but for a number, of two bodies that hang on one and weigh the same."""
    made: dict[tuple[object, ...], list[int]] = {}
    for joint, name in enumerate(of.names("joint")):
        body = of.body_of("joint", joint)
        mass = round(of.model("body_subtreemass")[body], 6)
        key = (NUMBER.sub("#", name), of.parent(body), mass, of.row("jnt_range", joint, 2))
        if NUMBER.search(name) and len(of.joints_of(body)) == 1:
            made.setdefault(key, []).append(joint)
    return [each for each in made.values() if len(each) == 2]


def _elsewhere(of: Simulation, joint: int, group: Collection[int]) -> bool:
    """Whether as many joints are above all others of a group, and not above this one: the steered wheel of three."""
    depths = {each: _depth(of, each) for each in group}
    others = {depth for each, depth in depths.items() if each != joint}
    return len(others) == 1 and depths[joint] not in others


def _depth(of: Simulation, joint: int) -> int:
    """How many joints are above the body of a joint."""
    return sum(len(of.joints_of(body)) for body in of.ancestors(of.body_of("joint", joint))[1:])


def _turns(of: Simulation, *joints: int) -> bool:
    return all(joint in of.scalar_joints for joint in joints)


def _moved(of: Simulation) -> set[int]:
    """The joints that an actuator, a tendon or a coupling moves; none where other things are driven."""
    kinds = [int(each) for each in of.model("actuator_trntype")]
    if any(kind > TRN_IN_PARENT and kind != TRN_TENDON for kind in kinds):
        return set()
    made = set(of.drivers)
    if not made:
        return made
    wraps = zip(of.model("wrap_type"), of.model("wrap_objid"), strict=True) if of.count("tendon") else ()
    for wrapped, on in wraps:
        if int(wrapped) != WRAP_JOINT:
            return set()
        made.add(int(on))
    for each in range(of.count("equality")):
        kind = kind_of(of, each)
        if kind == COUPLED:
            made |= set(held(of, each))
        elif kind in (CONNECT, WELD) and not sited(of, each):
            made |= {joint for end in held(of, each) for body in of.ancestors(end) for joint in of.joints_of(body)}
        else:
            return set()
    return made
