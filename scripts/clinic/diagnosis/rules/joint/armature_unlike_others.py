"""One joint has far more armature than all others of its mechanism.

`armature` adds to the inertia of its own joint alone. With a thousand times that of its neighbours a motor of their
strength hardly turns it, and it swings for long once it turns.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="hip" axis="0 1 0" armature="0.1"/>
          <geom type="capsule" size="0.03" fromto="0 0 0 0 0 -0.3"/>
          <body pos="0 0 -0.3">
            <joint name="knee" axis="0 1 0" armature="100"/>
            <geom type="capsule" size="0.03" fromto="0 0 0 0 0 -0.3"/>
            <body pos="0 0 -0.3">
              <joint name="ankle" axis="0 1 0" armature="0.05"/>
              <geom type="capsule" size="0.03" fromto="-0.05 0 0 0.1 0 0"/>
            </body>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -         <joint name="knee" axis="0 1 0" armature="100"/>
    +         <joint name="knee" axis="0 1 0" armature="0.1"/>

The number: the armature over the largest of the other joints of the same type; more than 20, where at least two others
have some. Of the bench's healthy models the most is 10. Or hinges with a servo and without armature, where six others
of the mechanism, and seven in ten, have some; none of the bench's healthy models has such a hinge.

When it is wrong: a flywheel.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import HINGE, SLIDE
from clinic.diagnosis.probes.servo import servos
from clinic.diagnosis.probes.shape import root_of, roots
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "An armature unlike that of all others"
FAMILIES = ("stuck", "slow", "oscillates")
UNPLANTED = "an armature of its own is planted for servo-held-back"

MOST, OTHERS = 20.0, 2
MANY, NEARLY_ALL = 6, 0.7  # joints with armature, and their share of the driven ones, beside which one without is odd


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The joint with most armature of each mechanism and type, with that of the next."""
    of, owner = model.simulation, root_of(model.simulation)
    bodies, armature = of.model("jnt_bodyid"), of.model("dof_armature")
    yield from _left_out(model)
    for root in roots(of):
        for kind in (HINGE, SLIDE):
            alike = [joint for joint, body in enumerate(bodies) if owner[int(body)] == root]
            alike = [joint for joint in alike if of.joint_type(joint) == kind and armature[of.dof(joint)] > 0]
            alike.sort(key=lambda joint: -armature[of.dof(joint)])
            if len(alike) <= OTHERS or _times(of, *alike[:2]) <= MOST:
                continue
            joint, other = alike[:2]
            now, value = (f"{armature[of.dof(each)]:g}" for each in (joint, other))
            edits = model.set("joint", [joint], "armature", value)
            says = f"Of the {len(alike) - 1} others {of.name('joint', other)} has most, {value}."
            probe = Probe("armature over that of the next", "", _times, (joint, other), dynamic=False)
            name = of.name("joint", joint)
            yield Suspect((name,), "armature", now, value, edits, probe, MOST, says, f"up to {MOST:g} times", share=0.5)


def _left_out(model: ReaderModel) -> Iterator[Suspect]:
    """The hinges with a servo that have no armature where nearly all others with one do, all together."""
    of, owner = model.simulation, root_of(model.simulation)
    for root in roots(of):
        own = [each for each in servos(of) if each.hinge and owner[of.body_of("joint", each.joint)] == root]
        driven = list(dict.fromkeys(each.joint for each in own))
        bare = [joint for joint in driven if not of.model("dof_armature")[of.dof(joint)]]
        have = len(driven) - len(bare)
        if not bare or have < MANY or have < NEARLY_ALL * len(driven):
            continue
        names = tuple(of.name("joint", joint) for joint in bare)
        least = min(a for joint in driven if (a := of.model("dof_armature")[of.dof(joint)]))
        says = (
            f"{have} of {len(driven)} hinges with a servo have armature, {least:g} and more, and {names[0]} has none."
        )
        edits = model.set("joint", bare, "armature", f"{least:g}")
        probe = Probe("hinges with a servo and without armature", "", _bare, tuple(bare), dynamic=False)
        healthy = "armature for each motor, or for none"
        yield Suspect(names, "armature", "0", f"{least:g}", edits, probe, 0.5, says, healthy)


def _bare(of: Simulation, *joints: int) -> float:
    return float(sum(not of.model("dof_armature")[of.dof(joint)] for joint in joints))


def _times(of: Simulation, joint: int, other: int) -> float:
    armature = of.model("dof_armature")
    return armature[of.dof(joint)] / max(armature[of.dof(other)], 1e-12)
