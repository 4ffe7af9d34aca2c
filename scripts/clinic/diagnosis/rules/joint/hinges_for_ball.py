"""Three hinges, one after the other, let a body turn freely.

Three hinges in one body are Euler angles: with the second one at 90 degrees the first and the third turn about the same
axis, one of the three ways to turn is lost, and near that the speeds grow without bound. A `ball` joint, or a
`freejoint` in place of three slides and three hinges, has no such pose.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body pos="0 0 0.1">
          <joint type="slide" axis="1 0 0"/>
          <joint type="slide" axis="0 1 0"/>
          <joint type="slide" axis="0 0 1"/>
          <joint axis="1 0 0"/>
          <joint axis="0 1 0"/>
          <joint axis="0 0 1"/>
          <geom type="box" size="0.05 0.03 0.02"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body pos="0 0 0.1">
          <freejoint/>
          <geom type="box" size="0.05 0.03 0.02"/>
        </body>
      </worldbody>
    </mujoco>

The number: how many of a body's three ways to turn are lost where its second hinge is at 90 degrees. Told of bodies
with three hinges across one another that have no range, no actuator, no spring, no damping and no armature.

When it is wrong: a body that is turned little, and whose angles are wanted one by one.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.engine import HINGE, SLIDE
from clinic.diagnosis.probes.vector import cross, dot, norm
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Three hinges in place of a ball joint"
FAMILIES = ("explodes", "wrong-numbers", "drifts")
UNPLANTED = "three hinges without a range are rare, and harm in one pose alone"

ACROSS, LOST = 0.2, 0.5


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The bodies that three free hinges turn, all together."""
    of = model.simulation
    if of.count("tendon") or of.count("equality"):
        return
    every = [body for body in range(1, of.count("body")) if _turned_by_three(of, body)]
    for sliding in (True, False):
        if found := [body for body in every if _slides_too(of, body) is sliding]:
            yield _suspect(model, found, sliding)


def _suspect(model: ReaderModel, found: list[int], sliding: bool) -> Suspect:
    of = model.simulation
    hinges = _hinges(of, found[0])
    value = "<freejoint/> in place of all six" if sliding else 'type="ball" in place of the three'
    says = f"{of.name('joint', hinges[1])} at 90 degrees lays the axes of the other two hinges on one another."
    probe = Probe("ways to turn that are lost at 90 degrees", "", _lost, (found[0],), dynamic=False)
    names = (*(of.name("body", body) for body in found), *(of.name("joint", joint) for joint in hinges))
    at = model.element("joint", hinges[0])
    return Suspect(names, "type", "hinge, hinge, hinge", value, (), probe, LOST, says, value, at=at)


def _slides_too(of: Simulation, body: int) -> bool:
    """Whether a body of the world has three slides as well, and so could have a free joint."""
    slides = sum(of.joint_type(joint) == SLIDE for joint in of.joints_of(body))
    return slides == 3 and not of.parent(body)


def _hinges(of: Simulation, body: int) -> list[int]:
    return [joint for joint in of.joints_of(body) if of.joint_type(joint) == HINGE]


def _turned_by_three(of: Simulation, body: int) -> bool:
    hinges = _hinges(of, body)
    if len(hinges) != 3 or any(of.model("jnt_limited")[joint] or _held(of, joint) for joint in hinges):
        return False
    axes = [of.row("jnt_axis", joint, 3) for joint in hinges]
    return all(abs(dot(axes[i], axes[j])) < ACROSS for i, j in ((0, 1), (1, 2), (0, 2)))


def _held(of: Simulation, joint: int) -> bool:
    """Whether something but inertia acts on a joint."""
    dof = of.dof(joint)
    fields = ("dof_damping", "dof_frictionloss", "dof_armature")
    held = joint in of.drivers or bool(of.model("jnt_stiffness")[joint])
    return held or any(of.model(field)[dof] for field in fields)


def _lost(of: Simulation, body: int) -> float:
    """1 where the axes of the first and the third hinge are one line with the second at 90 degrees."""
    first, second, third = _hinges(of, body)
    of.begin(forward=False)
    of.put(second, math.pi / 2)
    of.engine.forward()
    return 1.0 - norm(cross(of.axis(first), of.axis(third)))
