"""A slide goes across the beam that it should go along, or through the walls of its cabinet.

The axis is another one than that of the guide: a trolley leaves its beam sideways after some centimetres, a drawer is
pulled through the side of the cabinet.

Bad:

    <mujoco>
      <worldbody>
        <geom name="beam" type="box" size="1.5 0.04 0.05" pos="0 0 2"/>
        <body name="trolley" pos="0 0 1.9">
          <joint type="slide" axis="0 1 0" range="-1.3 1.3"/>
          <geom type="box" size="0.12 0.1 0.04"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <joint type="slide" axis="0 1 0" range="-1.3 1.3"/>
    +       <joint type="slide" axis="1 0 0" range="-1.3 1.3"/>

The number: slides with a range, one on a body, along an axis of the world. The only bar beside the body, five times as
long as it is thick, lies across the slide; at an end of the range the body is out of it by more than its length, and
along the bar it would be on it at both ends. Or it is called a drawer, a tray or a shelf, is inside of a wall of what
carries it at an end of its range, and of the four level directions exactly one other leads out.

When it is wrong: a carriage whose own rail is not drawn.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import product

from clinic.diagnosis.engine import HFIELD, PLANE, SLIDE
from clinic.diagnosis.probes.shape import boxes
from clinic.diagnosis.probes.vector import Vector, norm, times, transpose, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A slide across its guide"
FAMILIES = ("wrong-numbers", "stuck", "drifts")
LEVEL = "hint"
UNPLANTED = "few healthy models have a slide on a bar that is drawn"

Box = tuple[Vector, Vector]  # middle and half sizes along the world's axes
GUIDED = re.compile(r"drawer|tray|shelf", re.IGNORECASE)
ALIGNED, SLENDER = 0.999, 5.0


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each slide that goes across its guide."""
    of, probe = model.simulation, how_many("slides across their guide", _across)
    for joint, (axis, guide) in _across(of).items():
        body = of.body_of("joint", joint)
        value = written([x + 0.0 for x in times(transpose(of.data_row("xmat", body, 9)), axis)])
        now, edits = written(of.row("jnt_axis", joint, 3)), model.set("joint", [joint], "axis", value)
        low, high = of.ranges[joint]
        where = f"is off {of.name('geom', guide)}, which it would stay on" if guide >= 0 else "is in what carries it"
        says = f"In its range of {low:.3g} to {high:.3g} m {of.name('body', body)} {where}."
        names = (of.name("joint", joint), of.name("body", body))
        yield Suspect(names, "axis", now, value, edits, probe, 0, says, "along its guide")


def _across(of: Simulation) -> dict[int, tuple[Vector, int]]:
    """By slide the direction in the world in which its guide lies, and the bar that is the guide; -1 for walls."""
    of.begin()
    made, moving = dict[int, tuple[Vector, int]](), set(of.moving_bodies)
    kinds, names = of.model("geom_type"), of.names("body")
    for joint, ends in of.ranges.items():
        body, axis = of.body_of("joint", joint), of.axis(joint)
        parent, along = of.parent(body), max(range(3), key=lambda i: abs(axis[i]))
        if of.joint_type(joint) != SLIDE or len(of.joints_of(body)) > 1 or abs(axis[along]) < ALIGNED:
            continue
        shifts = [axis[along] * (end - of.position(joint)) for end in ends]
        still = [parent] if parent in moving else [each for each in range(of.count("body")) if each not in moving]
        geoms = [geom for each in still for geom in of.geoms_of(each) if int(kinds[geom]) not in (PLANE, HFIELD)]
        guides, own = boxes(of, geoms), [*boxes(of, of.geoms_of(body)).values()]
        if not own:
            continue
        bar = _bar(guides, own, along, shifts)
        walls = [guides[geom] for geom in of.geoms_of(parent) if geom in guides]
        if bar is not None:
            way = max(range(3), key=lambda i: guides[bar][1][i])
            made[joint] = _axis(way, 1), bar
        guided = parent and GUIDED.search(f"{names[body]} {of.names('joint')[joint]}")
        if bar is None and guided and walls and (free := _out(walls, own, along, shifts)) is not None:
            made[joint] = free, -1
    return made


def _axis(way: int, sign: int) -> Vector:
    return tuple(float(sign) if i == way else 0.0 for i in range(3))


def _gaps(one: Box, other: Box) -> list[float]:
    """How far two boxes are apart along each axis; negative where they are in each other's way."""
    return [abs(a - b) - c - d for a, b, c, d in zip(one[0], other[0], one[1], other[1], strict=True)]


def _moved(one: Box, way: int, by: float) -> Box:
    return tuple(x + by * (i == way) for i, x in enumerate(one[0])), one[1]


def _bar(guides: dict[int, Box], own: Sequence[Box], along: int, shifts: Sequence[float]) -> int | None:
    """The one bar beside a body that lies across its slide, of which the body comes off, and along it would not."""
    beside = []
    for geom, guide in guides.items():
        near = any(norm([max(0.0, gap) for gap in _gaps(each, guide)]) < min(each[1]) for each in own)
        if near and max(guide[1]) > SLENDER * sorted(guide[1])[1]:
            beside.append(geom)
    if len(beside) != 1:
        return None
    guide = guides[beside[0]]
    way = max(range(3), key=lambda i: guide[1][i])
    middle = own[0][0][way] - guide[0][way]
    off = max(min(_gaps(_moved(each, along, by), guide)[along] - 2 * each[1][along] for each in own) for by in shifts)
    stays = all(abs(middle + by) <= guide[1][way] for by in shifts)
    return beside[0] if way != along and off > 0 and stays else None


def _out(walls: Sequence[Box], own: Sequence[Box], along: int, shifts: Sequence[float]) -> Vector | None:
    """The one level direction in which a range keeps a body out of the walls, where its own does not."""
    start, far, free = _inside(walls, own), max(map(abs, shifts)), []
    for way, sign in product((0, 1), (1, -1)):
        if _inside(walls, [_moved(each, way, sign * far) for each in own]) <= start:
            free.append((way, sign))
    return _axis(*free[0]) if len(free) == 1 and free[0][0] != along else None


def _inside(walls: Sequence[Box], own: Sequence[Box]) -> int:
    return sum(max(_gaps(wall, each)) < 0 for wall in walls for each in own)
