"""A tendon that no joint makes longer or shorter.

All of its sites are on parts that do not move against each other, or the coefficients of a fixed tendon are 0, or take
each other away: two fingers that an equality lets close together, with coefficients 0.5 and -0.5. What drives the
tendon works against itself, its limit stops nothing, and a sensor of it reads a constant, or what a soft equality gives
way.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <geom type="box" size="0.05 0.05 0.02"/>
          <body pos="0 0.02 0.05">
            <joint name="left" type="slide" axis="0 1 0" range="0 0.04"/>
            <geom type="box" size="0.01 0.005 0.02"/>
          </body>
          <body pos="0 -0.02 0.05">
            <joint name="right" type="slide" axis="0 -1 0" range="0 0.04"/>
            <geom type="box" size="0.01 0.005 0.02"/>
          </body>
        </body>
      </worldbody>
      <tendon>
        <fixed name="split">
          <joint joint="left" coef="0.5"/>
          <joint joint="right" coef="-0.5"/>
        </fixed>
      </tendon>
      <equality>
        <joint joint1="left" joint2="right"/>
      </equality>
      <actuator>
        <position tendon="split" kp="100" ctrlrange="0 0.04"/>
      </actuator>
    </mujoco>

Good:

    -       <joint joint="right" coef="-0.5"/>
    +       <joint joint="right" coef="0.5"/>

The number: how many actuators, limits, springs and sensors such a tendon has. A tendon that is drawn, and no more, is
left alone.

When it is wrong: nothing known.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import OBJ_TENDON
from clinic.diagnosis.probes.couplings import couplings
from clinic.diagnosis.probes.tendons import joints_of, path, pulled
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A tendon whose length never changes"
FAMILIES = ("stuck", "sensor-reads-zero")
UNPLANTED = "what it is meant to cross, only intent knows"

LEAST = 1e-3  # of the largest coefficient


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Tendons of constant length that something uses."""
    of = model.simulation
    for tendon in range(of.count("tendon")):
        if not _used(of, tendon):
            continue
        fixed = bool(joints_of(of, tendon))
        what = "coefficients of its joints are 0 or take each other away" if fixed else "sites do not move apart"
        yield Suspect(
            (of.name("tendon", tendon),),
            "coef" if fixed else "site",
            "",
            "coefficients that add up" if fixed else "sites on both sides of a joint",
            (),
            Probe("uses of a tendon whose length never changes", "", _used, (tendon,), dynamic=False),
            0.5,
            f"No joint changes its length: the {what}. {_used(of, tendon):g} actuators, limits, springs or sensors "
            "use it.",
            "a tendon across a joint",
        )


def _used(of: Simulation, tendon: int) -> float:
    """How much a tendon of constant length is used; 0 for another one."""
    if not _constant(of, tendon):
        return 0.0
    driven = list(pulled(of).values()).count(tendon)
    read = zip(of.model("sensor_objtype"), of.model("sensor_objid"), strict=True)
    uses = [of.model("tendon_limited")[tendon], of.model("tendon_stiffness")[tendon]]
    return float(driven + sum(map(bool, uses)) + sum((int(a), int(b)) == (OBJ_TENDON, tendon) for a, b in read))


def _constant(of: Simulation, tendon: int) -> bool:
    if fixed := joints_of(of, tendon):
        return _cancelled(of, fixed)
    bodies = {of.body_of(kind, index) for kind, index in path(of, tendon)}
    return len({int(of.model("body_weldid")[body]) for body in bodies}) == 1


def _cancelled(of: Simulation, fixed: list[tuple[int, float]]) -> bool:
    """Whether the ways of joints, each by its coefficient and that of its coupling, add up to nothing."""
    leads = {follower: (leader, factors[1]) for _, (follower, leader, factors) in couplings(of)}
    sums: dict[int, float] = {}
    for joint, coefficient in fixed:
        top, way = joint, coefficient
        for _ in leads:
            leader, factor = leads.get(top, (top, 1.0))
            top, way = leader, way * factor
        sums[top] = sums.get(top, 0.0) + way
    largest = max(abs(coefficient) for _, coefficient in fixed)
    return all(abs(each) <= LEAST * largest for each in sums.values())
