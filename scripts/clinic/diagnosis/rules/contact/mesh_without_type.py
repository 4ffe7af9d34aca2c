"""A geom names a mesh and no type, and is a sphere.

`<geom mesh="link">` without `type="mesh"` is a sphere, fitted to the mesh: it looks like a ball and collides as one.

Bad:

    <mujoco>
      <asset>
        <mesh name="wedge" vertex="0 0 0 0.4 0 0 0 0.05 0 0 0 0.05"/>
      </asset>
      <worldbody>
        <body pos="0 0 1">
          <freejoint/>
          <geom name="wedge" mesh="wedge"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <geom name="wedge" mesh="wedge"/>
    +       <geom name="wedge" type="mesh" mesh="wedge"/>

The number: geoms with a mesh for which no type is written, neither on them nor in a default class.

When it is wrong: a ball's mesh, as which a sphere is as good; `type="sphere"` says that it is meant.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import SPHERE
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "A mesh that became a sphere"
FAMILIES = ("falls-through", "stuck", "wrong-mass", "jumps-at-start")
UNPLANTED = "a sphere may be what is meant"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """All geoms that are spheres by default and have a mesh."""
    of, source = model.simulation, model.source
    if source is None or source.urdf:
        return
    found = []
    for geom, kind in enumerate(of.model("geom_type")):
        element = model.element("geom", geom)
        if int(kind) == SPHERE and element is not None and source.value(element, "mesh"):
            found += [geom] if source.value(element, "type") is None else []
    if found:
        first, radius = model.value("geom", found[0], "mesh"), of.model("geom_rbound")[found[0]]
        says = f"Without a type it is a sphere with a radius of {radius:.3g} m, fitted to mesh {first!r}."
        names = tuple(of.name("geom", geom) for geom in found)
        edits = model.set("geom", found, "type", "mesh")
        probe = counted("meshes that are spheres", len(found))
        yield Suspect(names, "type", "left out", "mesh", edits, probe, 0.5, says, 'type="mesh"')
