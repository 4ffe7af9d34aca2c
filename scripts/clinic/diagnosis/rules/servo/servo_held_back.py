"""The joint holds its servo back: by damping or armature of its own.

`damping` of a joint acts against its servo at every speed, and `armature` is inertia that has to be moved as well. With
ten times too much of one of them the joint follows in seconds. More `kp` helps only until the force is at its limit:
below, 40 N m against 100 N m s/rad turn the joint at 0.4 rad/s at most, whatever `kp` is.

Bad:

    <mujoco>
      <worldbody>
        <body name="arm" pos="0 0 1">
          <joint name="shoulder" axis="0 0 1" damping="100" range="-90 90"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03" mass="1"/>
        </body>
      </worldbody>
      <actuator>
        <position joint="shoulder" kp="50" ctrlrange="-1.5 1.5" forcerange="-40 40"/>
      </actuator>
    </mujoco>

Good:

    -       <joint name="shoulder" axis="0 0 1" damping="100" range="-90 90"/>
    +       <joint name="shoulder" axis="0 0 1" damping="2" range="-90 90"/>

The number: how much of a step of 0.1 rad (0.01 m) is left after 1 s; more than 0.45 by damping, 0.2 by armature. The
joint's `damping` is more than 0.6 s times the stiffness (10 s of a slide), most of all damping there is, and 3 times
that of the other driven joints, at a natural frequency above 10 rad/s: else the servo is weak. Or its `armature` is
more than 20 times what hangs on it, at one below 4 rad/s (1.5 rad/s of a slide). None of 96 healthy models with servos
has such a joint. Dry friction is not asked for: `frictionloss` is soft, and a servo creeps through it to its target.

When it is wrong: a joint that should creep, such as a door closer.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.probes.servo import COEFFICIENTS, Servo, remaining, servos
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, rounded

TITLE = "A joint that holds its servo back"
FAMILIES = ("stuck", "sags", "drifts")
LEVEL = "hint"

LATE = {True: 0.6, False: 10.0}  # s: by hinge, slide
SLOW = {True: 4.0, False: 1.5}  # rad/s
MOST, MANY, STIFF, OTHERS = 0.75, 20.0, 10.0, 3.0
LEFT = {"damping": 0.45, "armature": 0.2}
PROMPT, RATIO = 20.0, 0.7  # rad/s; the natural frequency and the damping ratio that an edit leaves


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Joints whose own damping or armature makes a servo late, together by which of them it is."""
    of = model.simulation
    found = {each: attribute for each in servos(of) if (attribute := holds_back(of, each))}
    late = {each: what for each, what in found.items() if model.measured(remaining([each.actuator])) > LEFT[what]}
    for attribute in dict.fromkeys(late.values()):
        held = [each for each in late if late[each] == attribute]
        worst, own = held[0], of.model(f"dof_{attribute}")[held[0].dof]
        damping = 2 * RATIO * math.sqrt(worst.stiffness * worst.inertia)
        value = {"damping": damping, "armature": worst.stiffness / PROMPT**2}
        edits = model.set("joint", [each.joint for each in held], attribute, rounded(value[attribute]))
        _, damps, mass = COEFFICIENTS[worst.unit]
        unit = damps if attribute == "damping" else mass
        yield Suspect(
            tuple(of.name("joint", each.joint) for each in held),
            attribute,
            f"{own:.3g}",
            rounded(value[attribute]),
            edits,
            remaining([each.actuator for each in held]),
            LEFT[attribute],
            f"The {attribute} of {of.name('joint', worst.joint)}, {own:.3g} {unit}, stands against a servo that gives "
            f"{worst.stiffness:.3g} {worst.force_unit} for each {worst.unit}.",
            "below 0.45 after 1 s in 96 healthy models with servos",
        )


def holds_back(of: Simulation, servo: Servo) -> str:
    """What of the joint's own makes a servo late: its `damping` or `armature`; empty where neither."""
    damping, armature = (of.model(f"dof_{name}")[servo.dof] for name in ("damping", "armature"))
    others = sorted(of.model("dof_damping")[each.dof] for each in servos(of) if each.dof != servo.dof)
    usual = bool(others) and damping <= OTHERS * others[len(others) // 2]
    stiff = servo.stiffness > STIFF**2 * servo.inertia
    if stiff and not usual and damping > max(LATE[servo.hinge] * servo.stiffness, MOST * servo.damping):
        return "damping"
    if armature > MANY * (servo.inertia - armature) and servo.stiffness < SLOW[servo.hinge] ** 2 * servo.inertia:
        return "armature"
    return ""
