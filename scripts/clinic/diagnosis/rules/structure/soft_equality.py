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

The number: the time constant times the damping ratio in s, whose square is the inverse of the stiffness; more than
0.1, which is 25 times as soft as MuJoCo's own 0.02, or 0.3 where a mocap body pulls: with that a weight hangs 0.9 m
below it. Or how far apart something is that is welded or connected, 2 s after letting go: more than 10 mm and 0.3 of
the smaller body's radius, where a time constant of two timesteps at least halves it.

When it is wrong: a mocap body that pulls gently, or another soft rope.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.probes.equalities import CONNECT, COUPLED, WELD, by_mocap, ends, held, kind_of, sited
from clinic.diagnosis.probes.vector import norm, sub
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "An equality that gives way"
FAMILIES = ("drifts", "sags")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "a soft equality may be meant"

MOST, BY_MOCAP = 0.1, 0.3  # s
SECONDS, GAP, SHARE = 2.0, 0.01, 0.3  # s, m, and of the smaller body's radius
OWN = "0.02 1"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The connections, welds and couplings of joints that are soft, all together."""
    of = model.simulation
    yield from _pulled_apart(model)
    soft = [each for each in range(of.count("equality")) if _softness(of, each) > _most(of, each)]
    if not soft:
        return
    worst = max(soft, key=lambda each: _softness(of, each))
    now = " ".join(f"{x:g}" for x in of.row("eq_solref", worst, 2))
    yield Suspect(
        tuple(of.name("equality", each) for each in soft),
        "solref",
        now,
        OWN,
        model.set("equality", soft, "solref", OWN),
        Probe("time constant of an equality", "s", _softest, tuple(soft), dynamic=False),
        min(_most(of, each) for each in soft),
        f"With solref {now} it is {(_softness(of, worst) / 0.02) ** 2:.0f} times as soft as MuJoCo's own.",
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
    says = f"{one} and {other} are {1000 * apart[worst]:.3g} mm apart where the equality holds them together."
    edits, most = model.set("equality", list(apart), "solref", value), apart[worst] / 2
    names = tuple(of.name("equality", each) for each in apart)
    yield Suspect(names, "solref", now, value, edits, probe, most, says, "a few millimetres")


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
