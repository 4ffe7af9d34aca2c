"""A link rubs on the fixed base that it turns on, in all of its range, so that friction holds the joint.

MuJoCo does not let a body collide with its parent, unless the parent is fixed to the world. Two collision meshes whose
faces just meet may be enough: the contact is there at every angle, and the motor has to turn against it. A depth of a
micrometre holds a hinge against 0.5 N m.

Bad:

    <mujoco>
      <worldbody>
        <body name="base">
          <geom type="cylinder" size="0.1 0.1" pos="0 0 0.1"/>
          <body name="shoulder" pos="0 0 0.2">
            <joint name="turn" axis="0 0 1" range="-170 170"/>
            <geom type="cylinder" size="0.08 0.1" pos="0 0 0.099"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

        </worldbody>
    +   <contact>
    +     <exclude body1="base" body2="shoulder"/>
    +   </contact>

The number: the share of 21 poses over the range, or over a turn where there is none, in which the two touch; the other
joints are at their start. What slides has to be 0.5 mm deep in something else than a plane. MuJoCo's manual,
Computation, Collision detection: the filter of parents.

When it is wrong: a brake or a bearing that is modelled by its friction. Deep overlaps are told by
`overlap-of-relatives`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.engine import PLANE, SLIDE
from clinic.diagnosis.probes.overlap import legged, of_relatives
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A link that rubs on its fixed base"
FAMILIES = ("stuck",)
UNPLANTED = "whether a base touches the link on it is the geoms', which no edit of one number changes"

POSES, ALWAYS, DEEP = 21, 0.99, 0.1
FLUSH, PRESSED = 1e-7, 5e-4  # m: what rounding may part; deep in what is no floor


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each hinge of a body on a fixed one that touches it at every angle."""
    of = model.simulation
    for joint in of.scalar_joints:
        body = of.body_of("joint", joint)
        base = of.parent(body)
        fixed = not of.model("body_weldid")[base] and (base or of.joint_type(joint) == SLIDE)
        if not fixed or _share(of, joint, body, base) < ALWAYS:
            continue
        told_elsewhere = model.measured(of_relatives()) > DEEP or legged(model)  # as an overlap, or by its free joint
        if told_elsewhere:
            return
        names = of.names("body")[base] if base else "world", of.names("body")[body]
        xml = '<exclude body1="{}" body2="{}"/>'.format(*names)
        edits = model.add("contact", xml) if all(names) and not set("".join(names)) & set('"&<') else ()
        told = of.name("body", base), of.name("body", body)
        fixed_base = f"{told[0]}, which is fixed to the world," if base else "what is fixed to the world"
        says = f"{told[1]} touches {fixed_base} wherever {of.name('joint', joint)} stands."
        probe = Probe("share of the poses in which the two touch", "", _share, (joint, body, base), dynamic=False)
        yield Suspect((of.name("joint", joint), *told), "exclude", "none", "excluded", edits, probe, 0.5, says, "none")


def _share(of: Simulation, joint: int, body: int, base: int) -> float:
    """The share of poses of a joint in which its body and the one below are no further apart than FLUSH."""
    slides, kinds = of.joint_type(joint) == SLIDE, of.model("geom_type")
    low, high = of.ranges.get(joint, (-math.pi, math.pi))
    least = -PRESSED if slides else FLUSH  # what slides is not carried by what it touches
    owners, place, margins = of.model("geom_bodyid"), of.place(joint), list(of.model("geom_margin"))
    touched, condims = 0, of.model("geom_condim")
    of.begin(forward=False)
    of.engine.write_model("geom_margin", [max(margin, FLUSH) for margin in margins])
    try:
        for pose in range(POSES):
            of.engine.write("qpos", [low + (high - low) * pose / (POSES - 1)], place)
            of.engine.forward()
            near = (each.geoms for each in of.engine.contacts() if min(each.geoms) >= 0 and each.distance < least)
            rough = (geoms for geoms in near if max(condims[geom] for geom in geoms) > 1)
            rough = (geoms for geoms in rough if not (slides and PLANE in (int(kinds[geom]) for geom in geoms)))
            touching = any({int(owners[geom]) for geom in geoms} == {body, base} for geoms in rough)
            if not touching and pose < 2:
                return 0.0
            touched += touching
    finally:
        of.engine.write_model("geom_margin", margins)
    return touched / POSES
