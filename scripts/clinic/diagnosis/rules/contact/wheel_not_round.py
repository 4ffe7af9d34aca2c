"""A wheel is not round about its hinge: its shape lies across the axis or beside it, or is a box or a bumpy mesh.

A cylinder's axis is its own z, whatever the hinge's is. A wheel whose cylinder stands across its hinge bumps along, or
does not turn at all; so does a box. A round shape fitted to a mesh whose middle is not the hinge hops at every turn.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="5 5 0.1"/>
        <body name="cart" pos="0 0 0.1">
          <freejoint/>
          <geom type="box" size="0.2 0.1 0.02" mass="2"/>
          <body name="wheel" pos="0 0.15 0">
            <joint name="axle" axis="0 1 0"/>
            <geom type="cylinder" size="0.1 0.02" mass="0.3"/>
          </body>
          <body name="other" pos="0 -0.15 0">
            <joint name="other" axis="0 1 0"/>
            <geom type="cylinder" size="0.1 0.02" mass="0.3" zaxis="0 1 0"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -         <geom type="cylinder" size="0.1 0.02" mass="0.3"/>
    +         <geom type="cylinder" size="0.1 0.02" mass="0.3" zaxis="0 1 0"/>

The number: how much the wheel's radius varies over a turn about its hinge, as a share of its mean; above 10 % is told.
A wheel is the last body of a mechanism on a hinge without limits, whose one colliding cylinder, box or mesh is centred
on the hinge; a box, a ball and an ellipsoid only where they are called so. A cylinder is turned, or the hinge, where it
stands upright, or the cylinder lies along the line to the wheel on the other side; for another shape there is only a
hint.

When it is wrong: a cam, a propeller, a stirrer.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import takewhile

from clinic.diagnosis.edit import Edit, remove_attribute, set_attribute
from clinic.diagnosis.engine import BOX, CYLINDER, ELLIPSOID, MESH, SPHERE
from clinic.diagnosis.probes.shape import points, solid
from clinic.diagnosis.probes.sides import sided
from clinic.diagnosis.probes.vector import (
    Vector,
    across,
    add,
    around,
    dot,
    norm,
    of_quaternion,
    sub,
    times,
    unit,
    written,
)
from clinic.diagnosis.probes.wheels import is_wheel
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.source import ORIENTATIONS
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A wheel that is not round"
FAMILIES = ("stuck", "drifts", "oscillates", "sinks")
UNPLANTED = "no healthy model stands on a wheel that is a single cylinder or box"

VARIES, CENTRED = 0.1, 0.2
ALONG = 0.95  # cosine of the angle between a cylinder and the way to the other side
ANGLES = 24


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Cylinders and boxes on free-turning hinges that are not round about them."""
    of = model.simulation
    for joint, geom in _wheels(of):
        varies = _varies(of, joint, geom)
        if not varies > VARIES or not math.isfinite(varies):
            continue
        kind = int(of.model("geom_type")[geom])
        edits = _edits(model, joint, geom) if kind == CYLINDER else ()
        if kind == CYLINDER and (
            not _level(of, joint) or _along_axle(of, joint, geom)
        ):  # the hinge is what stands across
            axle = written(tuple(of_quaternion(of.row("geom_quat", geom, 4))[2::3]))
            edits = model.set("joint", [joint], "axis", axle)
        what = {CYLINDER: "cylinder lies across the hinge", BOX: "shape is a box", MESH: "mesh is not round"}
        what |= dict.fromkeys((SPHERE, ELLIPSOID), "middle is beside the hinge, or it is not round")
        yield Suspect(
            (of.name("geom", geom), of.name("joint", joint)),
            edits[-1].attribute if edits else "zaxis",
            "",
            edits[-1].value if edits else "",
            edits,
            Probe(
                "radius over a turn about the hinge, varies by", "of its mean", _varies, (joint, geom), dynamic=False
            ),
            VARIES,
            f"Its {what[kind]}: over a turn its radius varies by {100 * varies:.0f} %.",
            "the cylinder's z along the hinge",
        )


