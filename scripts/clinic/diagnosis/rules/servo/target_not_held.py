"""A general actuator with affine bias and no bias is a motor, not a servo.

`biastype="affine"` adds biasprm[0] + biasprm[1] length + biasprm[2] velocity to the force. With all three left at 0 the
force does not depend on where the joint is, and a control that is meant as a position is a torque.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="finger" axis="0 1 0" range="0 90" damping="0.1"/>
          <geom type="capsule" fromto="0 0 0 0.05 0 0" size="0.01" mass="0.05"/>
        </body>
      </worldbody>
      <actuator>
        <general joint="finger" biastype="affine" ctrlrange="0 1.57"/>
      </actuator>
    </mujoco>

Good:

    -     <general joint="finger" biastype="affine" ctrlrange="0 1.57"/>
    +     <general joint="finger" biastype="affine" ctrlrange="0 1.57" gainprm="10" biasprm="0 -10 -0.1"/>

The number: 1 + biasprm[1] / gainprm[0]: 0 for a servo, 1 where the force does not depend on the place. Where the two
have one sign, it is more: both positive, the joint is pushed away from its target; both negative, it is held at minus
its control. Of a tendon, and of all else that is no joint, only two that are positive are told.

When it is wrong: a velocity servo, which has biasprm[2] alone, is left alone.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import BIAS_AFFINE, DYN_INTEGRATOR, DYN_MUSCLE
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A servo that does not hold its target"
FAMILIES = ("stuck", "explodes", "sags", "passes-limit")


def _away(simulation: Simulation, actuators: tuple[int, ...]) -> float:
    """1 where a position gain is missing, 2 and more where it pushes away from the target."""
    found = 0.0
    for actuator in actuators:
        gain, bias = simulation.gain(actuator)[0], simulation.bias(actuator)
        found = max(found, 1 + bias[1] / gain)
    return found


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Actuators with an affine bias of the wrong sign, and those of joints with one of nothing."""
    simulation, found = model.simulation, _found(model)
    if not found:
        return
    edits: tuple[Edit, ...] = ()
    for actuator, gain, bias in found:
        element = model.element("actuator", actuator)
        if element is not None and element.tag == "general":
            joint = simulation.driven_joint(actuator)
            mass = simulation.mass_diagonal[simulation.dof(joint)] if joint is not None else 0.0
            damping = abs(bias[2]) or min(0.1 * abs(gain), 2 * (abs(gain) * mass) ** 0.5)
            text = f"{bias[0]:g} {-(abs(bias[1]) or gain):g} {-damping:g}"
            edits += model.set("actuator", [actuator], "biasprm", text)
            if gain < 0:
                edits += model.set("actuator", [actuator], "gainprm", f"{-gain:g}")
        elif element is not None and gain < 0:
            edits += model.set("actuator", [actuator], "kp", f"{-gain:g}")
    actuator, gain, bias = found[0]
    now = " ".join(f"{each:g}" for each in bias[:3])
    yield Suspect(
        tuple(simulation.name("actuator", each[0]) for each in found),
        "biasprm",
        now,
        next((each.value for each in edits), ""),
        edits,
        Probe(
            "pull towards the target that is missing: 1 none, more for a push away",
            "",
            _away,
            (tuple(each[0] for each in found),),
            dynamic=False,
        ),
        0.9,
        f"With gainprm {gain:g} and biasprm {now} the force "
        + (
            "does not depend on where the joint is."
            if not bias[1]
            else "pushes away from the target."
            if gain > 0
            else "holds the joint at minus its control."
        ),
        "biasprm[1] = -gainprm[0], as <position> has it",
    )


def _found(model: ReaderModel) -> list[tuple[int, float, tuple[float, ...]]]:
    """The actuators that do not pull towards their target, with the gain and the bias of each."""
    simulation, made = model.simulation, []
    for actuator in range(simulation.count("actuator")):
        if int(simulation.model("actuator_biastype")[actuator]) != BIAS_AFFINE:
            continue
        if int(simulation.model("actuator_dyntype")[actuator]) in (DYN_INTEGRATOR, DYN_MUSCLE):
            continue
        if (placed := model.element("actuator", actuator)) is not None and placed.tag == "cylinder":
            continue  # whose force is that of a pressure
        gain, bias = simulation.gain(actuator)[0], simulation.bias(actuator)
        if simulation.driven_joint(actuator) is None:
            away = gain > 0 < bias[1]
        else:
            away = bool(gain) and (not any(bias[:3]) or bias[1] / gain > 0)
        if away:
            made.append((actuator, gain, bias))
    return made
