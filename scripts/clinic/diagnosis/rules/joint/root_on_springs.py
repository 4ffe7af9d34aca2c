"""The joints of the root have a spring that was meant for the limbs.

A robot that moves on slides and hinges of its root takes their `stiffness` from the default class, like every other
joint. The spring then pulls it back to where it began, a little more with every metre. So does
`<joint type="free"/>`, and `<freejoint/>` does not.

Bad:

    <mujoco>
      <default>
        <joint stiffness="10" damping="1"/>
      </default>
      <worldbody>
        <body name="trunk" pos="0 0 1">
          <joint name="root_x" type="slide" axis="1 0 0"/>
          <joint name="root_z" type="slide" axis="0 0 1"/>
          <joint name="root_y" axis="0 1 0"/>
          <geom type="capsule" fromto="-0.2 0 0 0.2 0 0" size="0.05"/>
          <body pos="0.2 0 0">
            <joint name="hip" axis="0 1 0"/>
            <geom type="capsule" fromto="0 0 0 0 0 -0.4" size="0.03"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <joint name="root_x" type="slide" axis="1 0 0"/>
    +       <joint name="root_x" type="slide" axis="1 0 0" stiffness="0" damping="0"/>
    -       <joint name="root_z" type="slide" axis="0 0 1"/>
    +       <joint name="root_z" type="slide" axis="0 0 1" stiffness="0" damping="0"/>
    -       <joint name="root_y" axis="0 1 0"/>
    +       <joint name="root_y" axis="0 1 0" stiffness="0" damping="0"/>

The number: the largest stiffness of the root's joints, where a slide is among three and more that nothing drives, or
one is free, and none of them states its own.

When it is wrong: something that hangs on springs.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import FREE, SLIDE
from clinic.diagnosis.probes.shape import roots
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.joint.free_joint_held import held
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A root on the limbs' springs"
FAMILIES = ("drifts", "stuck")
UNPLANTED = "few healthy models have a root of slides"

FEW = 3


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The roots whose joints have a stiffness from a default class."""
    of = model.simulation
    stiffness = of.model("jnt_stiffness")
    for root in roots(of):
        joints = tuple(joint for joint in of.joints_of(root) if stiffness[joint] > 0 and joint not in of.drivers)
        own = any((each := model.element("joint", j)) is None or "stiffness" in each.attributes for j in joints)
        kinds = [of.joint_type(joint) for joint in joints]
        free = kinds == [FREE] and joints[0] not in held(of)
        if own or not (free or (len(joints) >= FEW and SLIDE in kinds)):
            continue
        probe = Probe("stiffness of the root's joints", "", _stiffest, joints, dynamic=False)
        now = f"{stiffness[joints[0]]:g} (default)"
        says = f"They pull {of.name('body', root)} back to where it begins."
        edits = tuple(edit for name in ("stiffness", "damping") for edit in model.set("joint", joints, name, "0"))
        yield Suspect(tuple(of.name("joint", j) for j in joints), "stiffness", now, "0", edits, probe, 0.0, says, "0")


def _stiffest(of: Simulation, *joints: int) -> float:
    return max(of.model("jnt_stiffness")[joint] for joint in joints)
