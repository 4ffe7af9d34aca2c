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
below it.

When it is wrong: a mocap body that pulls gently, or another soft rope.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.probes.equalities import CONNECT, COUPLED, WELD, by_mocap, kind_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "An equality that gives way"
FAMILIES = ("drifts", "sags")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "a soft equality may be meant"

MOST, BY_MOCAP = 0.1, 0.3  # s
OWN = "0.02 1"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The connections, welds and couplings of joints that are soft, all together."""
    of = model.simulation
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
