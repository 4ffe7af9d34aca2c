"""An undamped position servo rings.

A position servo is a spring. Without damping, its own (`kv`, `dampratio`) or the joint's, what it drives swings about
each target for ever.

Bad:

    <mujoco>
      <worldbody>
        <body>
          <joint name="hinge" axis="0 0 1"/>
          <geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.02" mass="1"/>
        </body>
      </worldbody>
      <actuator>
        <position joint="hinge" kp="100"/>
      </actuator>
    </mujoco>

Good:

    -     <position joint="hinge" kp="100"/>
    +     <position joint="hinge" kp="100" dampratio="1"/>

The number: a damping ratio under 0.08, and a step of 0.1 rad (0.01 m for a slide), without gravity and contacts, that
overshoots by more than 22 % and crosses its target five times. With a damping ratio z the overshoot of one joint alone
is exp(-pi z / sqrt(1 - z^2)), 0.78 for 0.08; neighbours take up some of it. A joint whose `frictionloss` holds the step
is left alone.

Legs of healthy robots go down to 0.1. Servos whose twins have the same gains and more of it are a hint: what they move
is unlike. Where a model rattles from step to step too, and a tenth or a hundredth of `kp` mends both, that is told.
A hint tells of servos of tendons that, stepped by 1 % of the length while the others hold theirs, still swing by a
quarter of the step after 1.5 s. With `--symptom oscillates` a damping ratio under 0.5 and an overshoot of more than
12 % are told too, as a hint.

When it is wrong: friction that the model leaves to contacts, or a controller that adds the damping.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.probes.servo import COEFFICIENTS, STEP, Servo, overshoot, servos
from clinic.diagnosis.probes.shake import SHAKES, shake
from clinic.diagnosis.probes.sides import sided
from clinic.diagnosis.probes.tendons import swings_on, winches
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect

TITLE = "An undamped servo rings"
FAMILIES = ("oscillates", "explodes")
CASE = "servo-oscillates"

WELL = "a damping ratio of 0.7 to 1 (MuJoCo's manual, dampratio)"
RATIO, OVERSHOOT, UNLIKE = 0.08, 0.22, 1.5
SWINGS, KV = 0.25, (0.02, 0.05, 0.1, 0.2)  # of the step; kv over kp in s
KEEN_RATIO, KEEN_OVERSHOOT = 0.5, 0.12  # where the reader sees something oscillate


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Servos with a low damping ratio that ring, all together; and those of tendons."""
    yield from _of_joints(model)
    yield from _of_tendons(model)


def _of_tendons(model: ReaderModel) -> Iterator[Suspect]:
    """Servos that pull tendons and go on swinging, with the least kv that ends it."""
    of = model.simulation
    found = [each for each in winches(of) if model.measured(swings_on([each])) > SWINGS]
    for share in KV if found else ():
        values = {each: share * -of.bias(each)[1] for each in found}
        edits = tuple(edit for each, kv in values.items() for edit in _with_kv(model, each, kv))
        if edits and model.measured(swings_on(found), edits) <= SWINGS:
            says = f"A step of 1 % of its tendon's length still swings after 1.5 s: kp {-of.bias(found[0])[1]:g}, "
            says += f"and kv {abs(of.bias(found[0])[2]):g}."
            names, now, value = tuple(of.name("actuator", each) for each in found), "0", f"{values[found[0]]:.3g}"
            probe = swings_on(found)
            yield Suspect(names, "kv", now, value, edits, probe, SWINGS, says, WELL, level="hint")
            return


def _with_kv(model: ReaderModel, actuator: int, kv: float) -> tuple[Edit, ...]:
    """The edit that gives a servo a kv, in the way in which it is written."""
    written, bias = model.element("actuator", actuator), model.simulation.bias(actuator)
    if written is not None and written.tag == "general":
        return model.set("actuator", [actuator], "biasprm", f"{bias[0]:g} {bias[1]:g} {-kv:.3g}")
    return model.set("actuator", [actuator], "kv", f"{kv:.3g}")


