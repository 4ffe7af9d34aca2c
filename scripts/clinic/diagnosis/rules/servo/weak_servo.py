"""A position servo too weak for the weight it carries.

A position servo is a spring: it holds a load only by being off its target, by load / kp. A gain that was left at its
default of 1 N m/rad lets an arm hang.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="shoulder" axis="0 1 0" damping="1"/>
          <geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.02" mass="1"/>
        </body>
      </worldbody>
      <actuator>
        <position joint="shoulder"/>
      </actuator>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="shoulder" axis="0 1 0" damping="1"/>
          <geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.02" mass="1"/>
        </body>
      </worldbody>
      <actuator>
        <position joint="shoulder" kp="200" dampratio="1"/>
      </actuator>
    </mujoco>

The number: the model's own weight at the joint over the gain, in the worst of 17 poses: more than 0.3 rad (0.3 m).

When it is wrong: a controller that adds the weight itself. `gravcomp="1"` on the bodies takes the load away as well.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.probes.load import loads, sag, sags
from clinic.diagnosis.probes.servo import Servo, servos
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect

TITLE = "A servo too weak for the weight it carries"
FAMILIES = ("sags", "drifts")
SINCE = "0.2"
CASE = "servo-sags"

SAG = 0.3  # rad of a hinge, m of a slide
GOOD = {True: 0.02, False: 0.002}


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Servos that sag, hinges and slides apart."""
    simulation, found = model.simulation, sags(model.simulation)
    for hinge in (True, False):
        weak = [each for each in servos(simulation) if each.hinge == hinge and found[each.actuator] > SAG]
        weak.sort(key=lambda each: -found[each.actuator])
        if not weak:
            continue
        worst, load = weak[0], loads(simulation)
        yield Suspect(
            tuple(simulation.name("actuator", each.actuator) for each in weak),
            "kp",
            f"{worst.stiffness:.3g}",
            f"{load[worst.dof] / GOOD[hinge]:.2g}",
            tuple(edit for each in weak for edit in _stronger(model, each, load[each.dof] / GOOD[hinge])),
            sag([each.actuator for each in weak]),
            SAG,
            f"The weight at {simulation.name('joint', worst.joint)} is up to {load[worst.dof]:.3g} "
            f"{'N m' if hinge else 'N'}, and its servo gives {worst.stiffness:.3g} for each {worst.unit}.",
            f"below {SAG:g} {worst.unit}; 0.29 is the most of 55 healthy models with servos",
        )


def _stronger(model: ReaderModel, servo: Servo, stiffness: float) -> tuple[Edit, ...]:
    """The edits that give a servo a stiffness at the joint, and its own damping a share of it."""
    times = stiffness / servo.stiffness
    element, one = model.element("actuator", servo.actuator), [servo.actuator]
    if element is None:
        return ()
    gain = model.simulation.model("actuator_gainprm")
    width = len(gain) // model.simulation.count("actuator")
    bias = model.simulation.row("actuator_biasprm", servo.actuator, width)
    own = gain[width * servo.actuator]
    if element.tag == "general":
        return (
            *model.set("actuator", one, "gainprm", f"{own * times:.3g}"),
            *model.set(
                "actuator", one, "biasprm", f"{bias[0] * times:.3g} {bias[1] * times:.3g} {bias[2] * times**0.5:.3g}"
            ),
        )
    edits = model.set("actuator", one, "kp", f"{own * times:.3g}")
    if model.value("actuator", servo.actuator, "kv") is not None:
        edits += model.set("actuator", one, "kv", f"{-bias[2] * times**0.5:.3g}")
    return edits
