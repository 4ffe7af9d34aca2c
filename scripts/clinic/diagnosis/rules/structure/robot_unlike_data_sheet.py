"""A robot that is called as one that is sold, and has another weight, or joints of another strength or range.

Most joints of the model are as the maker describes them, and a few are not: the calf's torque was given to the thigh,
digits changed places. A policy that is trained with it asks of the real robot what it cannot do.

Bad:

    <mujoco model="go2">
      <default>
        <geom type="capsule" fromto="0 0 0 0 0 -0.2" size="0.02" mass="1"/>
      </default>
      <worldbody>
        <body name="base" pos="0 0 0.4">
          <freejoint/>
          <geom type="box" fromto="-0.2 0 0 0.2 0 0" size="0.05" mass="7"/>
          <body name="FL_hip" pos="0.2 0.05 0">
            <joint name="FL_hip_joint" axis="1 0 0" range="-60 60"/>
            <geom/>
            <body name="FL_thigh" pos="0 0.1 0">
              <joint name="FL_thigh_joint" axis="0 1 0" range="-90 200"/>
              <geom/>
              <body name="FL_calf" pos="0 0 -0.2">
                <joint name="FL_calf_joint" axis="0 1 0" range="-156 -48"/>
                <geom/>
              </body>
            </body>
          </body>
          <body name="RL_hip" pos="-0.2 0.05 0">
            <joint name="RL_hip_joint" axis="1 0 0" range="-60 60"/>
            <geom/>
            <body name="RL_thigh" pos="0 0.1 0">
              <joint name="RL_thigh_joint" axis="0 1 0" range="-30 260"/>
              <geom/>
              <body name="RL_calf" pos="0 0 -0.2">
                <joint name="RL_calf_joint" axis="0 1 0" range="-156 -48"/>
                <geom/>
              </body>
            </body>
          </body>
        </body>
      </worldbody>
      <actuator>
        <motor joint="FL_hip_joint" ctrlrange="-23.7 23.7"/>
        <motor joint="FL_thigh_joint" ctrlrange="-45.43 45.43"/>
        <motor joint="FL_calf_joint" ctrlrange="-45.43 45.43"/>
        <motor joint="RL_hip_joint" ctrlrange="-23.7 23.7"/>
        <motor joint="RL_thigh_joint" ctrlrange="-23.7 23.7"/>
        <motor joint="RL_calf_joint" ctrlrange="-45.43 45.43"/>
      </actuator>
    </mujoco>

Good:

    -     <motor joint="FL_thigh_joint" ctrlrange="-45.43 45.43"/>
    +     <motor joint="FL_thigh_joint" ctrlrange="-23.7 23.7"/>

The number: by how much the largest force on a joint is off that of the data sheet, more than 5 %, where a third of the
joints with a limit have theirs; by how many degrees an end of a range is elsewhere, more than 3, where two thirds have
theirs; and, of such a robot, how many times the whole of it weighs what it should, or the other way round, more than
1.5. Four joints at least must agree. The numbers are from the makers' own descriptions, for the robots in
`probes/robots.toml`; of releases that differ, one.

When it is wrong: a model of another release of the robot, one that leaves some strength in reserve, or one with a load.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Sequence

from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.probes.robots import Joint, Robot, limit_of, nearest_range, robot_in
from clinic.diagnosis.probes.shape import root_of
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.structure.arm_unlike_data_sheet import names_in
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A robot unlike the data sheet of its name"
FAMILIES = ("wrong-numbers", "stuck", "passes-limit", "wrong-mass")
AFLOAT = True
UNPLANTED = "few of the models of the bench are robots that are sold"

STRONGER, STRONG = 0.05, 1 / 3  # of the effort; the share of the joints that have theirs
ELSEWHERE, SAME, WIDE = math.radians(3), math.radians(0.6), 2 / 3  # of an end of a range; the share that have theirs
HEAVY = 1.5  # times the mass
METRE = 0.05  # of a slide counts like a radian
FEWEST = 4  # joints that agree


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The joints of a robot by that name that are unlike most others of it."""
    of = model.simulation
    found = robot_in(of, names_in(model))
    if found is None:
        return
    robot, joints = found
    ranges = _ranged(of, joints)
    alike = sum(_elsewhere(of, joint, right) < SAME for joint, right in ranges.items())
    is_it = alike >= max(FEWEST, WIDE * len(ranges))
    if is_it:
        yield from _mass(model, robot, joints)
    yield from _efforts(model, robot, joints)
    if is_it:
        yield from _ranges(model, robot, ranges, alike)


def _mass(model: ReaderModel, robot: Robot, joints: dict[int, list[Joint]]) -> Iterator[Suspect]:
    of, bodies = model.simulation, model.simulation.model("jnt_bodyid")
    tops = tuple(dict.fromkeys(root_of(of)[int(bodies[joint])] for joint in joints))
    kinds = {line.pattern for line in robot.joints}
    whole = 2 * len({line.pattern for lines in joints.values() for line in lines}) >= len(kinds)
    if not robot.mass or not whole or len(tops) != 1 or _heavy(of, tops[0], robot.mass) <= HEAVY:
        return
    now, value = f"{_weight(of, tops[0]):.3g} kg", f"{robot.mass:.3g} kg"
    says = f"It weighs {now}, and {robot.names[0]} weighs {value}."
    probe = Probe("mass, unlike the data sheet's by", "times", _heavy, (tops[0], robot.mass), dynamic=False)
    yield Suspect((of.name("body", tops[0]),), "mass", now, value, (), probe, HEAVY, says, value)


