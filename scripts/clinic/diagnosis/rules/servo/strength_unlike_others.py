"""One actuator is far stronger, or far weaker, than all others of its mechanism.

A `gear` that lost its point, a `kp` of another unit: the one joint throws the robot about, or hangs.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="hip" axis="0 1 0" damping="0.1"/>
          <geom type="capsule" size="0.03" fromto="0 0 0 0 0 -0.3"/>
          <body pos="0 0 -0.3">
            <joint name="knee" axis="0 1 0" damping="0.1"/>
            <geom type="capsule" size="0.03" fromto="0 0 0 0 0 -0.3"/>
            <body pos="0 0 -0.3">
              <joint name="ankle" axis="0 1 0" damping="0.1"/>
              <geom type="capsule" size="0.03" fromto="-0.05 0 0 0.1 0 0"/>
              <body pos="0.1 0 0">
                <joint name="toe" axis="0 1 0" damping="0.1"/>
                <geom type="capsule" size="0.02" fromto="0 0 0 0.05 0 0"/>
              </body>
            </body>
          </body>
        </body>
      </worldbody>
      <actuator>
        <motor name="hip" joint="hip" gear="120" ctrlrange="-1 1"/>
        <motor name="knee" joint="knee" gear="0.9" ctrlrange="-1 1"/>
        <motor name="ankle" joint="ankle" gear="60" ctrlrange="-1 1"/>
        <motor name="toe" joint="toe" gear="20" ctrlrange="-1 1"/>
      </actuator>
    </mujoco>

Good:

    -     <motor name="knee" joint="knee" gear="0.9" ctrlrange="-1 1"/>
    +     <motor name="knee" joint="knee" gear="90" ctrlrange="-1 1"/>

The number: a motor's force at full control, a position servo's stiffness, or the end of a force range over the greatest
of the others, or the least of them over it; more than 8, where three others or more drive joints of the same type. Of
the bench's healthy models the most is 5. A weak one that carries less than 2 % of the mass is a gripper's, and left
alone. Of muscles, two or more, more than 20 times: of 20 healthy models with up to 210 muscles the most is 2.

When it is wrong: a gripper's motor beside those of an arm, or a neck's beside those of legs.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.engine import DYN_MUSCLE
from clinic.diagnosis.probes.servo import servos, speed_gain
from clinic.diagnosis.probes.shape import root_of
from clinic.diagnosis.probes.siblings import of_a_row
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "An actuator far stronger or weaker than all others"
FAMILIES = ("stuck", "sags", "explodes", "drifts")
LEVEL = "hint"

MOST, LEAST = 8.0, 4  # times; actuators of one kind
MOST_MUSCLE, LEAST_MUSCLES = 20.0, 2
LIGHT = 0.02  # of the mechanism's mass: a gripper
WRIST = 30.0  # times that what carries all others, in two branches or more, may be stronger
FORCE, STIFFNESS, LIMIT, SPEED = "force at full control", "stiffness", "greatest force", "gain of the speed"
PEAK = "peak force"
INSIDE = {("motor", FORCE): "gear", ("position", STIFFNESS): "kp", ("velocity", SPEED): "kv", ("muscle", PEAK): "force"}

Key = tuple[str, int, int]  # what is compared, a mechanism, and a type of joint


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The strongest and the weakest of each mechanism, where they stand apart."""
    of = model.simulation
    for key, strengths in _groups(of).items():
        ranked = sorted(strengths, key=lambda each: strengths[each])
        most = MOST_MUSCLE if key[0] == PEAK else MOST
        for odd, next_to in ((ranked[-1], ranked[-2]), (ranked[0], ranked[1]))[len(ranked) == 2 :]:
            times = _times(of, key, odd, next_to)
            carries = odd == ranked[-1] and times < WRIST and key[0] != PEAK and _above(of, odd, ranked)
            light = odd == ranked[0] and _carried(of, odd) < LIGHT
            if times <= most or math.isinf(strengths[odd]) or carries or light:
                continue
            which = "the most" if odd == ranked[-1] else "the least"
            says = f"Its {key[0]} is {strengths[odd]:.3g}; "
            has = f"{of.name('actuator', next_to)} has {which}, {strengths[next_to]:.3g}."
            others = f"{len(ranked) - 1} others"
            if len(ranked) == 2:
                says += f"that of {of.name('actuator', next_to)} is {strengths[next_to]:.3g}."
            else:
                says += (
                    f"of the {others} {has}" if math.isfinite(strengths[next_to]) else f"the {others} have no limit."
                )
            probe = Probe(f"{key[0]} unlike that of the next by", "times", _times, (key, odd, next_to), dynamic=False)
            element = model.element("actuator", odd)
            attribute = "forcerange" if key[0] == LIMIT else INSIDE.get((element.tag if element else "", key[0]), "")
            now, value = (model.value("actuator", each, attribute) or "" for each in (odd, next_to))
            if key[0] == PEAK and now and value:
                value = f"{float(now) * 10.0 ** round(math.log10(strengths[next_to] / strengths[odd])):g}"
            edits = model.set("actuator", [odd], attribute, value) if now and value else ()
            name = of.name("actuator", odd)
            yield Suspect((name,), attribute, now, value, edits, probe, most, says, f"up to {most:g} times", at=element)


