"""A door turns about its middle, or in its own plane.

A door's hinge is at one of its edges and lies along it. Where the panel is centred on the body's origin, so is the
hinge; and an axis across the panel turns it as a hand of a clock.

Bad:

    <mujoco>
      <worldbody>
        <geom type="box" size="0.02 0.02 0.5" pos="0 0.02 0.5"/>
        <body name="door" pos="0 -0.4 0.5">
          <joint axis="0 0 1" range="0 100" damping="1"/>
          <geom type="box" size="0.02 0.38 0.45" mass="8"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <joint axis="0 0 1" range="0 100" damping="1"/>
    +       <joint axis="0 0 1" range="0 100" damping="1" pos="0 0.38 0"/>

The number: how far the hinge is from the middle of the door's geoms, in half widths of them; less than 0.3 is told, and
0 stands for an axis across the panel, which is the largest geom; a hatch or a lid may turn so. Looked at are bodies
with one hinge that are called a door, gate, hatch, flap or lid, where the panel is flat.

When it is wrong: a revolving door, or a flap that turns about its middle, as in a valve.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.engine import BOX, HINGE, MESH
from clinic.diagnosis.probes.vector import Vector, add, cross, dot, times
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A door that does not turn on its edge"
FAMILIES = ("stuck", "drifts", "wrong-numbers")
UNPLANTED = "few healthy models have doors"

DOOR = re.compile(r"door|(?<![a-z])(gate|hatch|flap|lid)(?![a-z])", re.IGNORECASE)
PART = re.compile(
    r"handle|knob|lock|latch|bolt|frame|hinge|button|revolv|rotary|rotating|indoor|outdoor", re.IGNORECASE
)
SCREWED = re.compile(r"(?<![a-z])(hatch|lid)(?![a-z])", re.IGNORECASE)
FLAT, EDGE, ACROSS = 0.35, 0.3, 0.9


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Doors whose hinge is in their middle or across them, each."""
    of = model.simulation
    for body, name in enumerate(of.names("body")):
        joints = of.joints_of(body)
        if len(joints) != 1 or of.joint_type(joints[0]) != HINGE or not DOOR.search(name) or PART.search(name):
            continue
        (joint,) = joints
        across = _across(of, joint)
        if across is None or (across and SCREWED.search(name)) or _off(of, joint) >= EDGE:
            continue
        says = (
            "Its axis lies across the panel, which turns in its own plane." if across else "It turns about its middle."
        )
        attribute = "axis" if across else "pos"
        now = " ".join(f"{x:g}" for x in of.row(f"jnt_{attribute}", joint, 3))
        probe = Probe("hinge from the middle of the panel, less than", "", _missing, (joint,), dynamic=False)
        told = (of.name("body", body), of.name("joint", joint))
        yield Suspect(told, attribute, now, "", (), probe, 1 - EDGE, says, "a hinge along an edge")


def _panel(of: Simulation, joint: int) -> tuple[int, list[int]] | None:
    """The largest geom of a door and its axes, the shortest first; None where it is not flat."""
    body, kinds = of.body_of("joint", joint), of.model("geom_type")
    geoms = [geom for geom in of.geoms_of(body) if int(kinds[geom]) in (BOX, MESH)]
    if not geoms:
        return None
    geom = max(geoms, key=lambda each: of.model("geom_rbound")[each])
    half = of.row("geom_aabb", geom, 6)[3:]
    order = sorted(range(3), key=lambda axis: half[axis])
    return (geom, order) if half[order[0]] < FLAT * half[order[1]] else None


def _across(of: Simulation, joint: int) -> bool | None:
    """Whether the hinge lies across the panel; None for a door that is not flat."""
    of.begin()
    panel = _panel(of, joint)
    if panel is None:
        return None
    return abs(dot(_column(of, panel[0], panel[1][0]), of.axis(joint))) > ACROSS


def _off(of: Simulation, joint: int) -> float:
    """How far the hinge is from the middle of the panel in half widths; 0 where it lies across it."""
    panel = _panel(of, joint)
    if panel is None or _across(of, joint):
        return 0.0 if panel is not None else 1.0
    side = cross(_column(of, panel[0], panel[1][0]), of.axis(joint))
    ends = []
    for geom in of.geoms_of(of.body_of("joint", joint)):
        box = of.row("geom_aabb", geom, 6)
        middle = add(of.data_row("geom_xpos", geom, 3), times(of.data_row("geom_xmat", geom, 9), box[:3]))
        aside = dot(add(middle, of.data_row("xanchor", joint, 3), -1), side)
        width = sum(box[3 + axis] * abs(dot(_column(of, geom, axis), side)) for axis in range(3))
        ends += [aside - width, aside + width]
    far, near = max(ends), min(ends)
    return abs(far + near) / (far - near) if far > near else 1.0


def _column(of: Simulation, geom: int, axis: int) -> Vector:
    return of.data_row("geom_xmat", geom, 9)[axis::3]


def _missing(of: Simulation, joint: int) -> float:
    of.begin()
    return 1 - min(1.0, _off(of, joint))
