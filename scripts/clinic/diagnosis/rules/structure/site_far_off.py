"""A site stands far outside of the robot that it hangs on.

The `pos` of a site is told from its body, and is often written as if it were told from the world: a site for the head,
at 1.8 m above the floor, hangs on a pelvis that is itself at 1 m. What is measured or drawn there is elsewhere.

Bad:

    <mujoco>
      <worldbody>
        <body name="pelvis" pos="0 0 1">
          <freejoint/>
          <geom type="capsule" fromto="0 0 0 0 0 0.5" size="0.1"/>
          <geom type="sphere" size="0.1" pos="0 0 0.7"/>
          <geom type="capsule" fromto="0 0.1 0 0 0.1 -0.9" size="0.05"/>
          <site name="head" pos="0 0 1.75"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <site name="head" pos="0 0 1.75"/>
    +       <site name="head" pos="0 0 0.75"/>

The number: how far outside of the box around all geoms of its mechanism the site is at the start, as a share of that
box's diagonal; more than 0.3. Sites that a tendon or an actuator uses are left out.

When it is wrong: a place that is meant to be outside, such as a target to look at.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.engine import HFIELD, PLANE
from clinic.diagnosis.probes.shape import geoms_of_tree, root_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A site far outside of its robot"
FAMILIES = ("wrong-numbers", "sensor-reads-zero")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "where a site is meant to be stands nowhere"

FAR = 0.3  # of the box's diagonal


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each site of something that moves, where it is far from all geoms of that."""
    of = model.simulation
    if model.source is None:
        return
    bodies, users = of.model("site_bodyid"), [*model.source.elements("tendon", "actuator")]
    used = {each.get(name) for user in users for each in user.walk() for name in ("site", "sidesite")}
    for site, name in enumerate(of.names("site")):
        if name in used:
            continue
        probe = Probe(
            "distance outside of the box of its mechanism", "of its diagonal", _outside, (site,), dynamic=False
        )
        if model.measured(probe) <= FAR or model.element("site", site) is None:
            continue
        now = " ".join(f"{x:.4g}" for x in of.row("site_pos", site, 3))
        says = f"It hangs on {of.name('body', int(bodies[site]))}, and is outside of all that hangs together with that."
        yield Suspect((of.name("site", site),), "pos", now, "told from its body", (), probe, FAR, says, "below 0.3")


def _outside(of: Simulation, site: int) -> float:
    """How far a site is outside of the box around its mechanism's geoms, as a share of the box's diagonal."""
    root = root_of(of)[int(of.model("site_bodyid")[site])]
    kinds, radii = of.model("geom_type"), of.model("geom_rbound")
    geoms = [each for each in geoms_of_tree(of, root) if int(kinds[each]) not in (PLANE, HFIELD)] if root else []
    if not geoms:
        return 0.0
    of.begin()
    place = of.data_row("site_xpos", site, 3)
    places = [(of.data_row("geom_xpos", each, 3), radii[each]) for each in geoms]
    low, high = ([end(at[axis] + sign * radius for at, radius in places) for axis in range(3)]
                 for end, sign in ((min, -1), (max, 1)))  # fmt: skip
    beyond = [max(a - x, 0.0, x - b) for a, x, b in zip(low, place, high, strict=True)]
    return math.hypot(*beyond) / math.dist(low, high)
