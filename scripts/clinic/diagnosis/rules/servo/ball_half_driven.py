"""A ball joint has fewer motors than the three axes about which it turns.

On a ball joint `gear` is an axis: its first three numbers. With one number it is the x axis, and about the other two
nothing drives the joint. Three motors with `1 0 0`, `0 1 0` and `0 0 1`, times what they are to give, drive all three.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="wrist" type="ball"/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.03"/>
        </body>
      </worldbody>
      <actuator>
        <motor joint="wrist" gear="7" ctrlrange="-1 1"/>
      </actuator>
    </mujoco>

Good:

    -     <motor joint="wrist" gear="7" ctrlrange="-1 1"/>
    +     <motor joint="wrist" gear="7 0 0" ctrlrange="-1 1"/>
    +     <motor joint="wrist" gear="0 7 0" ctrlrange="-1 1"/>
    +     <motor joint="wrist" gear="0 0 7" ctrlrange="-1 1"/>

The number: about how many of its three axes the actuators of a ball joint turn it: the rank of their gears. MuJoCo's
manual, XML reference, actuator/general: for ball joints the first three elements of `gear` are the axis.

When it is wrong: a ball joint that is to be driven about one axis, and to swing about the others.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import BALL, TRN_IN_PARENT
from clinic.diagnosis.probes.vector import Vector, across, norm, unit
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A ball joint with too few motors"
FAMILIES = ("stuck", "drifts")
UNPLANTED = "the healthy models drive few ball joints"

AXES, LEAST = 3, 1e-6


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Ball joints that their actuators turn about one axis or two."""
    of = model.simulation
    for joint in range(of.count("joint")):
        driving = _driving(of, joint)
        if of.joint_type(joint) != BALL or not driving or not (missing := _missing(of, joint)):
            continue
        gears = [" ".join(f"{x:g}" for x in of.row("actuator_gear", each, 6)[:3]) for each in driving]
        axes = ("no axis", "one axis", "two axes")[AXES - int(missing)]
        says = (
            f"The gears of its actuators, {', '.join(gears)}, turn it about {axes}: on a ball joint a gear is an axis."
        )
        probe = Probe("axes of a ball joint that nothing drives", "", _missing, (joint,), dynamic=False)
        names = (of.name("joint", joint), *(of.name("actuator", each) for each in driving))
        element = model.element("actuator", driving[0])
        yield Suspect(names, "gear", gears[0], "three actuators", (), probe, 0, says, "three axes", at=element)


def _driving(of: Simulation, joint: int) -> list[int]:
    return [
        each
        for each, kind in enumerate(of.model("actuator_trntype"))
        if int(kind) <= TRN_IN_PARENT and int(of.model("actuator_trnid")[2 * each]) == joint
    ]


def _missing(of: Simulation, joint: int) -> float:
    """How many of the three axes are not among those of the gears."""
    spanned: list[Vector] = []
    for each in _driving(of, joint):
        left = tuple(of.row("actuator_gear", each, 6)[:3])
        for axis in spanned:
            left = across(left, axis)
        if norm(left) > LEAST:
            spanned.append(unit(left))
    return float(AXES - len(spanned))
