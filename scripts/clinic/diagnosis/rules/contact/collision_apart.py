"""A body collides where nothing of it is seen.

The collision shape stands beside the visual one: a `pos`, an `origin` or a turn was given to one and not to the other.
Things are pushed by nothing, and go through what one sees.

Bad:

    <mujoco>
      <worldbody>
        <body name="tool" pos="0 0 0.5">
          <freejoint/>
          <geom name="seen" type="box" size="0.05 0.05 0.1" contype="0" conaffinity="0" mass="0"/>
          <geom name="touched" type="box" size="0.05 0.05 0.1" pos="0 0 0.3"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <geom name="touched" type="box" size="0.05 0.05 0.1" pos="0 0 0.3"/>
    +       <geom name="touched" type="box" size="0.05 0.05 0.1"/>

The number: how far the middles of the two are apart, or how far one is turned, where one shape, or one mesh, is in the
body once to be seen and once to be touched; more than 2 mm, or 5 degrees. One of 289 healthy models has such a pair,
and its later release has not.

When it is wrong: a body that shows one thing and guards another.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.engine import CAPSULE, CYLINDER, MESH, SPHERE
from clinic.diagnosis.probes.shape import solid
from clinic.diagnosis.probes.vector import at, dot, norm, of_quaternion, sub, transpose
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A collision shape beside what is seen"
FAMILIES = ("falls-through", "stuck", "jumps-at-start", "slips")
AFLOAT = True
UNPLANTED = "a collision shape that is moved aside harms by what happens to be there"

MOVED, TURNED = 2.0, 5.0  # mm; degrees
SAME = 1e-5  # m


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each shape that a body has twice, to be seen and to be touched, at two places."""
    of = model.simulation
    for body in range(1, of.count("body")):
        for seen, touched in _pairs(of, body):
            moved, turned = _moved(of, seen, touched), _turned(of, seen, touched)
            if moved <= MOVED and turned <= TURNED:
                continue
            far, most, unit = (_moved, MOVED, "mm") if moved > MOVED else (_turned, TURNED, "degrees")
            probe = Probe("what is touched is beside what is seen by", unit, far, (seen, touched), dynamic=False)
            names = (of.name("geom", touched), of.name("body", body))
            aside = f"{moved:.3g} mm and {turned:.3g} degrees aside"
            says = f"It has the shape of {of.name('geom', seen)}, which stands {aside}."
            attribute, width = ("pos", 3) if moved > MOVED else ("quat", 4)
            now = " ".join(f"{x:.4g}" for x in of.row(f"geom_{attribute}", touched, width))
            yield Suspect(names, attribute, now, f"that of {of.name('geom', seen)}", (), probe, most, says, "0")


def _pairs(of: Simulation, body: int) -> Iterator[tuple[int, int]]:
    """Shapes that a body shows once and is touched by once."""
    groups: dict[tuple[float, ...], list[int]] = {}
    for geom in of.geoms_of(body):
        size = (round(x, 5) for x in of.row("geom_size", geom, 3))
        groups.setdefault((of.model("geom_type")[geom], of.model("geom_dataid")[geom], *size), []).append(geom)
    for geoms in groups.values():
        if len(geoms) == 2 and solid(of, geoms[0]) != solid(of, geoms[1]):
            yield (geoms[1], geoms[0]) if solid(of, geoms[0]) else (geoms[0], geoms[1])


def _moved(of: Simulation, one: int, other: int) -> float:
    """In mm."""
    return 1000 * norm(sub(of.row("geom_pos", one, 3), of.row("geom_pos", other, 3)))


def _turned(of: Simulation, one: int, other: int) -> float:
    """In degrees; turns that give the same shape again are none."""
    kind, quaternions = int(of.model("geom_type")[one]), [of.row("geom_quat", geom, 4) for geom in (one, other)]
    if kind == SPHERE:
        return 0.0
    if kind == MESH:
        return math.degrees(2 * math.acos(min(1.0, abs(dot(*quaternions)))))
    first, second = (transpose(of_quaternion(each)) for each in quaternions)
    kept = (2,) if kind in (CAPSULE, CYLINDER) else (0, 1, 2)
    size = of.row("geom_size", one, 3)
    alike = {i: [j for j in kept if abs(size[i] - size[j]) < SAME] for i in kept}  # a cube has three alike
    return max(
        min(math.degrees(math.acos(min(1.0, abs(dot(at(first, i), at(second, j)))))) for j in alike[i]) for i in kept
    )
