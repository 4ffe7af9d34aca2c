"""A spring that nothing drives has no damper.

`damping` and `frictionloss` are 0 unless a model gives them. What hangs or stands on such a spring swings at its own
frequency for ever, for neither air nor rubbing takes the energy out.

Bad:

    <mujoco>
      <default>
        <default class="strut">
          <joint type="slide" axis="0 0 1" range="-0.05 0.05" stiffness="2000"/>
        </default>
      </default>
      <worldbody>
        <geom type="plane" size="3 3 0.1"/>
        <body name="car" pos="0 0 0.11">
          <freejoint/>
          <geom type="box" size="0.2 0.1 0.03" mass="4"/>
          <body name="left" pos="0 0.15 0">
            <joint name="left_strut" class="strut"/>
            <geom type="box" size="0.2 0.02 0.1" mass="0.3"/>
          </body>
          <body name="right" pos="0 -0.15 0">
            <joint name="right_strut" class="strut"/>
            <geom type="box" size="0.2 0.02 0.1" mass="0.3"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <joint type="slide" axis="0 0 1" range="-0.05 0.05" stiffness="2000"/>
    +       <joint type="slide" axis="0 0 1" range="-0.05 0.05" stiffness="2000" damping="41"/>

The number: how many hinges and slides between two parts that move have a `stiffness`, no `damping`, no `frictionloss`
and no actuator (of a slide a motor is none), where no tendon, equality or air takes energy out; hinges whose spring
holds the weight within half a rad. The edit gives them 0.3 of critical damping. Of 465 healthy models none has such a
spring.

When it is wrong: a study of a swing that is to go on, as of a runner on a spring of no loss.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.engine import SLIDE
from clinic.diagnosis.probes.couplings import couplings
from clinic.diagnosis.probes.equalities import COUPLED
from clinic.diagnosis.probes.load import loads
from clinic.diagnosis.probes.tendons import joints_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Suspect, how_many, rounded

TITLE = "A spring without a damper"
FAMILIES = ("oscillates", "drifts")
LEVEL = "hint"
UNPLANTED = "few healthy models have a spring that nothing drives"

SHARE, BENDS = 0.3, 0.5  # of critical damping; rad


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The springs that swing for ever, all together."""
    of = model.simulation
    if not (found := _undamped(of)):
        return
    values = {joint: rounded(2 * SHARE * math.sqrt(k * _moved(of, joint))) for joint, k in found.items()}
    joints, worst = tuple(found), max(found, key=lambda joint: found[joint])
    most = max(values.values(), key=float)
    giver = model.giver("joint", joints, "stiffness") if len(set(found.values())) == 1 else None
    edits = (set_attribute(giver, "damping", most),) if giver else model.set_each("joint", "damping", values)
    says = f"{of.name('joint', worst)} has a spring of {found[worst]:.3g} {'N/m' if _slides(of, worst) else 'N m/rad'} "
    says += "and neither damping nor friction: what sets it swinging never ends."
    names, probe = tuple(of.name("joint", joint) for joint in joints), how_many("springs without a damper", _undamped)
    yield Suspect(names, "damping", "0", most, edits, probe, 0, says, "0.3 of critical damping", level="hint")


@kept
def _undamped(of: Simulation) -> dict[int, float]:
    """The springs that nothing damps of what moves freely, by joint, with their stiffness."""
    fixed = [joints_of(of, tendon) for tendon in range(of.count("tendon"))]
    tied = {joint for each in fixed for joint, _ in each}
    tied |= {joint for _, coupling in couplings(of) for joint in coupling[:2]}
    loops = any(int(kind) != COUPLED for kind in of.model("eq_type")) or not all(fixed)
    if loops or of.in_fluid:
        return {}
    springs = of.model("jnt_stiffness")
    found = [each for each in of.scalar_joints if springs[each] > 0 and each not in tied]
    return {joint: springs[joint] for joint in found if of.parent(of.body_of("joint", joint)) in of.moving_bodies
            and not any(of.model(f"dof_{name}")[of.dof(joint)] for name in ("damping", "frictionloss"))
            and _holds(of, joint)}  # fmt: skip


def _holds(of: Simulation, joint: int) -> bool:
    """Whether nothing but motors drives a slide, or the spring of a hinge alone holds its weight within half a rad."""
    if _slides(of, joint):
        return all(map(of.is_motor, of.drivers.get(joint, ())))
    return joint not in of.drivers and loads(of)[of.dof(joint)] < BENDS * of.model("jnt_stiffness")[joint]


def _slides(of: Simulation, joint: int) -> bool:
    return of.joint_type(joint) == SLIDE


def _moved(of: Simulation, joint: int) -> float:
    """What swings on a spring: of a slide its part of what stands on all of them, of a hinge its own inertia."""
    own = of.mass_diagonal[of.dof(joint)]
    if not _slides(of, joint):
        return own
    like = [each for each in _undamped(of) if _slides(of, each)]
    return max(own, of.moving_mass / len(like))