def _of_joints(model: ReaderModel) -> Iterator[Suspect]:
    of = model.simulation
    found, most = _ringing(model, RATIO, OVERSHOOT), OVERSHOOT
    keen = not found and model.symptom == FAMILIES[0]
    if keen:
        found, most = _ringing(model, KEEN_RATIO, KEEN_OVERSHOOT), KEEN_OVERSHOOT
    if not found:
        return
    worst = next(iter(found))
    if (weaker := _weaker(model, found)) is not None:
        yield weaker
        return
    stiff, damps, mass = COEFFICIENTS[worst.unit]
    yield Suspect(
        tuple(of.name("actuator", each.actuator) for each in found),
        "dampratio",
        f"{max(0, worst.ratio):.2g}",
        "1",
        tuple(edit for edits in found.values() for edit in edits),
        overshoot(tuple(each.actuator for each in found)),
        most,
        f"Stiffness {worst.stiffness:.3g} {stiff} and damping {worst.damping:.3g} {damps} on an inertia of "
        f"{worst.inertia:.2g} {mass} are a damping ratio of {worst.ratio:.2g}.",
        WELL,
        level="hint" if keen or all(_loaded(model, each) for each in found) else "cause",
    )


def _ringing(model: ReaderModel, ratio: float, most: float) -> dict[Servo, tuple[Edit, ...]]:
    """The servos with a damping ratio below one that overshoot by more than `most`, worst first, and their edits."""
    of = model.simulation
    dry = of.model("dof_frictionloss")  # what holds the whole step damps it as well
    free = [each for each in servos(of) if dry[each.dof] < each.stiffness * STEP[each.hinge]]
    low = sorted((each for each in free if each.ratio < ratio), key=lambda each: each.ratio)
    found = [each for each in low[:16] if model.measured(overshoot([each.actuator])) > most]
    edits = {each: _damped(model, each) for each in found}
    whole = tuple(edit for each in found for edit in edits[each])
    mended = [each for each in found if model.measured(overshoot([each.actuator]), whole) <= most]
    return {each: edits[each] for each in mended or found}  # a clipped force that throws to and fro is not mended so


def _loaded(model: ReaderModel, servo: Servo) -> bool:
    """Whether a servo's twin, with the same gains, does not ring: what it moves is unlike, be it by a fault."""
    of = model.simulation
    twin = sided(of, "actuator").get(servo.actuator)
    alike = [each for each in servos(of) if twin and each.actuator == twin[1] and each.ratio > UNLIKE * servo.ratio]
    return any(
        math.isclose(servo.stiffness, each.stiffness) and math.isclose(servo.damping, each.damping) for each in alike
    )


def _weaker(model: ReaderModel, found: Collection[Servo]) -> Suspect | None:
    """Servos with damping of their own whose stiffness is too much for the timestep too: a part of it that does."""
    of, worst = model.simulation, next(iter(found)).actuator
    gain, damping = (model.value("actuator", worst, name) or "" for name in ("kp", "kv"))
    if model.measured(shake()) <= SHAKES or not gain or not damping or not float(damping):
        return None
    giver = model.giver("actuator", [worst], "kp")
    numbers = [each for each in range(of.count("actuator")) if giver and model.giver("actuator", [each], "kp") is giver]
    numbers = numbers or [worst]
    probe, rings = overshoot(tuple(numbers)), overshoot(tuple(each.actuator for each in found))
    for less in (10, 100):
        value = f"{float(gain) / less:.3g}"
        edits = model.set("actuator", numbers, "kp", value)
        if edits and model.measured(rings, edits) <= OVERSHOOT and model.measured(shake(), edits) <= SHAKES:
            names = tuple(of.name("actuator", each) for each in numbers)
            says = (
                f"It rings, and rattles from step to step: its damping and the timestep would do for a kp of {value}."
            )
            return Suspect(names, "kp", gain, value, edits, probe, OVERSHOOT, says, WELL)
    return None


def _damped(model: ReaderModel, servo: Servo) -> tuple[Edit, ...]:
    """The edit that damps a servo critically, in the way in which it is written."""
    written, kinds = model.element("actuator", servo.actuator), [servo.actuator]
    if written is None:
        joint = model.element("joint", servo.joint)
        value = 2 * math.sqrt(servo.stiffness * servo.inertia)
        return model.set("joint", [servo.joint], "damping", f"{value:.3g}") if joint is not None else ()
    gear = model.simulation.gear(servo.actuator)
    value = 2 * math.sqrt(servo.stiffness * servo.inertia) / gear**2
    if written.tag == "general" or model.value("actuator", servo.actuator, "kv") is not None:
        return _with_kv(model, servo.actuator, value)
    return model.set("actuator", kinds, "dampratio", "1")
