"""Two sliding parts stand in one place.

A gripper whose second finger is a copy of the first with the same `pos` (in a URDF: the same `origin`): closed,
both fingers are one inside of the other.

Bad:

    <mujoco>
      <worldbody>
        <body name="palm" pos="0 0 0.5">
          <geom type="box" size="0.05 0.05 0.02"/>
          <body name="left_finger" pos="0 0 0.05">
            <joint name="left" type="slide" axis="0 1 0" range="0 0.04"/>
            <geom type="box" size="0.01 0.005 0.03"/>
          </body>
          <body name="right_finger" pos="0 0 0.05">
            <joint name="right" type="slide" axis="0 -1 0" range="0 0.04"/>
            <geom type="box" size="0.01 0.005 0.03"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <body name="palm" pos="0 0 0.5">
          <geom type="box" size="0.05 0.05 0.02"/>
          <body name="left_finger" pos="0 0.005 0.05">
            <joint name="left" type="slide" axis="0 1 0" range="0 0.04"/>
            <geom type="box" size="0.01 0.005 0.03"/>
          </body>
          <body name="right_finger" pos="0 -0.005 0.05">
            <joint name="right" type="slide" axis="0 -1 0" range="0 0.04"/>
            <geom type="box" size="0.01 0.005 0.03"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

The number: groups of bodies of one parent that slide opposite ways and begin in the same place with the same geoms. Of
289 healthy models none has one.

When it is wrong: parts that are meant to start in one place, and never to touch.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import SLIDE
from clinic.diagnosis.probes.shape import solid
from clinic.diagnosis.probes.vector import at, dot
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Two fingers in one place"
FAMILIES = ("jumps-at-start", "stuck", "slips")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "fingers of healthy models that are put in one place are told as overlapping"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each pair of sliding twins in one place."""
    of = model.simulation
    for bodies in _together(of):
        names = tuple(of.name("body", body) for body in bodies)
        says = f"{names[0]} and {names[1]} begin in the same place, and have the same shape."
        now = " ".join(f"{x:.4g}" for x in of.row("body_pos", bodies[0], 3))
        probe = Probe("groups of parts in one place", "", _count, dynamic=False)
        yield Suspect(names, "pos", now, "apart from each other", (), probe, 0.1, says, "none")


def _count(of: Simulation) -> float:
    return float(len(_together(of)))


def _together(of: Simulation) -> list[list[int]]:
    """Bodies that slide opposite ways, and stand in one place at the start with the same geoms, one of them solid."""
    of.begin()
    places, turns = tuple(of.data("xpos")), tuple(of.data("xmat"))
    axes = tuple(of.data("xaxis"))
    groups: dict[tuple[float, ...], list[int]] = {}
    for body in range(1, of.count("body")):
        geoms, joints = of.geoms_of(body), of.joints_of(body)
        slides = [of.joint_type(joint) for joint in joints] == [SLIDE]
        if slides and any(solid(of, geom) for geom in geoms):
            key = [of.model("body_parentid")[body]]
            key += [round(x, 5) for x in (*at(places, body), *turns[9 * body : 9 * body + 9])]
            for geom in geoms:
                key += [of.model("geom_type")[geom], of.model("geom_dataid")[geom], *_row(of, "geom_size", geom, 3)]
                key += [*_row(of, "geom_pos", geom, 3), *_row(of, "geom_quat", geom, 4)]
            groups.setdefault(tuple(key), []).append(body)
    pairs = [bodies for bodies in groups.values() if len(bodies) > 1]
    ways = [[at(axes, of.joints_of(body)[0]) for body in bodies] for bodies in pairs]
    return [bodies for bodies, way in zip(pairs, ways, strict=True) if any(dot(way[0], each) < 0 for each in way)]


def _row(of: Simulation, field: str, index: int, width: int) -> tuple[float, ...]:
    return tuple(round(x, 6) for x in of.row(field, index, width))