def _above(of: Simulation, odd: int, all_of_them: list[int]) -> bool:
    """Whether all other joints hang on that of an actuator, as fingers on a wrist."""
    bodies = of.model("jnt_bodyid")
    own, *others = (
        int(bodies[joint])
        for each in [odd, *(each for each in all_of_them if each != odd)]
        if (joint := of.driven_joint(each)) is not None
    )
    branches = {lines[lines.index(own) - 1] for body in others if own in (lines := of.ancestors(body)) and body != own}
    return len(branches) > 1 and all(own in of.ancestors(body) for body in others)


def _carried(of: Simulation, actuator: int) -> float:
    """The share of its mechanism's mass that a joint carries."""
    joint, masses = of.driven_joint(actuator), of.model("body_subtreemass")
    body = 0 if joint is None else of.body_of("joint", joint)
    return masses[body] / max(masses[root_of(of)[body]], 1e-12)


def _times(of: Simulation, key: Key, one: int, other: int) -> float:
    group = _groups(of).get(key, {})
    strengths = sorted(group.get(each, 1.0) for each in (one, other))
    return strengths[1] / max(strengths[0], 1e-12)


@kept
def _groups(of: Simulation) -> dict[Key, dict[int, float]]:
    """The stiffness of servos, the force of motors at full control, and what limits either, by actuator."""
    made: dict[Key, dict[int, float]] = {}
    owner, bodies, stiff = root_of(of), of.model("jnt_bodyid"), {each.actuator: each.stiffness for each in servos(of)}
    owners = [owner[int(body)] for body in bodies]
    for joint, like in enumerate(of_a_row(of)):  # rollers of a belt, each by itself
        if owners.count(owners[joint]) == 1:
            owners[joint] = -1 - like
    for actuator in range(of.count("actuator")):
        driven, gear = of.driven_joint(actuator), abs(of.gear(actuator))
        dynamic = int(of.model("actuator_dyntype")[actuator])
        if dynamic == DYN_MUSCLE and (peak := gear * of.gain(actuator)[2]) > 0:  # below 0 it follows from the inertia
            made.setdefault((PEAK, -1, int(of.model("actuator_trntype")[actuator])), {})[actuator] = peak
        if driven is None or not gear or dynamic == DYN_MUSCLE:
            continue
        among = owners[driven], of.joint_type(driven)
        limited = of.model("actuator_forcelimited")[actuator]
        most = gear * max(map(abs, of.row("actuator_forcerange", actuator, 2))) if limited else math.inf
        made.setdefault((LIMIT, *among), {})[actuator] = most
        low, high = of.row("actuator_ctrlrange", actuator, 2)
        full = max(abs(low), abs(high)) if of.model("actuator_ctrllimited")[actuator] else 1.0
        force = abs(of.gain(actuator)[0]) * gear * full
        if actuator in stiff:
            made.setdefault((STIFFNESS, *among), {})[actuator] = stiff[actuator]
        elif gain := speed_gain(of, actuator):
            made.setdefault((SPEED, *among), {})[actuator] = gain * gear**2
        elif force and not dynamic and not int(of.model("actuator_biastype")[actuator]):
            made.setdefault((FORCE, *among), {})[actuator] = force
    return {key: each for key, each in made.items() if len(each) >= (LEAST_MUSCLES if key[0] == PEAK else LEAST)}
