"""A keyframe puts the robot into the air, from where it falls.

The height of another robot's pose, or of one in millimetres, while the model itself starts on the floor.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="2 2 0.1"/>
        <body name="robot" pos="0 0 0.1">
          <freejoint/>
          <geom type="box" size="0.2 0.1 0.1" mass="5"/>
        </body>
      </worldbody>
      <keyframe>
        <key name="home" qpos="0 0 100 1 0 0 0"/>
      </keyframe>
    </mujoco>

Good:

    -     <key name="home" qpos="0 0 100 1 0 0 0"/>
    +     <key name="home" qpos="0 0 0.1 1 0 0 0"/>

The number: how far the lowest geom of the one free robot is above the plane, or what stands there, at the keyframe, in
sizes of the robot; told from 1 on, where it starts at less than a quarter without the keyframe, and from 0.05 on where
servos move its legs and it starts on the floor.

When it is wrong: a drop or a flight, if its name does not say so.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.engine import HFIELD, PLANE, TRN_SITE
from clinic.diagnosis.probes.key import reordered, start_at
from clinic.diagnosis.probes.shape import boxes, plane_heights, root_of, solid
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A keyframe is in the air"
FAMILIES = ("jumps-at-start", "falls-through")
UNPLANTED = "from where a robot should fall, only intent knows"

HIGH, LOW = 1.0, 0.25  # sizes of the robot
DROP, ON_FLOOR, LEAST = 0.05, 0.01, 4  # the same of one that stands; its driven joints
NEAR = 0.02  # m that a foot may be in the floor
MEANT = re.compile(
    r"jump|air|fly|flight|drop|fall|hover|high|above|take|throw|toss|launch|land|hang|flip", re.IGNORECASE
)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Keyframes of one free robot that begin far above the planes."""
    of = model.simulation
    flies = any(int(kind) == TRN_SITE for kind in of.model("actuator_trntype")) or of.model("opt.gravity")[2] >= 0
    if len(of.free_bodies) != 1 or flies or (not of.count("key") or _gap(of, -1) > LOW):
        return
    root, begin = root_of(of), of.free_bodies[0]
    legs = sum(root[of.body_of("joint", joint)] == begin for joint in of.drivers)
    most = DROP if legs >= LEAST and _gap(of, -1) < ON_FLOOR else HIGH
    height = of.place(of.joints_of(begin)[0]) + 2
    for key, name in enumerate(of.names("key")):
        gap, element = _gap(of, key), model.element("key", key)
        if gap <= most or element is None or MEANT.search(name) or reordered(model, key):
            continue
        start_at(of, key)
        qpos = list(of.data("qpos"))
        now, lower = qpos[height], gap * _size(of)
        qpos[height] = now - lower
        probe = Probe("height above the floor at the keyframe", "sizes of the robot", _gap, (key,), dynamic=False)
        says = f"At the keyframe {of.name('body', begin)} begins {lower:.3g} m above the floor, and falls."
        edits = (set_attribute(element, "qpos", written(qpos)),)
        told, value = (of.name("key", key),), f"height {qpos[height]:.4g}"
        yield Suspect(told, "qpos", f"height {now:.4g}", value, edits, probe, most, says, "on the floor")


def _gap(of: Simulation, key: int) -> float:
    """How high the lowest moving geom is above what is below it and does not move, in sizes; 0 without a plane."""
    start_at(of, key)
    low = min((low for low, _ in _ends(of).values()), default=0.0)
    below = [height for height in (*plane_heights(of), *_tops(of)) if height <= low + NEAR]
    if not below or HFIELD in map(int, of.model("geom_type")):
        return 0.0
    return (low - max(below)) / max(_size(of), 1e-9)


def _tops(of: Simulation) -> list[float]:
    """How high the tops of the geoms are that do not move and are below or above the middle of the free body."""
    kinds, moving, middle = of.model("geom_type"), set(of.moving_bodies), of.data_row("xpos", of.free_bodies[0], 3)
    still = [geom for geom, body in enumerate(of.model("geom_bodyid")) if int(body) not in moving and solid(of, geom)]
    found = boxes(of, [geom for geom in still if int(kinds[geom]) not in (PLANE, HFIELD)]).values()
    return [place[2] + half[2] for place, half in found if all(abs(middle[i] - place[i]) <= half[i] for i in (0, 1))]


def _size(of: Simulation) -> float:
    """How tall the moving geoms together are, at least as much as the largest of them."""
    if not (ends := _ends(of)):
        return 0.0
    tall = max(high for _, high in ends.values()) - min(low for low, _ in ends.values())
    return max(tall, *(of.model("geom_rbound")[geom] for geom in ends))


def _ends(of: Simulation) -> dict[int, tuple[float, float]]:
    """How high the lowest and the highest point of the box around each moving geom are, in m."""
    moving = set(of.moving_bodies)
    found = boxes(of, [geom for geom, body in enumerate(of.model("geom_bodyid")) if int(body) in moving])
    return {geom: (place[2] - half[2], place[2] + half[2]) for geom, (place, half) in found.items()}
