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

The number: the model's own weight at the joint over the greatest force of its servos, in the worst of 17 poses: above
1.2, for that pose may never be taken; or above 1 in all of them, where nothing else carries the joint. Or the height
that a robot with a free base loses within 1 s, its servos told to stay where they are, where some give all they can.

In a closed loop, whose load only a run shows, it is how far the weight moves the joint of a servo that is told to
hold the start and gives all it can: more than a tenth of the range. Of joints that equalities couple it is the
weight of all over what all of their servos give, each by its factor. Where several have their limit from one class,
the class gets what the worst of them needs.

Hints tell of two servos and more that give all they can under a robot that stands, as in none of 16 healthy ones; and
of a hinge whose weight takes more than 40 % of its servo's force, and three times the share of any servo that carries
it: of 260 healthy models it is 1.04 times at the most, for motors are stronger the nearer they are to the base.

When it is wrong: a joint that a spring carries, or that never takes such a pose.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from clinic.diagnosis.edit import Edit, set_attribute
from clinic.diagnosis.probes.couplings import Coupling, couplings
from clinic.diagnosis.probes.equalities import COUPLED
from clinic.diagnosis.probes.load import carriers, least_loads, loads, outdone, strain, strains, travel, yielded, yields
from clinic.diagnosis.probes.servo import Servo, servos
from clinic.diagnosis.probes.stand import BENT, LOST, at_their_limit, goes_down, stance
from clinic.diagnosis.probes.tendons import joints_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.keyframe.key_breaks_equality import elsewhere
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, rounded

TITLE = "A force range too small for the weight"
FAMILIES = ("sags", "stuck")
CASE = "arm-stops-short"

