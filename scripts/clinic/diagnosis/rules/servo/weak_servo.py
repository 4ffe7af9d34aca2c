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

    -     <position joint="shoulder"/>
    +     <position joint="shoulder" kp="200" dampratio="1"/>

The number: the model's own weight at the joint over the gain, in the worst of 17 poses: more than 0.3 rad (0.3 m),
0.55 rad where the base is free: legs that a learned policy drives go up to 0.5 rad. Beyond 10,000 rad it is a hint: a
mass, gravity or a unit is wrong, and no servo.

Or a robot with a free base goes down by a quarter of its height within 1 s, its servos told to stay where they are, and
one of them bends by more than 0.45 rad. A hint tells of one that stands for a second and has lost half of its height
after 5 s, and that with three times the stiffness stands; where it stands with twice as much, its balance was left to a
controller, and only `--symptom sags` tells it.

Or more than 45 % of a step of 0.1 rad is left after 1 s, without gravity; a hint for what follows within 2 s and
carries less than a twentieth of the mass, as a neck does. Where its kv over its kp is 20 times the greatest of four
others and more, kv is told in place of kp.

Where the base is fixed, a hint tells of hinges that sag by more than 0.085 rad, and of slides that sag by more
than 10 % of their range: fingers with 40 mm that swing by 5 mm as the arm turns, where grippers and lifters that work
well do by 6 to 7 %. With `--symptom sags` it tells from a fifth of that on, of a free base's too.

When it is wrong: a controller that adds the weight itself. `gravcomp="1"` on the bodies takes the load away as well.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.probes.load import loads, sag, sags
from clinic.diagnosis.probes.run import resets
from clinic.diagnosis.probes.servo import Servo, remaining, servos
from clinic.diagnosis.probes.shape import root_of
from clinic.diagnosis.probes.stand import BENT, LOST, goes_down, stance, stance_after
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.servo.servo_held_back import holds_back
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, rounded

TITLE = "A servo too weak for the weight it carries"
FAMILIES = ("sags", "drifts")
CASE = "servo-sags"

