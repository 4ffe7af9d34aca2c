"""A keyframe puts the robot into the floor.

The height of a free joint that belongs to another pose, or to another frame: the contacts throw the robot up at the
first step.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="2 2 0.1"/>
        <body name="robot" pos="0 0 0.2">
          <freejoint/>
          <geom type="box" size="0.2 0.1 0.1"/>
        </body>
      </worldbody>
      <keyframe>
        <key name="home" qpos="0 0 0.02 1 0 0 0"/>
      </keyframe>
    </mujoco>

Good:

    -     <key name="home" qpos="0 0 0.02 1 0 0 0"/>
    +     <key name="home" qpos="0 0 0.1 1 0 0 0"/>

The number: how deep the deepest contact with a plane is at the keyframe, over the size of the model: 6 % and more.
Where the first key stands well, a later one is a hint: it may be there for its joints alone.

When it is wrong: something that is meant to be planted.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.probes.key import reordered, start_at, sunk
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Level, Suspect

TITLE = "A keyframe is in the floor"
FAMILIES = ("jumps-at-start", "explodes")

SHARE = 0.06  # of the size of what is free


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Keyframes of one free robot that begin inside of a plane."""
    of = model.simulation
    if len(of.free_bodies) != 1:
        return
    joint = of.joints_of(of.free_bodies[0])[0]
    height = of.place(joint) + 2
    for key in range(of.count("key")):
        if reordered(model, key):
            continue
        deep, element = model.measured(sunk(key)), model.element("key", key)
        start_at(of, key)
        places = of.data("xpos")[3:]
        size = max(max(places[i::3]) - min(places[i::3]) for i in range(3)) + max(of.model("geom_rbound"), default=0.0)
        if element is None or deep <= SHARE * size:
            continue
        level: Level = "hint" if key and model.measured(sunk(0)) <= SHARE * size else "cause"
        qpos = list(of.data("qpos"))
        qpos[height] += deep
        yield Suspect(
            (of.name("key", key),),
            "qpos",
            f"height {qpos[height] - deep:.4g}",
            f"height {qpos[height]:.4g}",
            (set_attribute(element, "qpos", written(qpos)),),
            sunk(key),
            SHARE * size,
            f"At the keyframe {of.name('body', of.free_bodies[0])} begins {1000 * deep:.3g} mm deep in a plane.",
            "at most 6 % of the robot's size",
            excess=deep / (SHARE * size),
            level=level,
        )
