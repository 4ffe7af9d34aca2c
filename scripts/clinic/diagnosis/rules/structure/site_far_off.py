"""A site stands far outside of the robot that it hangs on.

The `pos` of a site is told from its body, and is often written as if it were told from the world: a site for the head,
at 1.8 m above the floor, hangs on a pelvis that is itself at 1 m. What is measured or drawn there is elsewhere.

Bad:

    <mujoco>
      <worldbody>
        <body name="pelvis" pos="0 0 1">
          <freejoint/>
          <geom type="capsule" fromto="0 0 0 0 0 0.5" size="0.1" mass="20"/>
          <geom type="sphere" size="0.1" pos="0 0 0.7" mass="4"/>
          <geom type="capsule" fromto="0 0.1 0 0 0.1 -0.9" size="0.05" mass="8"/>
          <site name="head" pos="0 0 1.75"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <site name="head" pos="0 0 1.75"/>
    +       <site name="head" pos="0 0 0.75"/>

The number: how far outside of the box around all geoms and bodies of its mechanism the site is at the start, as a
share of that box's diagonal; more than 0.3, and than 0.5 m. Sites that a tendon, an actuator or an equality uses, and
those that are called a target, are left out.

When it is wrong: a place that is meant to be outside, such as a target to look at.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

from clinic.diagnosis.probes.shape import mechanisms, root_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A site far outside of its robot"
FAMILIES = ("wrong-numbers", "sensor-reads-zero")
UNPLANTED = "where a site is meant to be stands nowhere"

FAR, LEAST = 0.3, 0.5  # of the box's diagonal; m
USES = ("site", "sidesite", "site1", "site2", "refsite", "cranksite", "slidersite")
MEANT = re.compile("target|goal|tcp|grasp|label|camera|view|look|aim|point|marker", re.IGNORECASE)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each site of something that moves, where it is far from all geoms of that."""
    of = model.simulation
    if model.source is None:
        return
    users = [*model.source.elements("tendon", "actuator", "equality")]
    used = {each.get(name) for user in users for each in user.walk() for name in USES}
    boxes = _boxes(of)
    for site, name in enumerate(of.names("site")):
        far, beyond = _outside(of, boxes, site)
        if far <= FAR or beyond <= LEAST or name in used or MEANT.search(name) or model.element("site", site) is None:
            continue
        now = " ".join(f"{x:.4g}" for x in of.row("site_pos", site, 3))
        body = of.name("body", of.body_of("site", site))
        says = f"It hangs on {body}, and is {beyond:.3g} m outside of the box around all that moves with that."
        probe = Probe("distance outside of the box of its mechanism", "of its diagonal", _far, (site,), dynamic=False)
        yield Suspect((of.name("site", site),), "pos", now, "told from its body", (), probe, FAR, says, "below 0.3")


def _far(of: Simulation, site: int) -> float:
    return _outside(of, _boxes(of), site)[0]


@kept
def _boxes(of: Simulation) -> dict[int, tuple[list[float], list[float]]]:
    """The ends of the box around all geoms and bodies of each mechanism at the start, by its root."""
    of.begin()
    radii = of.model("geom_rbound")
    made: dict[int, tuple[list[float], list[float]]] = {}
    for root, geoms in mechanisms(of).items():
        places = [(of.data_row("geom_xpos", each, 3), radii[each]) for each in geoms]
        places += [(of.data_row("xpos", each, 3), 0.0) for each in of.below(root)]
        low = [min(place[axis] - radius for place, radius in places) for axis in range(3)]
        made[root] = low, [max(place[axis] + radius for place, radius in places) for axis in range(3)]
    return made


def _outside(of: Simulation, boxes: dict[int, tuple[list[float], list[float]]], site: int) -> tuple[float, float]:
    """How far a site is outside of the box of its mechanism: as a share of its diagonal, and in m."""
    root = root_of(of)[of.body_of("site", site)]
    if root not in boxes:
        return 0.0, 0.0
    low, high = boxes[root]
    place = of.data_row("site_xpos", site, 3)
    beyond = math.hypot(*(max(a - x, 0.0, x - b) for a, x, b in zip(low, place, high, strict=True)))
    return beyond / math.dist(low, high), beyond