LATE, CRAWLS = 0.6, 10.0  # s: the time constant above which a step is tried, of a hinge and a slide
SLOW = 4.0  # rad/s: the natural frequency below which it is
LEFT = 0.45  # of the step
LONG, FALLEN, NEARLY, STIFFER = 5.0, 0.5, 2.0, 3.0  # s; of its height; times the stiffness, twice
MEANT, LIGHT = 2.0, 0.05  # s and of the mass, below which it may be meant: a neck, an antenna
BEYOND, OTHERS = 20.0, 4  # times the kv over kp of the most damped of so many others
ABSURD = 1e4  # rad or m: no servo is so weak
SAG, WALKS = 0.3, 0.55  # rad of a hinge, m of a slide; rad where the robot is free and stands on its feet
LITTLE, SHARE = 0.085, 0.1  # rad of a hinge, share of the range of a slide, of which a hint tells
KEEN = 0.2  # of these, where the reader sees something sag
GOOD = {True: (0.02, 0.08, 0.2), False: (0.002, 0.008, 0.02)}  # rad or m that may be left, the best first


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Servos that sag, hinges and slides apart; those that are late."""
    simulation, found = model.simulation, sags(model.simulation)
    much = {each.actuator for each in _alone(simulation) if found[each.actuator] > _most(simulation, each)}
    for hinge in (True, False):
        weak = [each for each in _alone(simulation) if each.hinge == hinge and each.actuator in much]
        weak.sort(key=lambda each: -found[each.actuator])
        if not weak:
            continue
        worst, load, most = weak[0], loads(simulation), min(_most(simulation, each) for each in weak)
        for good in GOOD[hinge]:  # what holds still may be too stiff for the timestep
            edits = _stronger(model, {each: float(rounded(load[each.dof] / good)) for each in weak})
            if model.measured(resets(), edits) <= model.measured(resets()):
                break
        yield Suspect(
            tuple(simulation.name("actuator", each.actuator) for each in weak),
            "kp",
            f"{worst.stiffness:.3g}",
            rounded(load[worst.dof] / good),
            edits,
            sag([each.actuator for each in weak]),
            most,
            f"The weight at {simulation.name('joint', worst.joint)} is up to {load[worst.dof]:.3g} "
            f"{worst.force_unit}, and its servo gives {worst.stiffness:.3g} {worst.force_unit} for each {worst.unit}.",
            f"below {most:g} {worst.unit}; of healthy models with servos 0.29 is the most, 0.5 where the base is free",
            level="cause" if found[worst.actuator] < ABSURD else "hint",
        )
    yield from _bends(model, much)
    yield from _tips(model, much)
    yield from _late(model, much)
    yield from _little(model, {each: far for each, far in found.items() if each not in much})


def _alone(of: Simulation) -> list[Servo]:
    """The servos of joints that no motor drives as well, through which code may carry the weight."""
    motors = {of.driven_joint(each) for each in range(of.count("actuator")) if of.is_motor(each)}
    return [each for each in servos(of) if each.joint not in motors]


def _bends(model: ReaderModel, sagging: set[int]) -> Iterator[Suspect]:
    """Servos of legs that bend under the robot that stands on them."""
    of, seen = model.simulation, stance(model.simulation)
    bent = sorted((each for each in seen.bent if seen.bent[each] > BENT / 2), key=lambda each: -seen.bent[each])
    if not bent or seen.bent[bent[0]] <= BENT or seen.full or {each.actuator for each in bent} & sagging:
        return
    times = max(4.0, seen.bent[bent[0]] / 0.1)
    yield Suspect(
        tuple(of.name("actuator", each.actuator) for each in bent),
        "kp",
        f"{bent[0].stiffness:.3g}",
        rounded(times * bent[0].stiffness),
        _stronger(model, {each: times * each.stiffness for each in seen.bent}),
        goes_down(),
        LOST,
        f"Standing, {of.name('joint', bent[0].joint)} is {seen.bent[bent[0]]:.2g} rad off its target.",
        "next to nothing: a robot that stands",
    )


def _tips(model: ReaderModel, sagging: set[int]) -> Iterator[Suspect]:
    """Servos of a robot that stands for 1 s and has fallen after 5 s, as with twice the stiffness, not with thrice."""
    of, seen = model.simulation, stance(model.simulation)
    if sagging or not seen.bent or seen.lost > LOST / 2 or stance_after(of, LONG).lost < FALLEN:
        return
    own = list(seen.bent)
    least, edits = (_stronger(model, {each: more * each.stiffness for each in own}) for more in (NEARLY, STIFFER))
    falls = model.symptom == FAMILIES[0] or model.measured(goes_down(LONG), least) > LOST / 2
    if not (edits and falls) or model.measured(goes_down(LONG), edits) > LOST / 2:
        return
    names = tuple(of.name("actuator", each.actuator) for each in own)
    now, value = f"{own[0].stiffness:.3g}", rounded(STIFFER * own[0].stiffness)
    says = f"With all servos told to hold the start it stands for 1 s, and falls within {LONG:g} s."
    healthy = "a robot that stands"
    yield Suspect(names, "kp", now, value, edits, goes_down(LONG), LOST / 2, says, healthy, level="hint")


def _most(simulation: Simulation, servo: Servo) -> float:
    return WALKS if servo.hinge and _free(simulation, servo) else SAG


def _free(simulation: Simulation, servo: Servo) -> bool:
    root = root_of(simulation)[simulation.body_of("joint", servo.joint)]
    return root in simulation.free_bodies


def _little(model: ReaderModel, found: dict[int, float]) -> Iterator[Suspect]:
    """Hinges that sag visibly, and slides that sag by a good part of their range: hints."""
    of = model.simulation
    for hinge in (True, False):
        weak = [each for each in _alone(of) if each.hinge == hinge and each.actuator in found]
        weak = [each for each in weak if model.symptom == FAMILIES[0] or not _free(of, each)]
        part = KEEN if model.symptom == FAMILIES[0] else 1.0
        weak = [each for each in weak if found[each.actuator] > part * _allowed(each)]
        if not weak:
            continue
        worst = max(weak, key=lambda each: found[each.actuator] / _allowed(each))
        load, sagging, good = loads(of)[worst.dof], found[worst.actuator], part * _allowed(worst) / 4
        share = "" if hinge else f", {100 * SHARE * sagging / _allowed(worst):.2g} % of its range"
        yield Suspect(
            tuple(of.name("actuator", each.actuator) for each in weak),
            "kp",
            f"{worst.stiffness:.3g}",
            rounded(load / good),
            (),
            sag([each.actuator for each in weak]),
            4 * good,
            f"The weight at {of.name('joint', worst.joint)}, up to {load:.3g} {worst.force_unit}, moves it "
            f"{sagging:.2g} {worst.unit} off its target{share}, unless gravcomp takes the weight away.",
            f"below {part * LITTLE:g} rad, or {100 * part * SHARE:g} % of the range of a slide",
        )


def _allowed(servo: Servo) -> float:
    """The sag in rad or m above which a hint tells of it; none of a slide without a range, or of a long one."""
    if servo.hinge:
        return LITTLE
    return SHARE * (servo.range[1] - servo.range[0]) if servo.range else SAG


def _late(model: ReaderModel, sagging: set[int]) -> Iterator[Suspect]:
    """Servos that take far longer than a second for a small step, but for those that sag or are held back."""
    simulation, late = model.simulation, []
    for each in _alone(simulation):
        slow = each.hinge and each.stiffness < SLOW**2 * each.inertia
        slow |= each.damping > (LATE if each.hinge else CRAWLS) * each.stiffness
        slow = slow and each.actuator not in sagging and holds_back(simulation, each) != "damping"
        if slow and model.measured(remaining([each.actuator])) > LEFT:
            late.append(each)
    overdamped = [each for each in late if _overdamped(model, each)]
    yield from _prompt(model, overdamped)
    late = [each for each in late if each not in overdamped]
    if not late:
        return
    worst = max(late, key=_follows)
    stiffness = {each.actuator: max(20 * each.damping, 400 * each.inertia) for each in late}
    yield Suspect(
        tuple(simulation.name("actuator", each.actuator) for each in late),
        "kp",
        f"{worst.stiffness:.3g}",
        rounded(stiffness[worst.actuator]),
        _stronger(model, {each: stiffness[each.actuator] for each in late}, damped=True),
        remaining([each.actuator for each in late]),
        LEFT,
        f"Stiffness {worst.stiffness:.3g} against damping {worst.damping:.3g} and inertia {worst.inertia:.2g}: the "
        f"joint follows in {_follows(worst):.2g} s.",
        "0.5 s is the most of 55 healthy models with servos; 1.6 s of a humanoid's neck",
        level="hint" if _follows(worst) < MEANT and _light(simulation, late) else "cause",
    )


def _overdamped(model: ReaderModel, servo: Servo) -> float:
    """The kv that would be usual beside a servo's kp, where its own is many times that of all others; else 0."""
    of, kv = model.simulation, -model.simulation.bias(servo.actuator)[2]
    others = [each for each in _alone(of) if each.actuator != servo.actuator and _of_kv(of, each) > 0]
    times = sorted(_of_kv(of, each) for each in others)
    written = model.value("actuator", servo.actuator, "kv") is not None
    if not written or len(times) < OTHERS or _of_kv(of, servo) < BEYOND * times[-1]:
        return 0.0
    if servo.stiffness < min(each.stiffness for each in others) / 2:
        return 0.0  # its kp is what is unlike
    usual = times[len(times) // 2]
    return kv * usual / _of_kv(of, servo)


def _of_kv(of: Simulation, servo: Servo) -> float:
    """kv over kp in s."""
    _, stiffness, damping = of.bias(servo.actuator)[:3]
    return damping / stiffness if stiffness else 0.0


def _prompt(model: ReaderModel, some: Sequence[Servo]) -> Iterator[Suspect]:
    """The servos that are late by a kv of their own, with one that is usual beside their kp."""
    if not some:
        return
    of, worst = model.simulation, max(some, key=_follows)
    values = {each.actuator: rounded(_overdamped(model, each)) for each in some}
    now = f"{-of.bias(worst.actuator)[2]:.3g}"
    says = f"kv {now} over kp {worst.stiffness:.3g} lets it follow in {_of_kv(of, worst):.2g} s; of the other servos "
    says += f"none has more than 1/{BEYOND:g} of that."
    yield Suspect(
        tuple(of.name("actuator", each.actuator) for each in some),
        "kv",
        now,
        values[worst.actuator],
        model.set_each("actuator", "kv", values),
        remaining([each.actuator for each in some]),
        LEFT,
        says,
        "as the other servos of the model",
    )


def _follows(servo: Servo) -> float:
    """How long a joint takes to follow in s: by its damping, or half a period where that is small."""
    return max(servo.damping / servo.stiffness, math.pi * math.sqrt(servo.inertia / servo.stiffness))


def _light(of: Simulation, some: Sequence[Servo]) -> bool:
    """Whether all of some servos move next to nothing, as the neck of a humanoid does."""
    carried, bodies = of.model("body_subtreemass"), of.model("jnt_bodyid")
    return all(carried[int(bodies[each.joint])] < LIGHT * of.moving_mass for each in some)


def _stronger(model: ReaderModel, wanted: Mapping[Servo, float], *, damped: bool = False) -> tuple[Edit, ...]:
    """The edits that give servos a stiffness at the joint, and more damping unless they have enough."""
    of, values = model.simulation, dict[str, dict[int, str]]()
    for servo, stiffness in wanted.items():
        times, actuator = stiffness / servo.stiffness, servo.actuator
        more = 1.0 if damped else times**0.5
        element, gain, bias = model.element("actuator", actuator), of.gain(actuator)[0], of.bias(actuator)
        if element is not None and element.tag == "general":
            values.setdefault("gainprm", {})[actuator] = f"{gain * times:.3g}"
            held = f"{bias[0] * times:.3g} {bias[1] * times:.3g} {bias[2] * more:.3g}"
            values.setdefault("biasprm", {})[actuator] = held
        elif element is not None:
            values.setdefault("kp", {})[actuator] = f"{gain * times:.3g}"
            if model.value("actuator", actuator, "kv") is not None:
                values.setdefault("kv", {})[actuator] = f"{-bias[2] * more:.3g}"
    return tuple(edit for name, each in values.items() for edit in model.set_each("actuator", name, each))