STRAIN = 1.2
MORE = 5.0  # times the force that is tried under a robot that goes down, or in a loop
WAY = 0.1  # of its range
PRESSED, TIMES = 0.4, 3.0  # share of the force; of that of the servos that carry the joint


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Servos that cannot hold the weight, all together."""
    simulation, found, load = model.simulation, strains(model.simulation), loads(model.simulation)
    yield from _undriven(model)
    yield from _gives_way(model)
    yield from _in_loops(model)
    yield from _through_couplings(model)
    over = [each for each in servos(simulation) if found[each.actuator] > STRAIN]
    weak = sorted(over or _never_held(simulation), key=lambda each: -found[each.actuator])
    if not weak:
        yield from _unlike_carriers(model)
        return
    unit = weak[0].force_unit
    says = (
        f"The weight at {simulation.name('joint', weak[0].joint)} is up to {load[weak[0].dof]:.3g} {unit}, "
        f"and its servo gives {weak[0].force:.3g} {unit} at most."
    )
    probe, healthy = (
        strain([each.actuator for each in weak]),
        "1 and less; motors are chosen for twice the weight and more",
    )
    limit = STRAIN if over else 1.0
    yield _told(model, {each: 3 * load[each.dof] for each in weak}, probe, limit, says, healthy)


def _never_held(of: Simulation) -> list[Servo]:
    """The servos of joints that nothing else carries, and whose weight is above their force in all poses."""
    found, friction = strains(of), of.model("dof_frictionloss")
    weak = [each for each in servos(of) if found[each.actuator] > 1]
    if any(int(kind) != COUPLED for kind in of.model("eq_type")):
        return []
    return [
        each
        for each in weak
        if least_loads(of)[each.dof] - friction[each.dof] > each.force
        and len(_followers(of, each.joint)) == len(_holding(of, each.joint)) == 1
    ]


def _told(
    model: ReaderModel,
    wanted: Mapping[Servo, float],
    probe: Probe,
    limit: float,
    says: str,
    healthy: str,
    hint: bool = False,
) -> Suspect:
    """Servos, the worst first, with the forces at their joints that would do."""
    (worst, force), of, edits = next(iter(wanted.items())), model.simulation, _stronger(model, wanted)
    return Suspect(
        tuple(of.name("actuator", each.actuator) for each in wanted),
        edits[0].attribute if edits else "forcerange",
        f"{worst.force:.3g}",
        rounded(force),
        edits,
        probe,
        limit,
        says,
        healthy,
        level="hint" if hint else "cause",
    )


def _gives_way(model: ReaderModel) -> Iterator[Suspect]:
    """Servos of legs that give all they can, and let the robot down that stands on them; a hint if they do not."""
    of, seen = model.simulation, stance(model.simulation)
    full = sorted(seen.full, key=lambda each: -seen.bent[each])
    if not full:
        return
    force, healthy = f"{full[0].force:.3g} {full[0].force_unit}", "next to nothing: a robot that stands"
    if max(seen.bent.values()) > BENT:
        says = f"Standing, {of.name('joint', full[0].joint)} bends although its servo gives all of its {force}."
        more = {each: MORE * each.force for each in [*full, *seen.bent]}
        names = tuple(of.name("actuator", each.actuator) for each in full)
        yield replace(_told(model, more, goes_down(), LOST, says, healthy), elements=names)
        return
    says = f"Standing still takes all of the {force} of {of.name('actuator', full[0].actuator)}."
    more, healthy = {each: MORE * each.force for each in full}, "none: what stands has force left for a step"
    yield _told(model, more, at_their_limit(), 1, says, healthy, hint=True)


def _in_loops(model: ReaderModel) -> Iterator[Suspect]:
    """Servos that the weight moves although they give all they can, through a loop that a connection closes."""
    of, found = model.simulation, yielded(model.simulation)
    weak = sorted((each for each in found if found[each] > WAY * travel(each)), key=lambda each: -found[each])
    if not weak:
        return
    worst, probe = weak[0], yields([each.actuator for each in weak])
    says = (
        f"Told to stay, {of.name('joint', worst.joint)} goes {found[worst]:.2g} {worst.unit} although its servo gives "
        f"all of its {worst.force:.3g} {worst.force_unit}."
    )
    yield _told(model, {each: MORE * each.force for each in weak}, probe, WAY, says, "next to nothing")


def _through_couplings(model: ReaderModel) -> Iterator[Suspect]:
    """Servos that together cannot hold the weight of what equalities couple to their joints: a bed on lead screws."""
    of, alone = model.simulation, strains(model.simulation)
    doubted = {coupling[1] for each, coupling in couplings(of) if elsewhere(model, each) or _left_at_one(of, coupling)}
    for leader in sorted({coupling[1] for _, coupling in couplings(of)} - doubted):
        holding, share = _holding(of, leader), _coupled(of, leader)
        if not holding or share <= STRAIN or any(alone[each.actuator] > STRAIN for each in holding):
            continue
        who = ", ".join(of.name("actuator", each.actuator) for each in list(holding)[:3])
        says = (
            f"By its couplings the weight at {of.name('joint', leader)} is {share:.2g} times what {who} hold with all "
            f"of their {next(iter(holding)).force:.3g} {next(iter(holding)).force_unit}."
        )
        probe = Probe("weight of what is coupled over what its servos hold", "", _coupled, (leader,), dynamic=False)
        wanted, healthy = {each: 3 * share * each.force for each in holding}, "0.05 at the most, in 260 healthy models"
        yield _told(model, wanted, probe, STRAIN, says, healthy)


def _left_at_one(of: Simulation, coupling: Coupling) -> bool:
    """Whether a turn and a way are coupled by 1 rad/m, which is the ratio of a screw that nobody wrote."""
    follower, leader, factors = coupling
    return of.joint_type(follower) != of.joint_type(leader) and abs(factors[1]) == 1


def _followers(of: Simulation, leader: int) -> dict[int, float]:
    """The joints that go with one, and how far each does for its way; of polynomials that are lines."""
    led = {follower: abs(by[1]) for _, (follower, ahead, by) in couplings(of) if ahead == leader and not any(by[2:])}
    return {leader: 1.0} | led


def _holding(of: Simulation, leader: int) -> dict[Servo, float]:
    """The servos of joints that go together, and what each gives at the leader; none where others drive or carry."""
    joints = _followers(of, leader)
    found = {each: joints[each.joint] * each.force for each in servos(of) if each.joint in joints}
    drivers = {actuator for joint in joints for actuator in of.drivers.get(joint, ())}
    springs = any(of.model("jnt_stiffness")[joint] for joint in joints)
    over = [joints_of(of, tendon) for tendon in range(of.count("tendon"))]
    tied = any(not part or joints.keys() & dict(part).keys() for part in over)
    return {} if springs or tied or drivers != {each.actuator for each in found} else found


def _coupled(of: Simulation, leader: int) -> float:
    """The weight of what goes with a joint over what its servos, and dry friction, hold; 0 without a servo."""
    joints, given = _followers(of, leader), sum(_holding(of, leader).values())
    friction, load = of.model("dof_frictionloss"), loads(of)
    weight = sum(by * max(0.0, load[of.dof(joint)] - friction[of.dof(joint)]) for joint, by in joints.items())
    return weight / given if given > 0 else 0.0


def _unlike_carriers(model: ReaderModel) -> Iterator[Suspect]:
    """Hinges' servos of which the weight takes a far larger share than of those that carry them: a hint."""
    of, found, load = model.simulation, strains(model.simulation), loads(model.simulation)
    shares = {each: (found[each.actuator], found[over.actuator], over) for each, over in carriers(of).items()}
    weak = [each for each, (own, over, _) in shares.items() if own > PRESSED and own > TIMES * over]
    if not weak:
        return
    weak.sort(key=lambda each: -shares[each][0])
    own, over, carrier = shares[weak[0]]
    says = (
        f"The weight takes {100 * own:.0f} % of the {weak[0].force:.3g} {weak[0].force_unit} at "
        f"{of.name('joint', weak[0].joint)}, and {100 * over:.0f} % of the {carrier.force:.3g} {carrier.force_unit} at "
        f"{of.name('joint', carrier.joint)}, which carries it."
    )
    wanted = {each: load[each.dof] / shares[each][1] for each in weak}
    probe, healthy = outdone([each.actuator for each in weak]), "1.04 at the most, in 260 healthy models"
    yield _told(model, wanted, probe, TIMES, says, healthy, hint=True)


def _undriven(model: ReaderModel) -> Iterator[Suspect]:
    """Joints of a model without actuators, such as one made of a URDF, whose limit is below the weight."""
    simulation = model.simulation
    if simulation.count("actuator"):
        return
    limited = [joint for joint in simulation.scalar_joints if simulation.model("jnt_actfrclimited")[joint]]
    weak = [joint for joint in limited if _weight_over_limit(simulation, joint) > STRAIN]
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
