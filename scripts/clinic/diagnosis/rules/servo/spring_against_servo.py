"""A joint's spring pulls against its servo.

A position servo is a spring towards its target, and `stiffness` is one towards `springref`. Between the two the joint
stops short by stiffness / (stiffness + kp) of the way.

Bad:

    <mujoco>
      <default>
        <joint stiffness="50" damping="1" armature="0.1"/>
      </default>
      <worldbody>
        <body pos="0 0 1">
          <joint name="elbow" axis="0 0 1" range="-90 90"/>
          <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02" mass="0.2"/>
        </body>
      </worldbody>
      <actuator>
        <position joint="elbow" kp="100" kv="6" ctrlrange="-1.57 1.57"/>
      </actuator>
    </mujoco>

Good:

    <mujoco>
      <default>
        <joint damping="1" armature="0.1"/>
      </default>
      <worldbody>
        <body pos="0 0 1">
          <joint name="elbow" axis="0 0 1" range="-90 90"/>
          <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02" mass="0.2"/>
        </body>
      </worldbody>
      <actuator>
        <position joint="elbow" kp="100" kv="6" ctrlrange="-1.57 1.57"/>
      </actuator>
    </mujoco>

The number: stiffness over stiffness and gain, which is the share of the way that is missing at rest, without load;
above 0.2.

When it is wrong: a finger that a spring opens, or a creature whose muscles work against tissue.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.servo import Servo, servos
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A spring that pulls against the servo"
FAMILIES = ("sags", "stuck")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "whether a spring is meant, its maker knows"

MOST = 0.2  # of the way


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The servos that springs keep off their targets, all together."""
    of = model.simulation
    found = sorted((each for each in servos(of) if _share(of, each) > MOST), key=lambda each: -_share(of, each))
    if not found:
        return
    worst, joints = found[0], [each.joint for each in found]
    stiffness = of.model("jnt_stiffness")[worst.joint]
    says = f"A spring of {stiffness:.3g} against a gain of {worst.stiffness:.3g} N m/rad (N/m) keeps "
    says += f"{100 * _share(of, worst):.0f} % of the way."
    names = tuple(name for each in found for name in (of.name("joint", each.joint), of.name("actuator", each.actuator)))
    probe = Probe("share of the way to a target that springs keep", "", _most, (), dynamic=False)
    edits = model.set("joint", joints, "stiffness", "0")
    yield Suspect(names, "stiffness", f"{stiffness:.3g}", "0", edits, probe, MOST, says, "0, or far below the gain")


def _share(of: Simulation, servo: Servo) -> float:
    stiffness = of.model("jnt_stiffness")[servo.joint]
    return stiffness / (stiffness + servo.stiffness)


def _most(of: Simulation) -> float:
    return max((_share(of, each) for each in servos(of)), default=0.0)
