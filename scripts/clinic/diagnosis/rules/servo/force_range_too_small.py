"""A servo's force range is smaller than the weight that it must hold.

`forcerange` clips what an actuator gives, and `actuatorfrcrange` what all actuators of a joint give. Below the weight
of what hangs on the joint no gain can lift it.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="shoulder" axis="0 1 0" damping="1"/>
          <geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.02" mass="1"/>
        </body>
      </worldbody>
      <actuator>
        <position joint="shoulder" kp="500" dampratio="1" forcerange="-1 1"/>
      </actuator>
    </mujoco>

Good:

    -     <position joint="shoulder" kp="500" dampratio="1" forcerange="-1 1"/>
    +     <position joint="shoulder" kp="500" dampratio="1" forcerange="-10 10"/>

The number: the model's own weight at the joint over the greatest force of its servos, in the worst of 17 poses. Or the
height that a robot with a free base loses within 1 s, its servos told to stay where they are, where some give all they
can. Where several have their limit from one class, the class gets what the worst of them needs.

When it is wrong: a joint that a spring or a closed chain carries, or that never takes such a pose.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from clinic.diagnosis.edit import Edit, set_attribute
from clinic.diagnosis.engine import HINGE, SLIDE
from clinic.diagnosis.probes.load import loads, strain, strains
from clinic.diagnosis.probes.servo import Servo, servos
from clinic.diagnosis.probes.stand import BENT, LOST, goes_down, stance
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, rounded

TITLE = "A force range too small for the weight"
FAMILIES = ("sags", "stuck")
SINCE = "0.1"
CASE = "arm-stops-short"

STRAIN = 1.2
MORE = 5.0  # times the force that is tried under a robot that goes down


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Servos that cannot hold the weight, all together."""
    simulation, found, load = model.simulation, strains(model.simulation), loads(model.simulation)
    yield from _undriven(model)
    yield from _gives_way(model)
    weak = sorted(
        (each for each in servos(simulation) if found[each.actuator] > STRAIN), key=lambda each: -found[each.actuator]
    )
    if not weak:
        return
    worst = weak[0]
    unit = worst.force_unit
    yield Suspect(
        tuple(simulation.name("actuator", each.actuator) for each in weak),
        "forcerange",
        f"{worst.force:.3g}",
        rounded(3 * load[worst.dof]),
        _stronger(model, {each: load[each.dof] * 3 for each in weak}),
        strain([each.actuator for each in weak]),
        STRAIN,
        f"The weight at {simulation.name('joint', worst.joint)} is up to {load[worst.dof]:.3g} {unit}, "
        f"and its servo gives {worst.force:.3g} {unit} at most.",
        "1 and less; motors are chosen for twice the weight and more",
    )


def _gives_way(model: ReaderModel) -> Iterator[Suspect]:
    """Servos of legs that give all they can, and let the robot down that stands on them."""
    of, seen = model.simulation, stance(model.simulation)
    full = sorted(seen.full, key=lambda each: -seen.bent[each])
    if not full or max(seen.bent.values()) <= BENT:
        return
    unit = full[0].force_unit
    yield Suspect(
        tuple(of.name("actuator", each.actuator) for each in full),
        "forcerange",
        f"{full[0].force:.3g}",
        rounded(MORE * full[0].force),
        _stronger(model, {each: MORE * each.force for each in seen.bent}),
        goes_down(),
        LOST,
        f"Standing, {of.name('joint', full[0].joint)} bends although its servo gives all of its {full[0].force:.3g} "
        f"{unit}.",
        "next to nothing: a robot that stands",
    )


def _undriven(model: ReaderModel) -> Iterator[Suspect]:
    """Joints of a model without actuators, such as one made of a URDF, whose limit is below the weight."""
    simulation = model.simulation
    if simulation.count("actuator"):
        return
    weak = [
        joint
        for joint, limited in enumerate(simulation.model("jnt_actfrclimited"))
        if limited and simulation.joint_type(joint) in (HINGE, SLIDE) and _weight_over_limit(simulation, joint) > STRAIN
    ]
    if weak:
        worst = max(weak, key=lambda joint: _weight_over_limit(simulation, joint))
        limit, name = simulation.row("jnt_actfrcrange", worst, 2)[1], simulation.name("joint", worst)
        need = loads(simulation)[simulation.dof(worst)]
        yield Suspect(
            tuple(simulation.name("joint", joint) for joint in weak),
            "effort" if model.urdf else "actuatorfrcrange",
            f"{limit:.3g}",
            rounded(3 * need),
            (),
            Probe("weight over the limit of the force", "", _weight_over_limit, (worst,), dynamic=False),
            STRAIN,
            f"The weight at {name} is up to {need:.3g}, and no actuator may give more than {limit:.3g} there.",
            "1 and less; motors are chosen for twice the weight and more",
            level="hint",
        )


def _weight_over_limit(simulation: Simulation, joint: int) -> float:
    limit = max(map(abs, simulation.row("jnt_actfrcrange", joint, 2)))
    return loads(simulation)[simulation.dof(joint)] / max(limit, 1e-12)


def _stronger(model: ReaderModel, wanted: Mapping[Servo, float]) -> tuple[Edit, ...]:
    """The edits of the limits that are below forces at the joints; of a class where several have theirs from it."""
    of, limits = model.simulation, dict[str, dict[int, str]]()
    for servo, force in wanted.items():
        gear = abs(of.gear(servo.actuator))
        own = max(map(abs, of.row("actuator_forcerange", servo.actuator, 2))) * gear
        if of.model("actuator_forcelimited")[servo.actuator] and own < force:
            limits.setdefault("forcerange", {})[servo.actuator] = rounded(force / gear)
        joint = max(map(abs, of.row("jnt_actfrcrange", servo.joint, 2)))
        if of.model("jnt_actfrclimited")[servo.joint] and joint < force:
            limits.setdefault("actuatorfrcrange", {})[servo.joint] = rounded(force)
    made: tuple[Edit, ...] = ()
    for attribute, each in limits.items():
        kind = "actuator" if attribute == "forcerange" else "joint"
        if len(each) > 1 and (giver := model.giver(kind, [*each], attribute)):
            most = max(each.values(), key=float)
            made += (set_attribute(giver, attribute, f"-{most} {most}"),)
        else:
            made += model.set_each(kind, attribute, {index: f"-{force} {force}" for index, force in each.items()})
    return made
