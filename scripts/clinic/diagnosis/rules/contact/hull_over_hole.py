"""A mesh collides as its convex hull, and the hull closes its hole.

Whatever a mesh looks like, what collides is its convex hull: a cup has a lid, a ring is a disc, a bracket is full. What
should fall in or pass through stops in the air, where nothing is drawn.

Bad:

    <mujoco>
      <asset>
        <mesh name="cup" vertex="-6 -6 0  6 -6 0  6 6 0  -6 6 0  -6 -6 8  6 -6 8  6 6 8  -6 6 8
          -5 -5 8  5 -5 8  5 5 8  -5 5 8  -5 -5 2  5 -5 2  5 5 2  -5 5 2" scale="0.01 0.01 0.01"
          face="0 2 1  0 3 2  0 1 5  0 5 4  4 5 9  4 9 8  8 9 13  8 13 12  1 2 6  1 6 5  5 6 10  5 10 9  9 10 14
          9 14 13  2 3 7  2 7 6  6 7 11  6 11 10  10 11 15  10 15 14  3 0 4  3 4 7  7 4 8  7 8 11  11 8 12  11 12 15
          12 13 14  12 14 15"/>
      </asset>
      <worldbody>
        <geom name="cup" type="mesh" mesh="cup"/>
        <body pos="0.01 0 0.2">
          <freejoint/>
          <geom name="die" type="box" size="0.02 0.02 0.02"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <geom name="floor" type="box" size="0.05 0.05 0.01" pos="0 0 0.01"/>
        <geom name="right" type="box" size="0.005 0.06 0.04" pos="0.055 0 0.04"/>
        <geom name="left" type="box" size="0.005 0.06 0.04" pos="-0.055 0 0.04"/>
        <geom name="back" type="box" size="0.05 0.005 0.04" pos="0 0.055 0.04"/>
        <geom name="front" type="box" size="0.05 0.005 0.04" pos="0 -0.055 0.04"/>
        <body pos="0.01 0 0.2">
          <freejoint/>
          <geom name="die" type="box" size="0.02 0.02 0.02"/>
        </body>
      </worldbody>
    </mujoco>

The number: how far from the mesh's own surface another mechanism touches it within 2 s, as a share of the mesh's
radius, or of 2.5 radii of what touches it where that is less; below 0.15 is well. MuJoCo's manual, Computation,
Collision detection: meshes are replaced by their hulls. The edit, `type="sdf"`, collides with the surface itself: it is
slow and may shake, and proves the cause. What to build instead are primitives, or the mesh cut into convex pieces.
Told, too, is a ball, capsule or cylinder that begins more than a twentieth of a radius inside of the hull and does not
meet the surface, as a bar in a hook. A hint tells of meshes that begin so in each other's hulls, as the links of a
chain do.

When it is wrong: a coarse collision mesh whose hull is meant to be filled. Parts of one mechanism, and two mechanisms
that collide, are not looked at.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import MESH
from clinic.diagnosis.probes.hulls import DEEP, closed_holes, holes_closed
from clinic.diagnosis.probes.surface import away, touched_off_surface
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Level, Suspect

TITLE = "A hull that closes a mesh's hole"
FAMILIES = ("falls-through", "stuck", "jumps-at-start")
AFLOAT = True
CASE = "ball-stops-above-cup"
LEVEL = "cause"
UNPLANTED = "the healthy models have no hollow mesh that something falls into"

AWAY = 0.15  # of the size of the mesh, or of what touches it


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Mesh geoms that are touched where they have no surface."""
    of = model.simulation
    for geom, share in touched_off_surface(of).items():
        if share <= AWAY or int(of.model("geom_type")[geom]) != MESH:
            continue
        edits = model.set("geom", [geom], "type", "sdf")
        says = "It is touched away from its own surface: on the hull."
        yield Suspect(
            (of.name("geom", geom),), "type", "mesh", "sdf", edits, away(geom), AWAY, says, "touched at its surface"
        )
    closed = closed_holes(of)
    geoms = sorted({geom for pair in closed for geom in pair if int(of.model("geom_type")[geom]) == MESH})
    if geoms:
        names, edits = tuple(of.name("geom", geom) for geom in geoms), model.set("geom", geoms, "type", "sdf")
        says = f"{len(closed)} pairs of meshes overlap at the start by their hulls, and their surfaces do not meet."
        things = {geom for pair in closed for geom in pair} - {*geoms}
        if things:
            says = f"{of.name('geom', min(things))} begins in its hull, and does not meet its surface."
        level: Level = "cause" if things else "hint"
        yield Suspect(names, "type", "mesh", "sdf", edits, holes_closed(), DEEP, says, "no overlap", level=level)
