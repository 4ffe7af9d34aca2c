"""Two actuators of one kind drive one joint.

A line was copied and its `joint` left as it was: two servos pull the joint to two targets, and the joint that the
second was meant for hangs.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="hip" axis="0 1 0"/>
          <geom type="capsule" size="0.03" fromto="0 0 0 0 0 -0.3"/>
          <body pos="0 0 -0.3">
            <joint name="knee" axis="0 1 0"/>
            <geom type="capsule" size="0.03" fromto="0 0 0 0 0 -0.3"/>
          </body>
        </body>
      </worldbody>
      <actuator>
        <position name="upper" joint="hip" kp="200" dampratio="1"/>
        <position name="lower" joint="hip" kp="200" dampratio="1"/>
      </actuator>
    </mujoco>

Good:

    -     <position name="lower" joint="hip" kp="200" dampratio="1"/>
    +     <position name="lower" joint="knee" kp="200" dampratio="1"/>

The number: how many other actuators with the same types of gain, bias and dynamics drive the joint, where a joint of
its mechanism is driven by none. One that is called like the driven joint, but for what sets the names of the actuators
apart, was meant. So is a motor at a site whose force moves joints with an actuator of their own, where a joint that
carries the site has none, and another axis of the site moves that one with ten times the lever, over 17 poses.

When it is wrong: two motors on one axle, or a pair of muscles that a joint stands for.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import DYN_MUSCLE, HINGE, TRN_SITE
from clinic.diagnosis.probes.copied import Line, misled
from clinic.diagnosis.probes.load import poses
from clinic.diagnosis.probes.shape import root_of
from clinic.diagnosis.probes.siblings import of_a_row
from clinic.diagnosis.probes.vector import at, cross, sub, times, transpose
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe, Suspect, how_many

TITLE = "Two actuators on one joint"
FAMILIES = ("stuck", "sags", "drifts")
UNPLANTED = "an actuator on another joint is planted for actuator-on-another-joint"

SHARE, SOME = 0.1, 0.01  # of the lever of the best axis; m


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each joint that is driven twice, beside one that is not driven."""
    of = model.simulation
    yield from _astray(model)
    for joint, driving in twice(of).items():
        meant, idle = _meant(of, joint, driving), [of.name("joint", each) for each in _idle(of, joint)[:3]]
        wrong, value, edits = driving[-1], ", ".join(idle), tuple[Edit, ...]()
        for wrong, other in meant.items():
            value, idle = of.names("joint")[other], [of.name("joint", other)]
            edits = model.set("actuator", [wrong], "joint", value)
        names = tuple(of.name("actuator", each) for each in sorted(driving, key=lambda each: each not in meant))
        probe = Probe("actuators of one kind on one joint, beyond one", "", _more, (joint,), dynamic=False)
        says = f"{' and '.join(names)} drive {of.name('joint', joint)}, and nothing drives {', '.join(idle)}."
        now, at = of.names("joint")[joint] * bool(meant), model.element("actuator", wrong)
        yield Suspect((*names, of.name("joint", joint)), "joint", now, value, edits, probe, 0, says, "one each", at=at)


def _astray(model: ReaderModel) -> Iterator[Suspect]:
    """Each motor at a site that does what another actuator does, and nothing to a joint that has none."""
    of = model.simulation
    for actuator, (moved, idle, axis) in astray(of).items():
        gear = of.row("actuator_gear", actuator, 6)
        now, wanted = (" ".join(f"{x:g}" for x in each) for each in (gear, _along(gear, axis)))
        names = tuple(of.name(*each) for each in (("actuator", actuator), ("joint", moved), ("joint", idle)))
        says = f"{names[0]} moves {names[1]}, which has an actuator of its own, and not {names[2]}, which has none."
        probe = how_many("motors at sites that move what is driven anyhow", astray)
        edits = model.set("actuator", [actuator], "gear", wanted)
        yield Suspect(names, "gear", now, wanted, edits, probe, 0, says, "one each", level="hint")


