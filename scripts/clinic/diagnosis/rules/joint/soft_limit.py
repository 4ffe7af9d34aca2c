"""A joint goes far past its limit: the limit is soft by its own `solreflimit` or `solimplimit`.

A limit is a damped spring as a contact is. `solreflimit` has its time constant, 0.02 s by default, and `solimplimit`
how much of it acts. With 0.5 s in place of 0.02 s, or with a negative `solreflimit` that is a small stiffness, a joint
that comes with some speed goes past its range.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="elbow" axis="0 1 0" range="-60 60" solreflimit="0.5 1"/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.02"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <joint name="elbow" axis="0 1 0" range="-60 60" solreflimit="0.5 1"/>
    +       <joint name="elbow" axis="0 1 0" range="-60 60"/>

The number: the joint is put at its upper limit and moves outwards at 3 rad/s (0.3 m/s), without gravity, contacts,
springs and actuators; how much further it goes than with MuJoCo's own limit, over 0.15 rad (5 % of the range of a
slide). Above 1 is told. A time constant of 0.1 s is 0.6 of that.

When it is wrong: a bumper, a ligament, a limit that is meant to give way.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, remove_attribute
from clinic.diagnosis.engine import HINGE, SLIDE
from clinic.diagnosis.probes.servo import alone
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A limit that gives way"
FAMILIES = ("passes-limit", "sags")
UNPLANTED = "a soft limit may be meant"

SPEED = {HINGE: 3.0, SLIDE: 0.3}  # rad/s, m/s
FAR, SHARE = 0.15, 0.05  # rad of a hinge, share of the range of a slide
OWN = {"solreflimit": ("jnt_solref", (0.02, 1.0)), "solimplimit": ("jnt_solimp", (0.9, 0.95, 0.001, 0.5, 2.0))}
SECONDS, STEPS = 1.0, 1000


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Hinges and slides with a limit of their own that gives way, all together."""
    of = model.simulation
    far = {joint: gives for joint in _candidates(of) if (gives := _gives(of, joint)) > 1}
    if not far:
        return
    worst = max(far, key=lambda joint: far[joint])
    named = [each for each in OWN if any(model.value("joint", joint, each) for joint in far)]
    attribute = next((each for each in named if model.value("joint", worst, each)), "solreflimit")
    name = of.name("joint", worst)
    least = FAR if of.joint_type(worst) == HINGE else SHARE * _span(of, worst)
    unit, speed = ("rad", "3 rad/s") if of.joint_type(worst) == HINGE else ("m", "0.3 m/s")
    yield Suspect(
        tuple(of.name("joint", joint) for joint in sorted(far, key=lambda joint: -far[joint])),
        attribute,
        model.value("joint", worst, attribute) or "",
        "left out",
        tuple(dict.fromkeys(edit for joint in far for each in named for edit in _without(model, joint, each))),
        Probe("how much further than with MuJoCo's own limit a joint goes past it", "", _most, tuple(far)),
        1.0,
        f"At {speed} {name} goes {far[worst] * least:.3g} {unit} further past its limit than with MuJoCo's own.",
        "MuJoCo's own, 0.02 1",
    )


def _candidates(of: Simulation) -> list[int]:
    """Limited hinges and slides whose limits are softer than MuJoCo's own."""
    made = []
    for joint in of.ranges:
        time, ratio = of.row("jnt_solref", joint, 2)
        if time * ratio > 0.03 or -1000 < time <= 0 or of.row("jnt_solimp", joint, 5)[0] < 0.5:
            made.append(joint)
    return made


def _without(model: ReaderModel, joint: int, attribute: str) -> Iterator[Edit]:
    element = model.element("joint", joint)
    holder = model.source.written(element, attribute) if element is not None and model.source else None
    if holder is not None:
        yield remove_attribute(holder[0], attribute)


def _span(of: Simulation, joint: int) -> float:
    low, high = of.row("jnt_range", joint, 2)
    return max(high - low, 1e-9)


def _most(of: Simulation, *joints: int) -> float:
    return max(_gives(of, joint) for joint in joints)


@kept
def _gives(of: Simulation, joint: int) -> float:
    """How much further a joint goes than with MuJoCo's own limit, over what is allowed."""
    least = FAR if of.joint_type(joint) == HINGE else SHARE * _span(of, joint)
    own = {field: of.row(field, joint, len(usual)) for field, usual in OWN.values()}
    with alone(of, limp=True):
        far = _past(of, joint)
        try:
            for field, usual in OWN.values():
                of.engine.write_model(field, usual, len(usual) * joint)
            far -= _past(of, joint)
        finally:
            for field, row in own.items():
                of.engine.write_model(field, row, len(row) * joint)
    return far / least


def _past(of: Simulation, joint: int) -> float:
    """How far a joint goes past its upper limit in rad or m; nothing where the simulation breaks down."""
    high, far = of.row("jnt_range", joint, 2)[1], 0.0
    of.begin(forward=False)
    of.put(joint, high)
    of.engine.write("qvel", [SPEED[of.joint_type(joint)]], of.dof(joint))
    for _ in range(of.steps(SECONDS, STEPS)):
        of.engine.step()
        if of.unstable():
            return 0.0
        far = max(far, of.position(joint) - high)
        if of.data("qvel")[of.dof(joint)] < 0:
            break
    return far
