"""One actuator is far stronger, or far weaker, than all others of its mechanism.

A `gear` that lost its point, a `kp` of another unit: the one joint throws the robot about, or hangs.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="hip" axis="0 1 0" damping="1"/>
          <geom type="capsule" size="0.03" fromto="0 0 0 0 0 -0.3"/>
          <body pos="0 0 -0.3">
            <joint name="knee" axis="0 1 0" damping="1"/>
            <geom type="capsule" size="0.03" fromto="0 0 0 0 0 -0.3"/>
            <body pos="0 0 -0.3">
              <joint name="ankle" axis="0 1 0" damping="1"/>
              <geom type="capsule" size="0.03" fromto="-0.05 0 0 0.1 0 0"/>
              <body pos="0.1 0 0">
                <joint name="toe" axis="0 1 0" damping="1"/>
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

The number: a motor's force at full control, or a position servo's stiffness, over the greatest of the others, or the
least of them over it; more than 8, where three others or more drive joints of the same type. Of 234 models of others
the most is 5.

When it is wrong: a gripper's motor beside those of an arm, or a neck's beside those of legs.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.servo import servos
from clinic.diagnosis.probes.shape import root_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "An actuator far stronger or weaker than all others"
FAMILIES = ("stuck", "sags", "explodes", "drifts")
SINCE = "0.1"
LEVEL = "hint"

MOST, LEAST = 8.0, 4  # times; actuators of one kind
INSIDE = {"motor": "gear", "position": "kp"}


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The strongest and the weakest of each mechanism, where they stand apart."""
    of = model.simulation
    for (servo, _, _), strengths in _groups(of).items():
        ranked = sorted(strengths, key=lambda each: strengths[each])
        for odd, next_to in ((ranked[-1], ranked[-2]), (ranked[0], ranked[1])):
            if _times(of, odd, next_to) <= MOST:
                continue
            what = "Its stiffness is" if servo else "At full control it gives"
            which = "most" if odd == ranked[-1] else "least"
            says = f"{what} {strengths[odd]:.3g}; of the {len(ranked) - 1} others {of.name('actuator', next_to)} "
            says += f"has {which}, {strengths[next_to]:.3g}."
            probe = Probe(
                "strength unlike that of the next actuator by", "times", _times, (odd, next_to), dynamic=False
            )
            element = model.element("actuator", odd)
            attribute = INSIDE.get(element.tag if element else "", "")
            now, value = (model.value("actuator", each, attribute) or "" for each in (odd, next_to))
            edits = model.set("actuator", [odd], attribute, value) if attribute and now and value else ()
            name = of.name("actuator", odd)
            yield Suspect((name,), attribute, now, value, edits, probe, MOST, says, f"up to {MOST:g} times", at=element)


def _times(of: Simulation, one: int, other: int) -> float:
    strengths = [strength for group in _groups(of).values() for each, strength in group.items() if each in (one, other)]
    return max(strengths) / max(min(strengths), 1e-12) if len(strengths) > 1 else 1.0


def _groups(of: Simulation) -> dict[tuple[bool, int, int], dict[int, float]]:
    """The stiffness of servos, and the force of motors at full control, by mechanism and type of joint."""
    made: dict[tuple[bool, int, int], dict[int, float]] = {}
    owner, bodies = root_of(of), of.model("jnt_bodyid")
    for servo in servos(of):
        key = (True, owner[int(bodies[servo.joint])], of.joint_type(servo.joint))
        made.setdefault(key, {})[servo.actuator] = servo.stiffness
    for actuator in range(of.count("actuator")):
        joint = of.driven_joint(actuator)
        plain = not int(of.model("actuator_biastype")[actuator]) and not int(of.model("actuator_dyntype")[actuator])
        if (
            joint is None
            or not plain
            or not (gain := abs(of.gain(actuator)[0] * of.model("actuator_gear")[6 * actuator]))
        ):
            continue
        low, high = of.row("actuator_ctrlrange", actuator, 2)
        full = max(abs(low), abs(high)) if of.model("actuator_ctrllimited")[actuator] else 1.0
        made.setdefault((False, owner[int(bodies[joint])], of.joint_type(joint)), {})[actuator] = gain * full
    return {key: each for key, each in made.items() if len(each) >= LEAST}
