"""One of several couplings is with the joint of another finger.

The last joint of each finger follows the one before it, and one finger's follows that of its neighbour: a line was
copied and half adapted.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="a1" axis="0 1 0" damping="0.1"/>
          <geom type="capsule" fromto="0 0 0 0.05 0 0" size="0.008"/>
          <body pos="0.06 0 0">
            <joint name="a2" axis="0 1 0" damping="0.1"/>
            <geom type="capsule" fromto="0 0 0 0.03 0 0" size="0.008"/>
          </body>
        </body>
        <body pos="0 0.03 1">
          <joint name="b1" axis="0 1 0" damping="0.1"/>
          <geom type="capsule" fromto="0 0 0 0.05 0 0" size="0.008"/>
          <body pos="0.06 0 0">
            <joint name="b2" axis="0 1 0" damping="0.1"/>
            <geom type="capsule" fromto="0 0 0 0.03 0 0" size="0.008"/>
          </body>
        </body>
        <body pos="0 0.06 1">
          <joint name="c1" axis="0 1 0" damping="0.1"/>
          <geom type="capsule" fromto="0 0 0 0.05 0 0" size="0.008"/>
          <body pos="0.06 0 0">
            <joint name="c2" axis="0 1 0" damping="0.1"/>
            <geom type="capsule" fromto="0 0 0 0.03 0 0" size="0.008"/>
          </body>
        </body>
      </worldbody>
      <equality>
        <joint joint1="a2" joint2="a1"/>
        <joint joint1="b2" joint2="a1"/>
        <joint joint1="c2" joint2="c1"/>
      </equality>
    </mujoco>

Good:

    -     <joint joint1="b2" joint2="a1"/>
    +     <joint joint1="b2" joint2="b1"/>

The number: three and more couplings of two joints each. In all but one the leader is as many joints above its follower;
in that one it is on another branch, though a joint is as far above its follower as well.

When it is wrong: a mechanism in which one coupling is of another kind than all others.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.equalities import COUPLED, held, kind_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.structure.equality_copied import copied_ends
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A coupling unlike the others"
FAMILIES = ("stuck", "drifts", "jumps-at-start")
UNPLANTED = "few healthy models have three couplings"

ENOUGH = 3


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The one coupling that stands apart."""
    of = model.simulation
    if (each := _odd(of)) is None or (each, 0) in copied_ends(of):
        return
    follower, leader = held(of, each)
    others = [one for one in _relations(of) if one != each]
    wanted = _line(of, follower)[_relations(of)[others[0]] or 0]
    says = f"It couples {of.name('joint', follower)} to {of.name('joint', leader)}, which is on another branch; "
    says += f"each of the {len(others)} others couples two joints of one branch."
    probe = Probe("couplings that stand apart from all others", "", _count, dynamic=False)
    names = (of.name("joint", follower), of.name("joint", leader))
    now, value = of.names("joint")[leader], of.names("joint")[wanted]
    edits = model.set("equality", [each], "joint2", value) if value else ()
    yield Suspect(names, "joint2", now, value, edits, probe, 0, says, "couplings alike")


def _count(of: Simulation) -> float:
    return 0.0 if _odd(of) is None else 1.0


def _odd(of: Simulation) -> int | None:
    """The coupling with another branch, where all others are of joints of one branch, by as many joints."""
    found = _relations(of)
    apart = [each for each, relation in found.items() if relation is None]
    usual = {relation for relation in found.values() if relation is not None}
    if len(found) < ENOUGH or len(apart) != 1 or len(usual) != 1:
        return None
    return apart[0] if 0 < usual.pop() < len(_line(of, held(of, apart[0])[0])) else None


def _relations(of: Simulation) -> dict[int, int | None]:
    """By coupling of two joints: how many joints the second is above the first; 0 beside it, None elsewhere."""
    made: dict[int, int | None] = {}
    for each in range(of.count("equality")):
        joints = held(of, each)
        if kind_of(of, each) != COUPLED or min(joints) < 0:
            continue
        lines = [_line(of, joint) for joint in joints]
        if joints[1] in lines[0]:
            made[each] = lines[0].index(joints[1])
        elif joints[0] in lines[1]:
            made[each] = -lines[1].index(joints[0])
        else:
            beside = len({of.parent(of.body_of("joint", joint)) for joint in joints}) == 1
            made[each] = 0 if beside else None
    return made


def _line(of: Simulation, joint: int) -> list[int]:
    """A joint and those above it, the nearest first."""
    bodies = of.ancestors(of.body_of("joint", joint))
    return [each for body in bodies for each in reversed(of.joints_of(body)) if each <= joint]