def _wheels(simulation: Simulation) -> Iterator[tuple[int, int]]:
    for joint in range(simulation.count("joint")):
        body = simulation.body_of("joint", joint)
        if not simulation.continuous(joint) or body in simulation.children:
            continue
        geoms = [geom for geom in simulation.geoms_of(body) if solid(simulation, geom)]
        kinds = [int(simulation.model("geom_type")[geom]) for geom in geoms]
        called = is_wheel(f"{simulation.name('body', body)} {simulation.name('joint', joint)}")
        shapes = (CYLINDER, BOX, MESH, SPHERE, ELLIPSOID) if called else (CYLINDER, MESH)
        single = called or len(simulation.joints_of(body)) == 1  # a wheel that steers has two
        if single and len(geoms) == 1 and kinds[0] in shapes:
            off = sub(simulation.row("geom_pos", geoms[0], 3), simulation.row("jnt_pos", joint, 3))
            axis = simulation.row("jnt_axis", joint, 3)
            aside = norm(across(off, axis))
            level = _level(simulation, joint) or (kinds[0] == CYLINDER and _lies(simulation, geoms[0]))
            if aside < CENTRED * simulation.model("geom_rbound")[geoms[0]] and level:
                yield joint, geoms[0]


def _level(simulation: Simulation, joint: int) -> bool:
    """Whether the hinge lies level at the start."""
    simulation.begin()
    return abs(simulation.axis(joint)[2]) < 0.3


def _lies(simulation: Simulation, geom: int) -> bool:
    """Whether a cylinder lies on its round side at the start."""
    return abs(simulation.data_row("geom_xmat", geom, 9)[8]) < 0.3


def _along_axle(of: Simulation, joint: int, geom: int) -> bool:
    """Whether a cylinder lies along the line to the wheel on the other side, by its hinge's name."""
    _, twin = sided(of, "joint").get(joint, ("", -1))
    if twin < 0 or not _lies(of, geom):
        return False
    way = unit(sub(of.data_row("xanchor", twin, 3), of.data_row("xanchor", joint, 3)))
    return abs(dot(way, of.data_row("geom_xmat", geom, 9)[2::3])) > ALONG


def _varies(simulation: Simulation, joint: int, geom: int) -> float:
    axis = simulation.row("jnt_axis", joint, 3)
    frame = of_quaternion(simulation.row("geom_quat", geom, 4))
    anchor = simulation.row("jnt_pos", joint, 3)
    place = sub(simulation.row("geom_pos", geom, 3), anchor)
    points = [add(place, times(frame, point)) for point in _points(simulation, geom)]
    radii = [max(dot(point, way) for point in points) for way in around(axis, ANGLES)]
    return (max(radii) - min(radii)) * len(radii) / sum(radii)


def _points(simulation: Simulation, geom: int) -> list[Vector]:
    a, b, c = simulation.row("geom_size", geom, 3)
    if int(simulation.model("geom_type")[geom]) in (BOX, MESH):
        return points(simulation, geom)
    rim = around((0.0, 0.0, 1.0), 2 * ANGLES)
    if int(simulation.model("geom_type")[geom]) == CYLINDER:
        return [(a * x, a * y, z) for x, y, _ in rim for z in (-b, b)]
    if int(simulation.model("geom_type")[geom]) == SPHERE:
        b = c = a
    turns = [math.pi * i / ANGLES for i in range(-ANGLES // 2, ANGLES // 2 + 1)]
    return [(a * x * math.cos(up), b * y * math.cos(up), c * math.sin(up)) for x, y, _ in rim for up in turns]


def _edits(model: ReaderModel, joint: int, geom: int) -> tuple[Edit, ...]:
    element = model.element("geom", geom)
    if element is None or model.value("geom", geom, "fromto") or model.source is None or model.urdf:
        return ()
    if any(name not in element.attributes and model.value("geom", geom, name) for name in ORIENTATIONS):
        return ()
    if any(each.tag in ("frame", "replicate") for each in takewhile(lambda each: each.tag != "body", element.around())):
        return ()  # a frame, which may be turned
    gone = [remove_attribute(element, name) for name in ORIENTATIONS if name in element.attributes and name != "zaxis"]
    axis = model.simulation.row("jnt_axis", joint, 3)
    return (*gone, set_attribute(element, "zaxis", written(axis)))
