"""The quaternion of a keyframe has w last.

MuJoCo writes quaternions as w x y z. `0 0 0 1`, no rotation where w stands last, is half a turn about z.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="2 2 0.1"/>
        <body name="robot" pos="0 0 0.2">
          <freejoint/>
          <geom type="box" size="0.2 0.1 0.1" mass="4"/>
        </body>
      </worldbody>
      <keyframe>
        <key name="home" qpos="0 0 0.1 0 0 0 1"/>
      </keyframe>
    </mujoco>

Good:

    -     <key name="home" qpos="0 0 0.1 0 0 0 1"/>
    +     <key name="home" qpos="0 0 0.1 1 0 0 0"/>

The number: the angle between the free body at the keyframe and at the model's start. Told for `0 0 0 1` and a half turn
near it, and where the body is tilted by more than 60 degrees and would be by less than 15 with the last number as w. Of
a thing that is the same after half a turn, such as a box, it is a hint.

When it is wrong: a robot that is meant to look back.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.engine import MESH
from clinic.diagnosis.probes.key import reordered, start_at
from clinic.diagnosis.probes.vector import dot, of_quaternion, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A keyframe's quaternion has w last"
FAMILIES = ("drifts", "jumps-at-start")

LIMIT, TILTED, UPRIGHT = 60.0, 60.0, 15.0  # degrees


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Free bodies that a keyframe turns over, or by half a turn about z."""
    of = model.simulation
    for key in range(of.count("key")):
        if reordered(model, key):
            continue
        element = model.element("key", key)
        start_at(of, key)
        qpos = list(of.data("qpos"))
        for body in of.free_bodies:
            at = of.place(of.joints_of(body)[0]) + 3
            w, x, y, z = qpos[at : at + 4]
            start = of.model("qpos0")[at : at + 4]
            tilted = _tilt((w, x, y, z), start) > TILTED and _tilt((z, w, x, y), start) < UPRIGHT
            if element is None or not (tilted or (_back((w, x, y, z)) and abs(start[0]) > 0.9)):
                continue
            changed = [*qpos[:at], z, w, x, y, *qpos[at + 4 :]]
            yield Suspect(
                (of.name("key", key), of.name("body", body)),
                "qpos",
                written((w, x, y, z)),
                written((z, w, x, y)),
                (set_attribute(element, "qpos", written(changed)),),
                Probe("angle between keyframe and start", "degrees", _angle, (key, at), dynamic=False),
                LIMIT,
                "Read as w x y z it turns the body by half a turn, or over; read as x y z w it does neither.",
                "w first: 1 0 0 0 is no rotation",
                level="hint" if _tilt((w, x, y, z), start) < 1 and _round(of, body) else "cause",
            )


def _back(turn: Sequence[float]) -> bool:
    """Whether it is half a turn about z or near it, as a small turn about z is with w last."""
    w, x, _, z = turn
    return z > 0.995 or (z > 0.5 and abs(w) < 1e-6 and abs(x) < 1e-6)


def _round(of: Simulation, body: int) -> bool:
    """Whether a body is the same after half a turn about its z axis: its geoms are on it, and no mesh."""
    geoms = of.geoms_of(body)
    turns = (of_quaternion(of.row("geom_quat", geom, 4)) for geom in geoms)
    level = all(max(map(abs, turn[6:])) > 1 - 1e-4 for turn in turns)
    middle = all(math.hypot(*of.row("geom_pos", geom, 3)[:2]) < 1e-6 for geom in geoms)
    return level and middle and not of.children.get(body) and all(of.model("geom_type")[geom] < MESH for geom in geoms)


def _tilt(now: Sequence[float], start: Sequence[float]) -> float:
    """The angle between the z axes of two orientations in degrees."""
    cosine = dot(of_quaternion(now)[2::3], of_quaternion(start)[2::3])
    return math.degrees(math.acos(max(-1.0, min(1.0, cosine))))


def _angle(simulation: Simulation, key: int, at: int) -> float:
    start_at(simulation, key)
    now, start = simulation.data("qpos")[at : at + 4], simulation.model("qpos0")[at : at + 4]
    turned = math.degrees(2 * math.acos(min(1.0, abs(dot(now, start)))))
    return max(_tilt(now, start), turned if _back(now) else 0.0)
