"""A joint's spring is at rest far outside of what the joint can reach.

`springref` of a hinge is an angle in the unit of the text. One that was written in degrees and is read as radians, or
belongs to another joint, presses the joint against its limit, or winds it up.

Bad:

    <mujoco>
      <compiler angle="radian"/>
      <worldbody>
        <body pos="0 0 1">
          <joint name="elbow" axis="0 1 0" range="-1 1" stiffness="1" springref="45" damping="0.1"/>
          <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02" mass="0.2"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <joint name="elbow" axis="0 1 0" range="-1 1" stiffness="1" springref="45" damping="0.1"/>
    +       <joint name="elbow" axis="0 1 0" range="-1 1" stiffness="1" springref="0.785" damping="0.1"/>

The number: how far the rest of the spring is beyond the range, or from the start where there is none; more than 2.5 rad
(6.3 rad without a range). Springs that preload a mechanism are up to 1.8 rad beyond. Of one joint alone more than
0.5 rad, where the springs of at least two others are at rest within 0.1 rad of their ranges.

When it is wrong: a preload by a long soft spring.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A spring at rest far outside of the range"
FAMILIES = ("drifts", "stuck", "jumps-at-start", "explodes")
LEVEL = "hint"

FAR = 2.5  # rad
ODD, NEAR, OTHERS = 0.5, 0.1, 2  # rad of one joint, rad of so many others
TURN = 6.3


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Hinges whose springs are wound up, all together."""
    simulation = model.simulation
    far = _off(simulation)
    found, limit = [joint for joint, off in far.items() if off > FAR], FAR
    odd = [joint for joint, off in far.items() if off > ODD]
    if not found and len(odd) == 1 and sum(off < NEAR for off in far.values()) >= OTHERS:
        found, limit = odd, ODD
    if not found:
        return
    begins = {joint: f"{simulation.model('qpos0')[simulation.place(joint)] / model.angle_unit:.6g}" for joint in found}
    edits = model.set_each("joint", "springref", begins)
    rest = simulation.model("qpos_spring")[simulation.place(found[0])]
    yield Suspect(
        tuple(simulation.name("joint", each) for each in found),
        "springref",
        f"{rest / model.angle_unit:.4g}",
        next((each.value for each in edits), ""),
        edits,
        Probe("how far a spring's rest is beyond the range", "rad", _farthest, dynamic=False),
        limit,
        f"The spring of {simulation.name('joint', found[0])} is at rest at {rest:.3g} rad.",
        "a rest that the joint can reach",
    )


def _off(simulation: Simulation) -> dict[int, float]:
    """How far the rest of each hinge's spring is beyond its range, in rad."""
    made = {}
    for joint, stiffness in enumerate(simulation.model("jnt_stiffness")):
        if stiffness > 0 and simulation.joint_type(joint) == HINGE:
            rest, begin = (simulation.model(field)[simulation.place(joint)] for field in ("qpos_spring", "qpos0"))
            low, high = simulation.ranges.get(joint, (begin - TURN + FAR, begin + TURN - FAR))
            shut = rest < low >= begin - NEAR or rest > high <= begin + NEAR  # a door that its spring holds shut
            made[joint] = 0.0 if shut and abs(rest - begin) < FAR else max(low - rest, rest - high, 0.0)
    return made


def _farthest(simulation: Simulation) -> float:
    return max(_off(simulation).values(), default=0.0)
