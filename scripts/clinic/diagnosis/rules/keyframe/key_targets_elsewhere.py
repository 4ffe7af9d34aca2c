"""The servos of a keyframe are told to go elsewhere than where it puts the joints.

A `<key>` with `qpos` and no `ctrl`, or with a `ctrl` in another order: at the first step the robot leaves the pose.

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
      <actuator>
        <position name="shoulder" joint="shoulder" kp="50" kv="5"/>
        <position name="elbow" joint="elbow" kp="50" kv="5"/>
      </actuator>
      <keyframe>
        <key name="home" qpos="0.8 1.2"/>
      </keyframe>
    </mujoco>

Good:

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
      <actuator>
        <position name="shoulder" joint="shoulder" kp="50" kv="5"/>
        <position name="elbow" joint="elbow" kp="50" kv="5"/>
      </actuator>
      <keyframe>
        <key name="home" qpos="0.8 1.2" ctrl="0.8 1.2"/>
      </keyframe>
    </mujoco>

The number: the distance between target and joint that three quarters of the position servos keep, in rad or m; 0.1 and
more tells a cause, for keyframes in which at least two servos and half of them are off. Where there is no `ctrl`, two
servos that go 0.5 away are told in a hint.

When it is wrong: a keyframe that is meant to start a motion.
Whether `ctrl` is left out on purpose, only its author knows: all zero and no `ctrl` is a hint.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.probes.key import farthest_target, off_target, reordered, servos
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect

TITLE = "A keyframe's targets are not its pose"
FAMILIES = ("drifts", "jumps-at-start", "sags")
SINCE = "0.1"
UNPLANTED = "no healthy model has a keyframe with controls"

LIMIT, FAR = 0.1, 0.5  # rad or m


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Keyframes whose `ctrl` holds another pose than their `qpos`."""
    of = model.simulation
    for key in range(of.count("key")):
        if reordered(model, key):
            continue
        found = servos(of, key)
        off = [actuator for actuator, (target, at) in found.items() if abs(target - at) > LIMIT]
        element = model.element("key", key)
        left_out = element is not None and "ctrl" not in element.attributes
        far = [actuator for actuator in off if abs(found[actuator][0] - found[actuator][1]) > FAR]
        if (
            not (len(off) >= max(2, 0.5 * len(found)) or (left_out and len(far) > 1))
            or element is None
            or len(element.get("qpos").split()) != len(of.model("qpos0"))
        ):
            continue
        most = len(off) >= max(2, 0.5 * len(found))
        ctrl = list(of.data("ctrl"))
        for actuator, (_, at) in found.items():
            gear = of.row("actuator_gear", actuator, 6)[0]
            ctrl[actuator] = at * gear * -of.bias(actuator)[1] / of.gain(actuator)[0]
        worst = max(off, key=lambda actuator: abs(found[actuator][0] - found[actuator][1]))
        target, at = found[worst]
        yield Suspect(
            (of.name("key", key),),
            "ctrl",
            element.get("ctrl") or "left out",
            written(ctrl),
            (set_attribute(element, "ctrl", written(ctrl)),),
            off_target(key) if most else farthest_target(key),
            LIMIT if most else FAR,
            f"{len(off)} of {len(found)} servos go away: {of.name('actuator', worst)} from {at:.3g} to {target:.3g}.",
            "the targets of a pose are its joints' positions",
            level="hint" if left_out else "cause",
        )
