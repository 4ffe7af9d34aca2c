"""An equality gives way like rubber.

`solref` of an equality is a time constant in s, 0.02 unless it is written, and a damping ratio. With 1 in place of 0.01
the loop takes seconds to close, the fingers drift apart, and a weld sags under what it carries.

Bad:

    <mujoco>
      <worldbody>
        <body name="box" pos="0 0 1">
          <freejoint/>
          <geom type="box" size="0.05 0.05 0.05"/>
        </body>
      </worldbody>
      <equality>
        <connect body1="box" anchor="0 0 0.05" solref="1 1"/>
      </equality>
    </mujoco>

Good:

    -     <connect body1="box" anchor="0 0 0.05" solref="1 1"/>
    +     <connect body1="box" anchor="0 0 0.05" solref="0.01 1"/>

The number: the time constant times the damping ratio in s, whose square is inverse to the stiffness; more than 0.1,
which is a spring 25 times as soft as that of MuJoCo's own 0.02, or 0.3 where a mocap body pulls. With the default
`solimp` a free body hangs 5 mm below its place at 0.1, 44 mm at 0.3 and 0.49 m at 1. Or how far apart something is that
is welded or connected, 2 s after letting go: more than 10 mm and 0.3 of the smaller body's radius, where a time
constant of two timesteps at least halves it.

A coupling is also soft where joint1 follows by a small factor, as a bed follows its lead screw by 0.00127 m/rad: MuJoCo
takes the mobility of both joints for that of the coupling, whatever the factor is, unless the flag `diagexact` is on.
Where that is 50 times too much, and 2 s after letting go joint1 is 5 % of its range off, exchanged joints and the
inverse of the factor are told.

When it is wrong: a mocap body that pulls gently, or another soft rope.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.probes.couplings import couplings
from clinic.diagnosis.probes.equalities import CONNECT, COUPLED, WELD, by_mocap, ends, held, kind_of, sited
from clinic.diagnosis.probes.run import let_go
from clinic.diagnosis.probes.vector import norm, sub, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import ENDLESS, Simulation, kept
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "An equality that gives way"
FAMILIES = ("drifts", "sags")
UNPLANTED = "a soft equality may be meant"

MOST, BY_MOCAP = 0.1, 0.3  # s
SECONDS, GAP, SHARE = 2.0, 0.01, 0.3  # s, m, and of the smaller body's radius
OWN = "0.02 1"
SOFTENED, OFF = 50.0, 0.05  # times the mobility that a coupling has; of the follower's range


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The connections, welds and couplings of joints that are soft, all together."""
    of = model.simulation
    yield from _pulled_apart(model)
    yield from _the_wrong_way_round(model)
    soft = [each for each in range(of.count("equality")) if _softness(of, each) > _most(of, each)]
    if not soft:
        return
    worst = max(soft, key=lambda each: _softness(of, each))
    now, softer = " ".join(f"{x:g}" for x in of.row("eq_solref", worst, 2)), (_softness(of, worst) / 0.02) ** 2
    yield Suspect(
        tuple(of.name("equality", each) for each in soft),
        "solref",
        now,
        OWN,
        model.set("equality", soft, "solref", OWN),
        Probe("time constant of an equality", "s", _softest, tuple(soft), dynamic=False),
        min(_most(of, each) for each in soft),
        f"With solref {now} its spring is {softer:.0f} times as soft as with {OWN}, the default.",
        f"MuJoCo's own, {OWN}, or shorter",
    )


def _pulled_apart(model: ReaderModel) -> Iterator[Suspect]:
    """Connections and welds that a load pulls apart, and that a shorter time constant holds together, all together."""
    of = model.simulation
    apart = {each: gap for each, gap in _gaps(of).items() if gap > max(GAP, SHARE * _reach(of, each))}
    if not apart:
        return
    worst = max(apart, key=lambda each: apart[each])
    value = f"{2 * of.timestep:g} 1"
    probe = Probe("greatest gap of what is held together, 2 s after letting go", "m", _widest, tuple(apart))
    now = " ".join(f"{x:g}" for x in of.row("eq_solref", worst, 2))
    one, other = (of.name("site" if sited(of, worst) else "body", each) for each in held(of, worst))
    says = f"{one} and {other} are {1000 * apart[worst]:.3g} mm apart where the equality is to hold them together."
    edits, most = model.set("equality", list(apart), "solref", value), apart[worst] / 2
    names = tuple(of.name("equality", each) for each in apart)
    yield Suspect(names, "solref", now, value, edits, probe, most, says, "a few millimetres")


