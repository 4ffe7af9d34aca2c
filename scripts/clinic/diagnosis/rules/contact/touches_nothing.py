"""A foot, a wheel or a finger has no geom that collides.

What a robot stands on or grasps with is seen, and passes through everything: its collision geom was forgotten, or the
geoms that are there belong to a class for looks alone.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="2 2 0.1"/>
        <body name="car" pos="0 0 0.1">
          <freejoint/>
          <geom type="box" size="0.2 0.1 0.03"/>
          <body name="left_wheel" pos="0 0.15 0">
            <joint axis="0 1 0"/>
            <geom type="cylinder" size="0.1 0.02" euler="90 0 0" contype="0" conaffinity="0"/>
          </body>
          <body name="right_wheel" pos="0 -0.15 0">
            <joint axis="0 1 0"/>
            <geom type="cylinder" size="0.1 0.02" euler="90 0 0" contype="0" conaffinity="0"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <geom type="plane" size="2 2 0.1"/>
        <body name="car" pos="0 0 0.1">
          <freejoint/>
          <geom type="box" size="0.2 0.1 0.03"/>
          <body name="left_wheel" pos="0 0.15 0">
            <joint axis="0 1 0"/>
            <geom type="cylinder" size="0.1 0.02" euler="90 0 0"/>
          </body>
          <body name="right_wheel" pos="0 -0.15 0">
            <joint axis="0 1 0"/>
            <geom type="cylinder" size="0.1 0.02" euler="90 0 0"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

The number: bodies that are called a wheel, caster, tyre, foot, finger, pad, jaw or claw, that have geoms and none which
collides, nor has what hangs on them, while other parts of the same robot collide.

When it is wrong: parts that another geom stands in for, such as a sphere of the calf for the foot.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.probes.shape import root_of, solid
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A foot, wheel or finger that touches nothing"
FAMILIES = ("falls-through", "slips", "drifts")
SINCE = "0.1"
AFLOAT = True
LEVEL = "hint"
UNPLANTED = "only names say what a part is for"

PART = re.compile(
    r"(?<![a-z])[lr]?(wheel|caster|castor|tyre|tire|foot|feet|paw|finger|fingertip|pad|jaw|claw)s?(?![a-z])",
    re.IGNORECASE,
)

CASTER = re.compile(r"caster|castor", re.IGNORECASE)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The parts by name that do not collide, all together."""
    of = model.simulation
    found = _bare(of)
    if not found:
        return
    geoms = [geom for body in found for geom in of.geoms_of(body)]
    probe = Probe("feet, wheels and fingers without a geom that collides", "", _count, (), dynamic=False)
    names = (*(of.name("body", body) for body in found), *(of.name("geom", geom) for geom in geoms))
    says = f"{of.name('body', found[0])} has no geom that can touch anything, and other parts of the robot have."
    masks = ", ".join(f"{int(of.model(f'geom_{mask}')[geoms[0]])}" for mask in ("contype", "conaffinity"))
    yield Suspect(
        names, "contype, conaffinity", masks, "1, 1", (), probe, 0, says, "a geom that collides", level="hint"
    )  # fmt: skip


def _count(simulation: Simulation) -> float:
    return float(len(_bare(simulation)))


def _bare(of: Simulation) -> list[int]:
    """The parts that should touch something, and cannot."""
    owner, names = root_of(of), of.names("body")
    touches = {body for body in range(1, of.count("body")) if any(solid(of, geom) for geom in of.geoms_of(body))}
    paired = {int(of.model("geom_bodyid")[int(geom)]) for side in (1, 2) for geom in of.model(f"pair_geom{side}")}
    carriers = {above for body in touches | paired for above in of.ancestors(body)[1:-1]}
    near = touches | paired | carriers
    robots = {owner[body] for body in touches if owner[body]}
    welds = of.model("body_weldid")
    stiff = {int(welds[body]) for body in touches}  # a pad is often the skin of what it is fixed to; a caster is not
    parts = [body for body in of.moving_bodies if PART.search(names[body]) and of.geoms_of(body)]
    parts = [body for body in parts if int(welds[body]) not in stiff or CASTER.search(names[body])]
    return [body for body in parts if body not in near and owner[body] in robots]
