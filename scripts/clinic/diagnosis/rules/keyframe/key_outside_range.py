"""A keyframe puts joints outside of their ranges.

The limits push back at the first step, and the robot jumps. A keyframe in degrees does it, one that was made before a
range was changed, and one with a joint more or less than the model.

Bad:

    <mujoco>
      <worldbody>
        <body name="upper" pos="0 0 1">
          <joint name="shoulder" axis="0 1 0" range="-90 90" damping="1" armature="0.1"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
          <body name="lower" pos="0.3 0 0">
            <joint name="elbow" axis="0 1 0" range="0 120" damping="1" armature="0.1"/>
            <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
          </body>
        </body>
      </worldbody>
      <keyframe>
        <key name="home" qpos="0.2 -1.2"/>
      </keyframe>
    </mujoco>

Good:

    -     <key name="home" qpos="0.2 -1.2"/>
    +     <key name="home" qpos="0.2 1.2"/>

The number: how far the worst joint is outside, in rad or m: 0.1 and more.

When it is wrong: a limit that is soft on purpose.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.probes.key import beyond, outside, reordered
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect

TITLE = "A keyframe is outside of the joints' ranges"
FAMILIES = ("jumps-at-start", "explodes")
SINCE = "0.1"
CASE = "arm-jumps-at-reset"

LIMIT = 0.1  # rad or m


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Keyframes with joints beyond their limits."""
    of = model.simulation
    for key in range(of.count("key")):
        if reordered(model, key):
            continue
        off = {joint: each for joint, each in beyond(of, key).items() if abs(each) > LIMIT}
        element = model.element("key", key)
        if not off or element is None:
            continue
        qpos = list(of.data("qpos"))
        for joint, each in off.items():
            qpos[int(of.model("jnt_qposadr")[joint])] -= each
        worst = max(off, key=lambda joint: abs(off[joint]))
        low, high = of.row("jnt_range", worst, 2)
        yield Suspect(
            (of.name("key", key), *(of.name("joint", joint) for joint in off)),
            "qpos",
            element.get("qpos"),
            written(qpos),
            (set_attribute(element, "qpos", written(qpos)),),
            outside(key),
            LIMIT,
            f"{of.name('joint', worst)} stands {abs(off[worst]):.3g} outside of {low:.3g} to {high:.3g}.",
            "inside of the ranges",
            excess=abs(off[worst]) / LIMIT,
        )