def _along(gear: Sequence[float], axis: int) -> list[float]:
    """A gear of one force, along another axis of its site."""
    (force,) = (each for each in gear[:3] if each)
    return [force if each == axis else 0.0 for each in range(6)]


@kept
def astray(of: Simulation) -> dict[int, tuple[int, int, int]]:
    """By motor at a site: a driven joint that it moves, one that it never moves, and the site's axis that does."""
    made = {}
    for actuator, kind in enumerate(of.model("actuator_trntype")):
        site, beside = (int(each) for each in of.row("actuator_trnid", actuator, 2))
        gear = of.row("actuator_gear", actuator, 6)
        one = sum(each != 0 for each in gear) == 1 and any(gear[:3])
        if int(kind) != TRN_SITE or beside >= 0 or not one:
            continue
        above = [joint for body in of.ancestors(of.body_of("site", site)) for joint in of.joints_of(body)]
        if any(joint not in of.scalar_joints for joint in above):
            continue
        levers = _levers(of, site, above)
        own = next(axis for axis in range(3) if gear[axis])
        moved = [joint for joint in above if levers[joint][own] > max(SHARE * max(levers[joint]), SOME)]
        idle = [joint for joint in above if joint not in of.drivers and joint not in moved]
        far = {joint: max(range(3), key=lambda axis: levers[joint][axis]) for joint in idle}
        meant = [joint for joint in idle if levers[joint][far[joint]] > SOME]
        if moved and all(joint in of.drivers for joint in moved) and len(meant) == 1:
            made[actuator] = (moved[0], meant[0], far[meant[0]])
    return made


def _levers(of: Simulation, site: int, joints: Sequence[int]) -> dict[int, list[float]]:
    """The most that a force of 1 N along each axis of a site does to joints over poses within their ranges."""
    made = {joint: [0.0] * 3 for joint in joints}
    for pose in poses(of):
        of.engine.write("qpos", pose)
        of.engine.forward()
        place, turn = at(of.data("site_xpos"), site), transpose(of.data_row("site_xmat", site, 9))
        for joint in joints:
            way = of.axis(joint)
            if of.joint_type(joint) == HINGE:
                way = cross(way, sub(place, at(of.data("xanchor"), joint)))
            made[joint] = [max(pair) for pair in zip(made[joint], map(abs, times(turn, way)), strict=True)]
    return made


def _meant(of: Simulation, joint: int, driving: Sequence[int]) -> dict[int, int]:
    """The one of the actuators of a joint that is called after an idle one, and that; empty where it is not one."""
    names, actuators = of.names("joint"), of.names("actuator")
    lines = {each: Line(names[joint], (actuators[each],)) for each in driving}
    found = misled(lines, [names[each] for each in _idle(of, joint)])
    return {each: names.index(name) for each, name in found.items()} if len(found) == 1 else {}


def twice(of: Simulation) -> dict[int, list[int]]:
    """The joints that two or more actuators of one kind drive while one of the same mechanism has none."""
    driving: dict[tuple[int, ...], list[int]] = {}
    for actuator in range(of.count("actuator")):
        joint = of.driven_joint(actuator)
        spring, kinds = of.bias(actuator)[1] != 0, of.actuator_types(actuator)
        if joint is not None and kinds[2] != DYN_MUSCLE:
            driving.setdefault((joint, spring, *kinds), []).append(actuator)
    return {key[0]: each for key, each in driving.items() if len(each) > 1 and _idle(of, key[0])}


def _idle(of: Simulation, joint: int) -> list[int]:
    """The hinges and slides of a joint's mechanism, or called like it but for a number, that no actuator drives."""
    owner, bodies = root_of(of), of.model("jnt_bodyid")
    row = of_a_row(of)
    beside = (
        each
        for each in range(of.count("joint"))
        if owner[int(bodies[each])] == owner[int(bodies[joint])] or row[each] == row[joint]
    )
    return [each for each in beside if each not in of.drivers and each in of.scalar_joints]


def _more(of: Simulation, joint: int) -> float:
    return float(len(twice(of).get(joint, [0])) - 1)
