"""A crank cannot turn round, for the range of another joint of its loop stops it.

The crank has no range and a motor that drives it by speed, so it is to turn. What it moves swings to and fro, and has a
range that is narrower than its swing: the crank is thrown back, or stands with all of its motor's force on the stop.

Bad:

    <mujoco>
      <default>
        <geom contype="0" conaffinity="0"/>
        <joint axis="0 1 0" damping="0.01" armature="0.001"/>
      </default>
      <worldbody>
        <body name="crank" pos="0 0 0.3">
          <joint name="crank"/>
          <geom type="capsule" size="0.01" fromto="0 0 0 0 0 0.1"/>
          <body name="coupler" pos="0 0 0.1">
            <joint name="pin"/>
            <geom type="capsule" size="0.01" fromto="0 0 0 0.25 0 0.1"/>
          </body>
        </body>
        <body name="rocker" pos="0.25 0 0.3">
          <joint name="rocker" range="-10 10"/>
          <geom type="capsule" size="0.01" fromto="0 0 0 0 0 0.2"/>
        </body>
      </worldbody>
      <equality>
        <connect body1="coupler" body2="rocker" anchor="0.25 0 0.1" solref="0.005 1"/>
      </equality>
      <actuator>
        <velocity joint="crank" kv="2" ctrlrange="-10 10" forcerange="-3 3"/>
      </actuator>
    </mujoco>

Good:

    -       <joint name="rocker" range="-10 10"/>
    +       <joint name="rocker" range="-70 70"/>

The number: of one turn, the share that a hinge without a range does not make, driven at full speed for as long as a
turn and a half takes; more than 0.05, where a joint without a motor ends at the end of its range, and the crank turns
round without that. Something below the crank is connected or welded to something else.

When it is wrong: a lever that needs no whole turn.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.probes.equalities import CONNECT, WELD, held, kind_of, sited
from clinic.diagnosis.probes.servo import speed_gain
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A crank that a range in its loop stops"
FAMILIES = ("stuck", "drifts")
LEVEL = "hint"
UNPLANTED = "no healthy model of the bench has a crank in a loop"

SHORT, TURNS, NEAR, MARGIN = 0.05, 1.5, 0.05, 0.05  # of a turn; turns; of the range; of the swing


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each crank that another joint's range stops."""
    of = model.simulation
    for actuator, crank in _cranks(of).items():
        probe = Probe("share of a turn that a crank does not make", "", _missing, (actuator, crank))
        for joint in _at_the_end(of, actuator, crank) if model.measured(probe) > SHORT else ():
            free = model.with_edits(model.set("joint", [joint], "limited", "false"))
            if not isinstance(free, Simulation) or _missing(free, actuator, crank) > SHORT:
                continue
            swing = [each[joint] for each in _turned(free, actuator, crank)]
            unit = 1 if of.unit(joint) == "m" else model.angle_unit
            more = MARGIN * (max(swing) - min(swing))
            value = f"{(min(swing) - more) / unit:.3g} {(max(swing) + more) / unit:.3g}"
            now, edits = model.value("joint", joint, "range") or "", model.set("joint", [joint], "range", value)
            names = of.name("joint", joint), of.name("joint", crank)
            says = (
                f"{names[1]} has no range and is driven by speed, and makes {1 - model.measured(probe):.2g} of a turn "
            )
            says += f"until {names[0]} is at the end of its range; without that it turns round."
            yield Suspect(names, "range", now, value, edits, probe, SHORT, says, "as wide as it swings")


@kept
def _cranks(of: Simulation) -> dict[int, int]:
    """The hinges without a range that velocity servos drive, by actuator, of which something below is tied."""
    made = {}
    for actuator in range(of.count("actuator")):
        joint = of.driven_joint(actuator)
        if joint is None or not speed_gain(of, actuator) or not of.model("actuator_ctrllimited")[actuator]:
            continue
        if (
            of.joint_type(joint) == HINGE
            and joint not in of.ranges
            and _tied(of) & {*of.below(of.body_of("joint", joint))}
        ):
            made[actuator] = joint
    return made


@kept
def _tied(of: Simulation) -> set[int]:
    """The bodies that connections and welds hold."""
    every = [each for each, on in enumerate(of.model("eq_active0")) if on and kind_of(of, each) in (CONNECT, WELD)]
    return {of.body_of("site", end) if sited(of, each) else end for each in every for end in held(of, each)}


@kept
def _turned(of: Simulation, actuator: int, crank: int) -> list[dict[int, float]]:
    """Where all hinges and slides are while a crank is driven at full speed."""
    ends = of.row("actuator_ctrlrange", actuator, 2)
    full = max(ends, key=abs)
    speed = abs(of.gain(actuator)[0] * full / (speed_gain(of, actuator) * of.gear(actuator) or 1.0))
    of.begin()
    of.engine.write("ctrl", [full], actuator)
    made = [{joint: of.position(joint) for joint in of.scalar_joints}]
    for _ in of.run(TURNS * 2 * math.pi / speed if speed else 0.0, samples=100):
        made.append({joint: of.position(joint) for joint in of.scalar_joints})
        if of.unstable():
            break
    return made


def _missing(of: Simulation, actuator: int, crank: int) -> float:
    """What is left of a turn at the furthest; 1 where the crank cannot be driven."""
    way = [each[crank] for each in _turned(of, actuator, crank)]
    return max(0.0, 1 - max(abs(each - way[0]) for each in way) / (2 * math.pi))


def _at_the_end(of: Simulation, actuator: int, crank: int) -> list[int]:
    """The joints without a motor that end at an end of their range while a crank is driven."""
    last, made = _turned(of, actuator, crank)[-1], list[int]()
    for joint, (low, high) in of.ranges.items():
        near = NEAR * (high - low)
        if joint not in of.drivers and not low + near < last[joint] < high - near:
            made.append(joint)
    return made
