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

When it is wrong: a keyframe whose quaternion was typed without care for its length.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.probes.key import astray, reordered
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect

TITLE = "A keyframe in another order than the joints"
FAMILIES = ("jumps-at-start", "drifts", "explodes")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Keyframes with a quaternion where there is none."""
    of = model.simulation
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
            astray(key, qpos),
            0.5,
            "Four of its numbers are read as a quaternion and are none; in another order of the joints they are.",
            "the order of the joints in the model; a quaternion has length 1",
            excess=100.0,
        )
