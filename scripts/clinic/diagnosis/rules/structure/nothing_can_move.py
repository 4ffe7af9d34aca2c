"""Nothing in the model can move.

A body without a joint is welded to its parent, and one below `<worldbody>` to the world; so is every geom of
`<worldbody>` itself. Gravity does nothing to it.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="2 2 0.1"/>
        <body name="box" pos="0 0 0.5">
          <geom type="box" size="0.1 0.1 0.1" mass="2"/>
        </body>
      </worldbody>
    </mujoco>

Good:

          <body name="box" pos="0 0 0.5">
    +       <freejoint/>

The number: 1 where a model with gravity and a plane has no joint at all, and a body hangs in the air above the plane;
else 0. Geoms of the world itself count where they are meshes, or hang alone above a plane.

When it is wrong: a model that is meant to be looked at only; one with a camera is left alone.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, insert, replace
from clinic.diagnosis.engine import MESH, PLANE
from clinic.diagnosis.probes.shape import boxes, plane_heights
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Nothing can move"
FAMILIES = ("stuck", "falls-through")
LEVEL = "cause"
UNPLANTED = "a healthy model in which nothing moves is left out of the bench"

FREE_JOINT = "<freejoint/>"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Everything that stands in the world, where the model has no degree of freedom."""
    of = model.simulation
    planes = [geom for geom in of.geoms_of(0) if int(of.model("geom_type")[geom]) == PLANE]
    if of.count("dof") or of.count("camera") or not planes or model.source is None or model.urdf or not of.gravity:
        return
    kinds, in_air = of.model("geom_type"), _in_air(of)
    roots = [body for body in range(1, of.count("body")) if of.parent(body) == 0 and of.geoms_of(body)]
    bodies = [body for body in roots if in_air.issuperset(of.geoms_of(body))]
    others = [geom for geom in of.geoms_of(0) if int(kinds[geom]) != PLANE]
    geoms = [geom for geom in others if int(kinds[geom]) == MESH or (len(others) == 1 and geom in in_air)]
    if bodies:
        edits = tuple(insert(element, FREE_JOINT) for body in bodies if (element := model.element("body", body)))
    else:
        edits = tuple(
            edit for geom in geoms if (element := model.element("geom", geom)) for edit in _own_body(model, element)
        )
    names = [of.name("body", body) for body in bodies] or [of.name("geom", geom) for geom in geoms]
    if names:
        says = f"The model has no joint, and gravity does nothing to what hangs in the air: {len(names)} of its parts."
        probe = Probe("parts that nothing can move", "", _still, dynamic=False)
        yield Suspect(tuple(names), "freejoint", "left out", FREE_JOINT, edits, probe, 0.5, says, "a free joint each")


def _own_body(model: ReaderModel, geom: Element) -> tuple[Edit, ...]:
    """A body with a free joint around a geom, at its place."""
    attributes = {name: value for name, value in geom.attributes.items() if name != "pos"}
    inner = "<geom " + " ".join(f'{name}="{value}"' for name, value in attributes.items()) + "/>"
    place = f' pos="{geom.get("pos")}"' if geom.get("pos") else ""
    return (replace(geom, f"<body{place}>{FREE_JOINT}{inner}</body>"),)


def _in_air(of: Simulation) -> set[int]:
    """Geoms above every plane."""
    of.begin()
    floor = max(plane_heights(of), default=float("-inf"))
    places = boxes(of, range(of.count("geom"))).items()
    return {geom for geom, (centre, half) in places if centre[2] - half[2] > floor + 1e-3}


def _still(simulation: Simulation) -> float:
    return 0.0 if simulation.count("dof") else 1.0
