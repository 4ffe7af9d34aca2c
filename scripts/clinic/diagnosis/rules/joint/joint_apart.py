"""A joint's axis lies far away from one of the two links that it holds together.

`pos` of a joint is in the frame of the body that it moves: 0 is the place where the body hangs on its parent. With the
place in the world, or that of the link's far end, the link swings about a point in the air.

Bad:

    <mujoco>
      <worldbody>
        <body name="upper" pos="0 0 1">
          <joint name="shoulder" axis="0 1 0"/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.03"/>
          <body name="lower" pos="0 0 -0.3">
            <joint name="elbow" pos="0 0 -0.3" axis="0 1 0"/>
            <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.03"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -         <joint name="elbow" pos="0 0 -0.3" axis="0 1 0"/>
    +         <joint name="elbow" axis="0 1 0"/>

The number: how far the axis of a hinge with a `pos` passes the boxes around the geoms of its body, or of the body above
it, in sizes of the body's largest geom; more than 0.28 of one hinge, more than 0.5 of several. Of 261 such hinges in 34
healthy models 4 have more than 0.2, and a dog's two shoulder blades 0.33. Where more than two joints and a fifth of all
have it, nothing is said, nor of bodies of the world, unless the joint has the very `pos` of its body, nor of a body of
spheres that is away from its own axis: a bob.

When it is wrong: a link of which a part is not drawn.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.engine import HFIELD, HINGE, PLANE, SLIDE, SPHERE
from clinic.diagnosis.probes.vector import Vector, add, at, dot, sub
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A joint away from its links"
FAMILIES = ("drifts", "stuck", "sags", "wrong-numbers")
UNPLANTED = "in a healthy model a joint that is moved by little is planted as that of a pair"

FAR, BOTH, FEW, SHARE, STEPS, LARGE, MANY = 0.28, 0.5, 2, 0.2, 5, 200, 10


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The hinges that are away from a link, where they are few."""
    of = model.simulation
    found = _gaps(of)
    away = [joint for joint, gaps in found.items() if max(gaps) > FAR]
    least = FAR if len(away) == 1 else BOTH
    away = [joint for joint in away if max(found[joint]) > least]
    if not away or len(away) > max(FEW, SHARE * of.count("joint")):
        return
    worst = max(away, key=lambda joint: max(found[joint]))
    body = of.body_of("joint", worst)
    gaps, link = found[worst], of.name("body", body)
    if gaps[1] > gaps[0]:
        link = of.name("body", of.parent(body))
    edits = tuple(edit for joint in away for edit in model.set("joint", [joint], "pos", "0 0 0"))
    now = " ".join(f"{x:.4g}" for x in of.row("jnt_pos", worst, 3))
    says = f"Its axis passes {link} at {max(gaps):.3g} sizes of {of.name('body', body)}."
    probe = Probe("distance of a joint's axis from its links", "sizes of the body", _farthest, dynamic=False)
    names = tuple(of.name("joint", joint) for joint in away)
    yield Suspect(names, "pos", now, "0 0 0", edits, probe, FAR, says, "below 0.2", level="hint")


def _farthest(of: Simulation) -> float:
    return max((max(gaps) for gaps in _gaps(of).values()), default=0.0)


def _gaps(of: Simulation) -> dict[int, tuple[float, float]]:
    """By hinge: how far its axis is from its own link and from the one above, in sizes of its own."""
    if of.count("joint") > LARGE:
        return {}
    of.as_written()
    welds, kinds = of.model("body_weldid"), of.model("geom_type")
    links: dict[int, list[int]] = {}
    for geom, body in enumerate(of.model("geom_bodyid")):
        if int(kinds[geom]) not in (PLANE, HFIELD):
            links.setdefault(int(welds[int(body)]), []).append(geom)
    made = {}
    places, turns = tuple(of.data("geom_xpos")), tuple(of.data("geom_xmat"))
    for joint in range(of.count("joint")):
        body = of.body_of("joint", joint)
        own, above = links.get(int(welds[body]), []), links.get(int(welds[of.parent(body)]), [])
        size = 2 * max((of.model("geom_rbound")[geom] for geom in own), default=0.0)
        planar = any(of.joint_type(other) == SLIDE for other in of.joints_of(body))
        in_world = not of.parent(body) and not _as_in_world(of, joint)
        moved = any(of.row("jnt_pos", joint, 3))
        if of.joint_type(joint) == HINGE and size > 0 and moved and not planar and not in_world:
            axis = of.data_row("xanchor", joint, 3), of.axis(joint)
            boxes = [[(of.row("geom_aabb", geom, 6), at(places, geom), turns[9 * geom : 9 * geom + 9]) for geom in some]
                     for some in (own, above if of.parent(body) else [])]  # fmt: skip
            bob = all(int(kinds[geom]) == SPHERE for geom in own)  # on a rod that is not drawn
            made[joint] = (0.0 if bob else _gap(axis, boxes[0], size), _gap(axis, boxes[1], size))
    return made


def _as_in_world(of: Simulation, joint: int) -> bool:
    """Whether a joint's place in its body is that of the body in the world, written again."""
    pos, body = of.row("jnt_pos", joint, 3), of.row("body_pos", of.body_of("joint", joint), 3)
    return any(pos) and all(abs(a - b) < 1e-6 for a, b in zip(pos, body, strict=True))


def _gap(line: tuple[Vector, Vector], boxes: list[tuple[Vector, Vector, Vector]], size: float) -> float:
    """The distance of an axis, a point and a direction, from the nearest of some boxes, in sizes; 0 without boxes."""
    anchor, axis = line
    steps = [size * step / STEPS for step in range(-STEPS, STEPS + 1)]
    beside = {dot(sub(place, anchor), axis) for _, place, _ in boxes}
    points = [add(anchor, axis, way) for way in (*steps, *(way for way in beside if abs(way) < size))]
    near = boxes if len(boxes) <= MANY else [box for box in boxes if math.dist(box[1], anchor) < 2 * size]
    return min((_distance(box, point) for box in near for point in points[: 2 * STEPS + 1 + MANY]), default=0.0) / size


def _distance(around: tuple[Vector, Vector, Vector], point: Vector) -> float:
    """How far a point is from the box around a geom, which is given by its sides, its place and its turn."""
    box, place, turn = around
    off = sub(point, place)
    inside = [sum(turn[3 * row + column] * off[row] for row in range(3)) for column in range(3)]
    return math.hypot(*(max(0.0, abs(inside[i] - box[i]) - box[3 + i]) for i in range(3)))
