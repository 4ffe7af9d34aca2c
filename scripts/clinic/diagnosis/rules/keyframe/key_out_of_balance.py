"""The motor of a keyframe pushes its joint away, and with the sign of one number changed holds it.

A `<key>` with a control of a motor is mostly a pose that is held: against a spring, or against the weight. Where the
two are about equal and push the same way, one has the wrong sign, and the joint goes off at the first step.

Bad:

    <mujoco>
      <worldbody>
        <body name="lever" pos="0 0 1">
          <joint name="lever" axis="0 0 1" range="-10 60" stiffness="0.8" damping="0.05" armature="0.01"/>
          <geom type="capsule" fromto="0 0 0 0.1 0 0" size="0.01" mass="0.2"/>
        </body>
      </worldbody>
      <actuator>
        <motor name="twist" joint="lever" gear="-2" ctrlrange="-1 1"/>
      </actuator>
      <keyframe>
        <key name="turned" qpos="0.7" ctrl="0.28"/>
      </keyframe>
    </mujoco>

Good:

    -     <motor name="twist" joint="lever" gear="-2" ctrlrange="-1 1"/>
    +     <motor name="twist" joint="lever" gear="2" ctrlrange="-1 1"/>

The number: what springs, gravity and the motor leave of force at the joint, over the motor's own; more than 0.5 as it
is, and less than 0.25 with the sign of a negative `gear`, of the control or of `springref` changed, and of no other of
them. Keyframes with a speed or with contacts, joints at a limit, and those with another actuator are left out.

When it is wrong: a keyframe that starts a motion, with a force that happens to be as large as the load.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, set_attribute
from clinic.diagnosis.probes.key import start_at
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A keyframe's motor pushes the wrong way"
FAMILIES = ("drifts", "jumps-at-start", "sags")
UNPLANTED = "no healthy model has a keyframe with controls of motors"

OFF, BALANCED = 0.5, 0.25  # of the motor's force
INSIDE, RUBS = 0.01, 2.0  # of the range, from its ends; times the dry friction, which the motor's force is at least


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each motor of a keyframe that one other sign would have hold its joint."""
    of = model.simulation
    for key in range(of.count("key")):
        for actuator, joint in _held(of, key).items():
            probe = Probe("force that is left over, over the motor's", "", _left, (key, actuator, joint), dynamic=False)
            left = model.measured(probe)
            tried = _signs(model, key, actuator, joint) if left > OFF else []
            found = [each for each in tried if model.measured(probe, each[3]) < BALANCED]
            if len(found) != 1:
                continue
            attribute, now, value, edits = found[0]
            names = tuple(of.name(*each) for each in (("actuator", actuator), ("joint", joint), ("key", key)))
            says = f"In {names[2]} {left:.2g} times the force of {names[0]} is left over at {names[1]}."
            yield Suspect(names, attribute, now, value, edits, probe, OFF, says, "0: a pose that is held")


def _held(of: Simulation, key: int) -> dict[int, int]:
    """The motors that push in a keyframe without speed and contacts, and the joints that they alone drive."""
    start_at(of, key)
    if any(of.data("qvel")) or of.engine.contacts():
        return {}
    made = {}
    for joint, driving in of.drivers.items():
        low, high = of.ranges.get(joint, (-1e9, 1e9))
        free = low + INSIDE * (high - low) < of.position(joint) < high - INSIDE * (high - low)
        force, dof = abs(of.data("qfrc_actuator")[of.dof(joint)]), of.dof(joint)
        if len(driving) == 1 and of.is_motor(driving[0]) and free and force > RUBS * of.model("dof_frictionloss")[dof]:
            made[driving[0]] = joint
    return made


def _left(of: Simulation, key: int, actuator: int, joint: int) -> float:
    if _held(of, key).get(actuator) != joint:
        return 0.0
    own, passive, bias = (of.data(f"qfrc_{kind}")[of.dof(joint)] for kind in ("actuator", "passive", "bias"))
    return abs(own + passive - bias) / max(abs(own), 1e-12)


def _signs(model: ReaderModel, key: int, actuator: int, joint: int) -> list[tuple[str, str, str, tuple[Edit, ...]]]:
    """Edits of one sign each: the attribute, what it is, what it becomes; of a positive gear the control's instead."""
    of, made = model.simulation, list[tuple[str, str, str, tuple[Edit, ...]]]()
    gear, rest, element = of.gear(actuator), model.value("joint", joint, "springref"), model.element("key", key)
    if gear < 0 and (edits := model.set("actuator", [actuator], "gear", f"{-gear:g}")):
        made.append(("gear", f"{gear:g}", f"{-gear:g}", edits))
    elif gear > 0 and element is not None and element.get("ctrl"):
        start_at(of, key)
        ctrl = list(of.data("ctrl"))
        ctrl[actuator] = -ctrl[actuator]
        made.append(("ctrl", element.get("ctrl"), written(ctrl), (set_attribute(element, "ctrl", written(ctrl)),)))
    if rest and float(rest) and (edits := model.set("joint", [joint], "springref", f"{-float(rest):g}")):
        made.append(("springref", rest, f"{-float(rest):g}", edits))
    return made