def _weight(of: Simulation, top: int) -> float:
    return sum(of.model("body_mass")[body] for body, root in enumerate(root_of(of)) if root == top)


def _heavy(of: Simulation, top: int, mass: float) -> float:
    return max(_weight(of, top) / mass, mass / max(_weight(of, top), 1e-9))


def _efforts(model: ReaderModel, robot: Robot, joints: dict[int, list[Joint]]) -> Iterator[Suspect]:
    of = model.simulation
    strong = {joint: limit.force for joint in joints if (limit := limit_of(of, joint)) and limit.force > 0}
    votes = Counter(line for joint in strong for line in joints[joint] if _off(of, joint, line.effort) < STRONGER)
    known = {
        joint: max(joints[joint], key=lambda line: (votes[line], -_off(of, joint, line.effort))).effort
        for joint in strong
        if all(line.effort for line in joints[joint])
    }
    wrong = {joint: effort for joint, effort in known.items() if _off(of, joint, effort) > STRONGER}
    alike = len(known) - len(wrong)
    if not wrong or alike < max(FEWEST, STRONG * len(known)):
        return
    worst = max(wrong, key=lambda joint: _off(of, joint, wrong[joint]))
    limits = {joint: limit for joint in wrong if (limit := limit_of(of, joint))}
    values = {joint: f"{wrong[joint] / limit.scale:g}" for joint, limit in limits.items()}
    edits = tuple(
        edit
        for joint, limit in limits.items()
        for edit in model.set(limit.kind, [limit.of], limit.attribute, f"-{values[joint]} {values[joint]}")
    )
    limit, right = limits[worst], wrong[worst]
    probe = Probe("force off the data sheet's effort", "of it", _off, (worst, right), dynamic=False)
    unit = "N m" if of.joint_type(worst) == HINGE else "N"
    says = f"{of.name('joint', worst)} is given {limit.force:.4g} {unit}; that of {robot.names[0]} gives {right:.4g}"
    says += f" {unit}. {alike} others are given theirs."
    names = tuple(of.name(limit.kind, limit.of) for limit in limits.values())
    now, value = f"{limit.force / limit.scale:g}", values[worst]
    yield Suspect(names, limit.attribute, now, value, edits, probe, STRONGER, says, f"{right:g} {unit}", level="hint")


def _off(of: Simulation, joint: int, effort: float) -> float:
    """How many times the largest force on a joint is an effort, or the other way round, less 1."""
    limit = limit_of(of, joint)
    return max(limit.force / max(effort, 1e-9), effort / max(limit.force, 1e-9)) - 1 if limit else 0.0


def _ranges(model: ReaderModel, robot: Robot, ranges: dict[int, tuple[float, float]], alike: int) -> Iterator[Suspect]:
    of = model.simulation
    wrong = {joint: right for joint, right in ranges.items() if _elsewhere(of, joint, right) > ELSEWHERE}
    if not wrong:
        return
    worst = max(wrong, key=lambda joint: _elsewhere(of, joint, wrong[joint]))
    values = {joint: _written(model, joint, right) for joint, right in wrong.items()}
    edits = model.set_each("joint", "range", values)
    now, value = _written(model, worst, of.row("jnt_range", worst, 2)), values[worst]
    probe = Probe("end of a range off the data sheet's", "rad", _elsewhere, (worst, wrong[worst]), dynamic=False)
    says = f"{of.name('joint', worst)} has {now}; that of {robot.names[0]} {value}, and {alike} others have theirs."
    names = tuple(of.name("joint", joint) for joint in wrong)
    yield Suspect(names, "range", now, value, edits, probe, ELSEWHERE, says, value, level="hint")


def _ranged(of: Simulation, joints: dict[int, list[Joint]]) -> dict[int, tuple[float, float]]:
    """The data sheet's range of each joint that has one."""
    return {joint: nearest_range(lines, *of.ranges[joint]) for joint, lines in joints.items() if joint in of.ranges}


def _elsewhere(of: Simulation, joint: int, right: tuple[float, float]) -> float:
    """How far the end of a joint's range is from the data sheet's, in rad; a slide's METRE counts as one."""
    ends = zip(of.row("jnt_range", joint, 2), right, strict=True)
    return max(abs(a - b) for a, b in ends) / (1.0 if of.joint_type(joint) == HINGE else METRE)


def _written(model: ReaderModel, joint: int, ends: Sequence[float]) -> str:
    """A range as the model has it written: in its unit of angles."""
    unit = model.angle_unit if model.simulation.joint_type(joint) == HINGE else 1.0
    return written([end / unit for end in ends])
