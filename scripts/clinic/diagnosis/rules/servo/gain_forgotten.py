"""A position servo's gain is MuJoCo's default of 1, among servos that have gains of their own.

`kp` is 1 unless somebody writes it. A class that gives it to one group of servos and not to another leaves those as
soft as 1 N m/rad (1 N/m of a slide).

Bad:

    <mujoco>
      <default>
        <default class="arm"><position kp="60" kv="3"/></default>
        <default class="head"><joint damping="0.1"/></default>
      </default>
      <worldbody>
        <body pos="0 0 1">
          <joint name="shoulder" axis="0 1 0" damping="1" armature="0.1"/>
          <geom type="capsule" fromto="0 0 0 0.1 0 0" size="0.02" mass="0.2"/>
          <body pos="0.1 0 0">
            <joint name="elbow" axis="0 1 0" damping="1" armature="0.1"/>
            <geom type="capsule" fromto="0 0 0 0.1 0 0" size="0.02" mass="0.1"/>
          </body>
        </body>
        <body pos="0 0 1.3">
          <joint name="neck" axis="0 0 1" damping="1" armature="0.1"/>
          <geom size="0.1" mass="3"/>
        </body>
      </worldbody>
      <actuator>
        <position joint="shoulder" class="arm"/>
        <position joint="elbow" class="arm"/>
        <position joint="neck" class="head"/>
      </actuator>
    </mujoco>

Good:

    -     <default class="head"><joint damping="0.1"/></default>
    +     <default class="head"><position kp="60" kv="3"/></default>

The number: how many `<position>` have no `kp`, neither themselves nor by their class, where as many others and more
have one. Where none has one, those that a kp of 1 lets swing at less than 3 rad/s: half a swing takes a second and
more; or else those that friction may hold more than 5 % of their joint's range short of their target.

When it is wrong: a servo for which 1 N m/rad is enough.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.probes.servo import servo_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, counted, rounded

TITLE = "A servo without a gain among others that have one"
FAMILIES = ("sags", "stuck", "oscillates")
UNPLANTED = "a gain that is as small as the default is planted as a weak servo"

SLOW = 3.0  # rad/s
SHORT = 0.05  # of the joint's range


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The position servos that nobody gave a gain, all together."""
    of = model.simulation
    told = [i for i in range(of.count("actuator")) if (e := model.element("actuator", i)) and e.tag == "position"]
    bare = [each for each in told if model.value("actuator", each, "kp") is None and of.gain(each)[0] == 1]
    tuned = [each for each in told if each not in bare]
    if not tuned:
        yield from _none(model, bare)
    if not bare or len(tuned) < max(2, len(bare)):
        return
    gains = sorted(float(model.value("actuator", each, "kp") or 1) for each in tuned)
    usual = gains[len(gains) // 2]
    if usual == 1:
        return
    probe = counted("position servos without a gain of their own", len(bare))
    says = f"No kp is written for it, so that it is 1; the median of the {len(tuned)} others is {usual:g}."
    names = tuple(of.name("actuator", each) for each in bare)
    edits = model.set("actuator", bare, "kp", f"{usual:g}")
    yield Suspect(names, "kp", "left out", f"{usual:g}", edits, probe, 0, says, "a gain by its load", level="hint")


def _none(model: ReaderModel, bare: list[int]) -> Iterator[Suspect]:
    """Servos of a model in which nobody wrote a gain, where that of 1 is slow."""
    of = model.simulation
    slow = [each for each in bare if 0 < _swing(of, each) < SLOW]
    if not slow:
        yield from _held(model, bare)
        return
    worst = min(slow, key=lambda each: _swing(of, each))
    says = f"No kp is written for it, so that it is 1: {of.name('joint', of.driven_joint(worst) or 0)} swings at "
    says += f"{_swing(of, worst):.2g} rad/s by it."
    value = rounded((2 * SLOW / _swing(of, worst)) ** 2)
    probe = Probe("seconds of a radian at a gain of 1", "s", _seconds, (worst,), dynamic=False)
    names = tuple(of.name("actuator", each) for each in slow)
    edits = model.set("actuator", slow, "kp", value)
    yield Suspect(names, "kp", "left out", value, edits, probe, 1 / SLOW, says, "a gain by its load", level="hint")


def _held(model: ReaderModel, bare: list[int]) -> Iterator[Suspect]:
    """The same where friction holds a joint far from its target."""
    of = model.simulation
    held = [each for each in bare if _stops(of, each) > SHORT]
    if not held:
        return
    worst = max(held, key=lambda each: _stops(of, each))
    joint = of.name("joint", of.driven_joint(worst) or 0)
    says = f"No kp is written for it, so that it is 1: by its frictionloss {joint} may stop "
    says += f"{100 * _stops(of, worst):.2g} % of its range short of its target."
    value = rounded(10 * _stops(of, worst) / SHORT)
    probe = Probe("how far short a servo may stop", "of the joint's range", _stops, (worst,), dynamic=False)
    names, edits = tuple(of.name("actuator", each) for each in held), model.set("actuator", held, "kp", value)
    yield Suspect(names, "kp", "left out", value, edits, probe, SHORT, says, "a gain by its load", level="hint")


def _stops(of: Simulation, actuator: int) -> float:
    """How far from its target a servo's joint may be held by its friction, as a share of its range."""
    servo = servo_of(of, actuator)
    if servo is None or servo.range is None or servo.range[1] <= servo.range[0]:
        return 0.0
    return of.model("dof_frictionloss")[servo.dof] / servo.stiffness / (servo.range[1] - servo.range[0])


def _swing(of: Simulation, actuator: int) -> float:
    """The frequency in rad/s of a joint on its servo; 0 for an actuator of something else."""
    servo = servo_of(of, actuator)
    return math.sqrt(servo.stiffness / servo.inertia) if servo else 0.0


def _seconds(of: Simulation, actuator: int) -> float:
    return 1 / max(_swing(of, actuator), 1e-9)
