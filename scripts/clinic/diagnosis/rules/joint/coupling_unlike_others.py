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
in that one it is on another branch, though a joint is as far above its follower as well. Or of three and more with
factors of one size, one alone bends the other way, and would leave its range less with its sign turned.

When it is wrong: a mechanism in which one coupling is of another kind than all others.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from clinic.diagnosis.edit import Edit, set_attribute
from clinic.diagnosis.probes.couplings import couplings, lost
from clinic.diagnosis.probes.equalities import COUPLED, held, kind_of
from clinic.diagnosis.probes.sides import sided
from clinic.diagnosis.probes.vector import dot, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.structure.equality_copied import copied_ends
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, how_many

TITLE = "A coupling unlike the others"
FAMILIES = ("stuck", "drifts", "jumps-at-start")
UNPLANTED = "few healthy models have three couplings"

ENOUGH, PARALLEL = 3, 0.95


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The one coupling that stands apart."""
    of = model.simulation
    for back, others in other_way(of).items():
        follower, leader = held(of, back)
        attribute, now, value, edits = with_factors(model, back, _turned(of.equality_data(back)[:5]))
        says = f"{of.name('joint', follower)} bends back where {of.name('joint', leader)} bends on, and leaves its "
        says += f"range; each of the {len(others)} others keeps to the same way."
        names = tuple(of.name("joint", joint) for joint in (follower, leader))
        probe = how_many("couplings of another sign", other_way)
        yield Suspect(names, attribute, now, value, edits, probe, 0, says, "couplings alike")
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


def with_factors(model: ReaderModel, each: int, factors: Sequence[float]) -> tuple[str, str, str, tuple[Edit, ...]]:
    """How a coupling gets other factors, in URDF by its `<mimic>`: the attribute, what it is and will be, the edits."""
    of, value = model.simulation, written(factors)
    element = model.element("joint", held(of, each)[0])
    if element is not None and (mimic := element.first("mimic")) is not None:
        value = f"{factors[1]:g}"
        edit = set_attribute(mimic, "multiplier", value)
        return "multiplier", mimic.get("multiplier", "1"), value, (edit,)
    now = written(of.equality_data(each)[:5])
    return "polycoef", now, value, model.set("equality", [each], "polycoef", value)


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


def other_way(of: Simulation) -> dict[int, list[int]]:
    """By coupling that bends the other way than all others of its size, and leaves its range so: those others."""
    steps, known = _relations(of), dict(couplings(of))
    groups: dict[tuple[object, ...], dict[int, float]] = {}
    of.begin()
    for each, (follower, leader, factors) in known.items():
        along = dot(of.axis(follower), of.axis(leader))
        if steps.get(each) and abs(along) > PARALLEL and factors[1] and follower not in sided(of, "joint"):
            groups.setdefault((steps[each], *map(abs, factors)), {})[each] = along * factors[1]
    made = {}
    for group in groups.values():
        for each, way in group.items() if len(group) >= ENOUGH else ():
            follower, leader, factors = known[each]
            others = [one for one in group if one != each]
            less = lost(of, ((follower, leader, _turned(factors)),)) < lost(of, (known[each],))
            if less and all(way * group[one] < 0 for one in others):
                made[each] = others
    return made


def _turned(factors: Sequence[float]) -> tuple[float, ...]:
    return (factors[0], *(-factor for factor in factors[1:]))


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