def _the_wrong_way_round(model: ReaderModel) -> Iterator[Suspect]:
    """Couplings that give way because their factor is small, and hold with their joints exchanged, all together."""
    of, edits, found = model.simulation, tuple[Edit, ...](), dict[tuple[int, int, float], int]()
    for each, (follower, leader, factors) in couplings(of):
        key, linear = (follower, leader, factors[1]), not factors[0] and not any(factors[2:])
        if linear and _softened(of, *key) > SOFTENED and OFF < _off(of, key) < math.inf:
            found[key] = each
    names = of.names("joint")
    for (follower, leader, factor), each in found.items():
        for attribute, value in (
            ("joint1", names[leader]),
            ("joint2", names[follower]),
            ("polycoef", written([0.0, 1 / factor, 0.0, 0.0, 0.0])),
        ):
            edits += model.set("equality", [each], attribute, value)
    if not edits:
        return
    worst = max(found, key=lambda key: _off(of, key))
    joints = tuple(of.name("joint", joint) for joint in worst[:2])
    says = (
        f"2 s after letting go, {joints[0]} is {100 * _off(of, worst):.0f} % of its range from where {joints[1]} leads "
        f"it. MuJoCo softens a coupling by the mobility of both joints, and not by the factor {worst[2]:g}: here "
        f"{_softened(of, *worst):.2g} times too much. With joint1 and joint2 exchanged and the factor "
        f"{1 / worst[2]:g} it holds."
    )
    probe = Probe("how far what is coupled is from where it is led", "of its range", _off, tuple(found))
    told = (of.name("equality", found[worst]), *joints)
    yield Suspect(told, "joint1", names[worst[0]], names[worst[1]], edits, probe, OFF, says, "next to nothing")


def _softened(of: Simulation, follower: int, leader: int, factor: float) -> float:
    """How many times the mobility of a coupling MuJoCo takes for it; 0 where both orders are alike."""
    own, leading = (of.model("dof_invweight0")[of.dof(joint)] for joint in (follower, leader))
    return (own + leading) / (own + factor**2 * leading) if own and factor else 0.0


def _off(of: Simulation, *found: tuple[int, int, float]) -> float:
    """How far followers are from where they are led 2 s after letting go, as a share of their range; 0 without one."""
    end, most = let_go(of).end, 0.0
    for follower, leader, factor in found:
        if end is None:
            return math.inf
        own, leading = (end.qpos[of.place(each)] - of.model("qpos0")[of.place(each)] for each in (follower, leader))
        low, high = of.ranges.get(follower, ENDLESS)
        most = max(most, abs(own - factor * leading) / (high - low))
    return most


def _holding(of: Simulation) -> list[int]:
    """The active connections and welds that no mocap body moves."""
    every = [each for each in range(of.count("equality")) if of.model("eq_active0")[each] and -1 not in held(of, each)]
    return [each for each in every if kind_of(of, each) in (CONNECT, WELD) and not by_mocap(of, each)]


@kept
def _gaps(of: Simulation) -> dict[int, float]:
    """How far apart in m the connections and welds hold, 2 s after letting go; none where the model explodes."""
    holding = _holding(of)
    of.begin()
    for _ in of.run(SECONDS, samples=4) if holding else ():
        if of.unstable():
            return {}
    return {each: norm(sub(*ends(of, each))) for each in holding}


def _widest(of: Simulation, *equalities: int) -> float:
    return max(_gaps(of).get(each, math.inf) for each in equalities)


def _reach(of: Simulation, each: int) -> float:
    """The radius of the smaller of two bodies that are held together; 0 where one has no geoms."""
    bodies = [of.body_of("site", end) if sited(of, each) else end for end in held(of, each)]
    return min(max((of.model("geom_rbound")[geom] for geom in of.geoms_of(body)), default=0.0) for body in bodies)


def _softest(of: Simulation, *equalities: int) -> float:
    return max(_softness(of, each) for each in equalities)


def _softness(of: Simulation, each: int) -> float:
    """The time constant in s of an active equality; 0 for others."""
    if kind_of(of, each) not in (CONNECT, WELD, COUPLED) or not of.model("eq_active0")[each]:
        return 0.0
    time, ratio = of.row("eq_solref", each, 2)
    return time * ratio if time > 0 else 1 / math.sqrt(max(-time, 1e-12))


def _most(of: Simulation, each: int) -> float:
    return BY_MOCAP if by_mocap(of, each) else MOST
