"""A keyframe is written in another order than the model's joints.

The numbers of `qpos` belong to the joints in the order in which they stand in the model; a free joint takes seven, its
place and its quaternion. Where an object was put before the robot, or the keyframe comes from a program that writes
the free joint last, every number goes to another joint, and the model compiles without a word.

Bad:

    <mujoco>
      <worldbody>
        <body name="box" pos="1 0 0.5">
          <freejoint/>
          <geom size="0.1"/>
        </body>
        <body name="upper" pos="0 0 1">
          <joint axis="0 1 0" range="-90 90"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
          <body name="lower" pos="0.3 0 0">
            <joint axis="0 1 0" range="-90 90"/>
            <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
          </body>
        </body>
      </worldbody>
      <keyframe>
        <key name="home" qpos="0.8 -0.4 1 0 0.5 1 0 0 0"/>
      </keyframe>
    </mujoco>

Good:

    -     <key name="home" qpos="0.8 -0.4 1 0 0.5 1 0 0 0"/>
    +     <key name="home" qpos="1 0 0.5 1 0 0 0 0.8 -0.4"/>

The number: how many numbers go to another joint. Told where a quaternion, as it is read, has a length that differs
from 1 by more than 2 %, and where with the free joints and what stands between them in another order all quaternions
have length 1. Of several such orders the one that leaves the fewest joints outside of their ranges is proposed.

The six numbers of a free joint in `qvel` are its velocity, then its angular velocity. A hint tells of a ball that, with
the two exchanged, would roll and slip by less than 5 % of its speed, and as it is written slips by more than half.

When it is wrong: a keyframe whose quaternion was typed without care for its length.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.engine import SPHERE
from clinic.diagnosis.probes.key import astray, reordered
from clinic.diagnosis.probes.vector import Vector, cross, norm, sub, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A keyframe in another order than the joints"
FAMILIES = ("jumps-at-start", "drifts", "explodes")

UPRIGHT = 0.999  # of a quaternion's first number
SLIPS, ROLLS = 0.5, 0.05  # of the speed


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Keyframes with a quaternion where there is none."""
    of = model.simulation
    yield from _rolling(model)
    for key in range(of.count("key")):
        qpos, element = reordered(model, key), model.element("key", key)
        if not qpos or element is None:
            continue
        yield Suspect(
            (of.name("key", key),),
            "qpos",
            element.get("qpos"),
            written(qpos),
            (set_attribute(element, "qpos", written(qpos)),),
            astray(key, tuple(qpos)),
            0.5,
            "Four of its numbers are read as a quaternion and are none; in another order of the joints they are.",
            "the order of the joints in the model; a quaternion has length 1",
            excess=100.0,
        )


def _rolling(model: ReaderModel) -> Iterator[Suspect]:
    """Keyframes with balls whose velocity and angular velocity are exchanged."""
    of = model.simulation
    for key, balls in _spun(of).items():
        if (element := model.element("key", key)) is None:
            continue
        now = list(of.row("key_qvel", key, of.count("dof")))
        qvel = list(now)
        for dof in (of.dof(of.joints_of(ball)[0]) for ball in balls):
            qvel[dof : dof + 6] = now[dof + 3 : dof + 6] + now[dof : dof + 3]
        names = of.name("key", key), *(of.name("body", ball) for ball in balls)
        says = f"With its velocity and its angular velocity exchanged {names[1]} would roll; it slides."
        edits = (set_attribute(element, "qvel", written(qvel)),)
        probe = how_many("keyframes with a ball that would roll if exchanged", _spun)
        healthy = "the velocity, then the angular velocity"
        yield Suspect(names, "qvel", element.get("qvel"), written(qvel), edits, probe, 0, says, healthy, level="hint")


def _spun(of: Simulation) -> dict[int, list[int]]:
    """By keyframe, the balls that would roll in it if their velocities were exchanged, and do not."""
    made: dict[int, list[int]] = {}
    for key in range(of.count("key")):
        qpos, qvel = (of.model(f"key_{what}") for what in ("qpos", "qvel"))
        places, dofs = len(qpos) // of.count("key"), of.count("dof")
        for body in of.free_bodies:
            joint, geoms = of.joints_of(body)[0], of.geoms_of(body)
            if len(geoms) != 1 or int(of.model("geom_type")[geoms[0]]) != SPHERE:
                continue
            at, dof = key * places + of.place(joint), key * dofs + of.dof(joint)
            way, turn = tuple(qvel[dof : dof + 3]), tuple(qvel[dof + 3 : dof + 6])
            level = abs(qpos[at + 3]) > UPRIGHT  # so that the axes of both are the same
            radius = of.model("geom_size")[3 * geoms[0]]
            if (
                level
                and any(way)
                and any(turn)
                and _slips(way, turn, radius) > SLIPS
                and _slips(turn, way, radius) < ROLLS
            ):
                made.setdefault(key, []).append(body)
    return made


def _slips(way: Vector, turn: Vector, radius: float) -> float:
    """How fast a ball slides on the floor below it, over its speed."""
    return norm(sub(way, cross(turn, (0.0, 0.0, radius)))) / norm(way)
