"""Tendons: the joints of fixed ones, the lengths that they can have, and the lengths that servos ask of them."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from clinic.diagnosis.engine import TRN_TENDON, WRAP_JOINT
from clinic.diagnosis.probes.equalities import COUPLED
from clinic.diagnosis.probes.servo import affine, alone, hold
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import probe

WRAPS = {1: "joint", 3: "site", 4: "geom", 5: "geom"}  # mjtWrap: joint, site, sphere, cylinder
POSES, GOLDEN = 64, 0.6180339887
STEP, SECONDS, TURNS = 0.01, 3.0, 4  # of the tendon's length; s; in the second half


def joints_of(of: Simulation, tendon: int) -> list[tuple[int, float]]:
    """The joints of a fixed tendon with their coefficients; none of a spatial one."""
    first, number = int(of.model("tendon_adr")[tendon]), int(of.model("tendon_num")[tendon])
    if int(of.model("wrap_type")[first]) != WRAP_JOINT:
        return []
    return [(int(of.model("wrap_objid")[each]), of.model("wrap_prm")[each]) for each in range(first, first + number)]


@kept
def pulled(of: Simulation) -> dict[int, int]:
    """The tendon that each actuator on one pulls, by actuator."""
    kinds = enumerate(of.model("actuator_trntype"))
    return {each: int(of.model("actuator_trnid")[2 * each]) for each, kind in kinds if int(kind) == TRN_TENDON}


def path(of: Simulation, tendon: int) -> list[tuple[str, int]]:
    """What a tendon goes through, in order: sites and geoms, or the joints of a fixed one; by kind and number."""
    first, number = int(of.model("tendon_adr")[tendon]), int(of.model("tendon_num")[tendon])
    parts = [
        (int(of.model("wrap_type")[each]), int(of.model("wrap_objid")[each])) for each in range(first, first + number)
    ]
    return [(WRAPS[kind], each) for kind, each in parts if kind in WRAPS]


def reach(of: Simulation, tendon: int) -> tuple[float, float] | None:
    """The least and the most of a tendon's length over its joints' ranges; None where a joint has no range.

    Of a spatial tendon in so many poses that the true ends lie a little outside.
    """
    fixed = joints_of(of, tendon)
    if not fixed:
        lengths = sampled(of)
        return (min(each[tendon] for each in lengths), max(each[tendon] for each in lengths)) if lengths else None
    if not all(joint in of.ranges for joint, _ in fixed):
        return None
    ends = [[coefficient * x for x in of.ranges[joint]] for joint, coefficient in fixed]
    return sum(map(min, ends)), sum(map(max, ends))


@kept
def sampled(of: Simulation) -> list[tuple[float, ...]]:
    """The lengths of all tendons in poses between the ends of all ranges.

    No pose where a hinge or slide has no range, or a joint follows another one.
    """
    free = len(of.ranges) == len(of.scalar_joints) and COUPLED not in map(int, of.model("eq_type"))
    made = []
    for pose in range(POSES if free and of.ranges else 0):
        of.begin(forward=False)
        for place, (joint, (low, high)) in enumerate(of.ranges.items()):
            share = (0.5 + pose * (place + 1) * GOLDEN) % 1.0
            share = (pose >> place % 6) % 2 if pose % 3 == 0 else share
            of.put(joint, low + share * (high - low))
        of.engine.forward()
        made.append(tuple(of.data("ten_length")))
    return made


def servo(of: Simulation, actuator: int) -> tuple[float, float] | None:
    """Of a position servo on a tendon: the length it asks for at control 0, and what a unit adds; else None."""
    gain, bias, gear = of.gain(actuator)[0], of.bias(actuator), of.gear(actuator)
    if actuator not in pulled(of) or not affine(of, actuator) or bias[1] >= 0 or not gain * gear:
        return None
    return bias[0] / (-bias[1] * gear), gain / (-bias[1] * gear)


def targets(of: Simulation, actuator: int) -> tuple[float, float] | None:
    """The least and the most that a servo on a tendon is told over its control range; None for another actuator."""
    line = servo(of, actuator)
    if line is None or not of.model("actuator_ctrllimited")[actuator]:
        return None
    ends = [line[0] + line[1] * ctrl for ctrl in of.row("actuator_ctrlrange", actuator, 2)]
    return min(ends), max(ends)


def winches(of: Simulation) -> list[int]:
    """The position servos on tendons."""
    return [each for each in pulled(of) if servo(of, each) is not None]


@probe("what still swings 1.5 s after a step of 1 % of a tendon's length, as a share of the step")
def swings_on(of: Simulation, actuators: Sequence[int]) -> float:
    """How much the servos of tendons ring, while the others hold theirs; 0 where all soon come to rest."""
    return max((_swings(of, each) for each in actuators), default=0.0)


@kept
def _swings(of: Simulation, actuator: int) -> float:
    tendons = pulled(of)
    with alone(of, gravity=True):
        of.begin()
        hold(of)
        begun = list(of.data("ten_length"))
        step = STEP * begun[tendons[actuator]]
        for each, tendon in tendons.items():
            if (line := servo(of, each)) is not None:
                goal = begun[tendon] + step * (each == actuator)
                of.engine.write("ctrl", [(goal - line[0]) / line[1]], each)
        seen = [of.data("ten_length")[tendons[actuator]] for _ in of.run(SECONDS, samples=600)]
    late = seen[len(seen) // 2 :]
    ways = [after - before for before, after in pairwise(late)]
    turns = sum(before * after < 0 for before, after in pairwise(ways))
    if of.unstable() or turns < TURNS or not step:
        return 0.0
    return abs((max(late) - min(late)) / 2 / step)
