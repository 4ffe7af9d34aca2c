"""A fin turns in its own plane, and pushes little.

A plate moves water when it turns about a line in its plane. About its normal it cuts through the water: an axis that
was copied from another joint, or two numbers of a size that were exchanged. The tail below, turned to and fro by 0.6
rad at 1.5 Hz, then pushes with a ninth of the force that it has about z.

Bad:

    <mujoco>
      <option density="1000" viscosity="0.0009" gravity="0 0 0"/>
      <worldbody>
        <body name="fish">
          <freejoint/>
          <geom type="ellipsoid" size="0.08 0.03 0.04" fluidshape="ellipsoid"/>
          <body name="tail" pos="-0.08 0 0">
            <joint name="tail" axis="0 1 0" range="-40 40" damping="0.001" armature="0.00001"/>
            <geom type="ellipsoid" size="0.04 0.003 0.05" pos="-0.04 0 0" fluidshape="ellipsoid"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -         <joint name="tail" axis="0 1 0" range="-40 40" damping="0.001" armature="0.00001"/>
    +         <joint name="tail" axis="0 0 1" range="-40 40" damping="0.001" armature="0.00001"/>

The number: bodies whose only joint is a hinge with a range, and whose geoms with a `fluidshape` all are at most a fifth
as thick along its axis as in any other direction. The geom's size is the one to mend where the body before turns about
the same line, else the axis.

When it is wrong: a disc that is to turn on the spot.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.probes.shape import FLUID
from clinic.diagnosis.probes.vector import Vector, cross, dot, of_quaternion, sub, times, transpose, unit, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A fin that turns in its own plane"
FAMILIES = ("stuck", "drifts")
UNPLANTED = "few healthy models swim"

THIN, ALONG = 0.2, 0.95  # of the next thicker; cosine


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each fin, with the size of its geom or the axis of its joint."""
    of = model.simulation
    for joint in _fins(of):
        body, axis = of.body_of("joint", joint), of.row("jnt_axis", joint, 3)
        geom = _wet(of, body)[0]
        across = _across(of, joint, geom)
        names = [of.name("joint", joint), of.name("geom", geom)]
        attribute, now, value = "axis", written(axis), written(across) if any(across) else ""
        edits = model.set("joint", [joint], "axis", value) if value else ()
        if _as_before(of, joint):
            size, turn = list(of.row("geom_size", geom, 3)), of_quaternion(of.row("geom_quat", geom, 4))
            thin, wide = (_own(turn, each) for each in (axis, across))
            size[thin], size[wide] = size[wide], size[thin]
            names.reverse()
            attribute, now, value = "size", written(of.row("geom_size", geom, 3)), written(size)
            edits = model.set("geom", [geom], "size", value)
        says = f"{names[0] if attribute == 'size' else of.name('geom', geom)} is flat along the axis of its hinge."
        probe = how_many("fins that turn in their own plane", _fins)
        yield Suspect(tuple(names), attribute, now, value, edits, probe, 0, says, "an axis in its plane")


def _fins(of: Simulation) -> list[int]:
    """The hinges with a range that alone move bodies whose wet geoms all are flat along their axes."""
    hinges = [joint for joint in of.ranges if of.joint_type(joint) == HINGE]
    alone = [joint for joint in hinges if of.joints_of(of.body_of("joint", joint)) == [joint]]
    return [joint for joint in alone if of.in_fluid and _flat(of, joint)]


def _wet(of: Simulation, body: int) -> list[int]:
    """The geoms of a body that are shaped for a medium."""
    return [geom for geom in of.geoms_of(body) if of.model("geom_fluid")[FLUID * geom]]


def _flat(of: Simulation, joint: int) -> bool:
    axis, geoms = of.row("jnt_axis", joint, 3), _wet(of, of.body_of("joint", joint))
    for geom in geoms:
        turn, half = of_quaternion(of.row("geom_quat", geom, 4)), of.row("geom_aabb", geom, 6)[3:]
        thin = _own(turn, axis)
        along = abs(dot(axis, turn[thin::3])) > ALONG
        if not along or half[thin] > THIN * min(each for i, each in enumerate(half) if i != thin):
            return False
    return bool(geoms)


def _own(turn: Vector, axis: Vector) -> int:
    """The axis of a turned geom that is nearest to another one."""
    seen = [abs(x) for x in times(transpose(turn), axis)]
    return seen.index(max(seen))


def _across(of: Simulation, joint: int, geom: int) -> Vector:
    """The direction in a fin's plane across the way from its hinge to its middle; zeros where there is no way."""
    way = unit(sub(of.row("geom_pos", geom, 3), of.row("jnt_pos", joint, 3)))
    found = unit(cross(of.row("jnt_axis", joint, 3), way))
    return tuple(round(abs(x) if max(found, key=abs) == x else x, 6) + 0.0 for x in found)


def _as_before(of: Simulation, joint: int) -> bool:
    """Whether the body that a fin hangs on turns about the same axis."""
    of.as_written()
    axis, above = of.axis(joint), of.parent(of.body_of("joint", joint))
    others = [each for each in of.joints_of(above) if of.joint_type(each) == HINGE]
    return any(abs(dot(axis, of.axis(each))) > ALONG for each in others)
