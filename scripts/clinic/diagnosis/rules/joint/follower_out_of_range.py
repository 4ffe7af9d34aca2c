"""A joint that follows another may not go where it is led.

`<equality><joint joint1=".." joint2=".."/>` (in URDF `<mimic>`) makes joint1 follow joint2. Where the follower's range
leaves out what the leader's range asks for, limit and equality fight: the leader stops short, and the follower is
pressed past its limit. The sign in `polycoef` is told where one follower alone is led astray, has the range of its
leader, or of its twin on the other side, and with the other sign keeps to it. The leader's range is told where it is
1000 times as wide (mm) and wider than the model, or a hinge's 57.3 times (degrees) and wider than a turn; else the
follower's is. What keyframes say of the coupling comes before that.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="knuckle" axis="0 1 0" range="0 50"/>
          <geom type="capsule" fromto="0 0 0 0.05 0 0" size="0.01" mass="0.05"/>
          <body pos="0.05 0 0">
            <joint name="tip" axis="0 1 0" range="0 50"/>
            <geom type="capsule" fromto="0 0 0 0.05 0 0" size="0.01" mass="0.05"/>
          </body>
        </body>
      </worldbody>
      <equality>
        <joint joint1="tip" joint2="knuckle" polycoef="0 -1 0 0 0"/>
      </equality>
    </mujoco>

Good:

    -     <joint joint1="tip" joint2="knuckle" polycoef="0 -1 0 0 0"/>
    +     <joint joint1="tip" joint2="knuckle" polycoef="0 1 0 0 0"/>

The number: the share of the leader's range that leads the follower out of its own; more than a half. A `polycoef` of a
constant alone, such as `1 0 0 0 0` for `0 1 0 0 0`, leads the follower nowhere: 1 where that is so. It gets the factors
of all other couplings, or the constant for its factor.

When it is wrong: a leader that something else keeps to a part of its range.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import HINGE, SLIDE
from clinic.diagnosis.probes.couplings import Coupling, couplings, led_over, lost
from clinic.diagnosis.probes.sides import sided
from clinic.diagnosis.probes.vector import dot, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.joint.coupling_unlike_others import other_way, with_factors
from clinic.diagnosis.rules.joint.fingers_move_together import sign_lost
from clinic.diagnosis.rules.keyframe.key_breaks_equality import elsewhere
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A joint may not go where it is led"
FAMILIES = ("stuck", "jumps-at-start", "wrong-numbers")
LEVEL = "cause"
UNPLANTED = "one healthy model has a joint that follows another"

LOST, WITHIN = 0.5, 0.05
MORE = 0.02  # of the range
SMALL = 0.1  # an offset rather than a factor
OTHER_UNITS = {SLIDE: 1000.0, HINGE: 180 / math.pi}  # mm, degrees
UNIT_DIGITS, TURN = 2, 2 * math.pi


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Followers whose range leaves out most of what they are led to, all together."""
    simulation = model.simulation
    yield from _constant(model)
    turned = other_way(simulation)
    astray = {number: each for number, each in couplings(simulation) if lost(simulation, (each,)) > LOST
              and any(each[2][1:]) and not sign_lost(simulation, number, each)
              and number not in turned and not elsewhere(model, number)}  # fmt: skip
    for number, each in astray.items() if len(astray) == 1 else ():
        if factors := _turned(simulation, each):
            suspect = _of_sign(model, number, each, factors)
            if model.measured(suspect.probe, suspect.edits) <= LOST:
                yield suspect
                return
    found = list(astray.values())
    if not found:
        return
    if (leading := _of_leader(model, found)) is not None:
        yield leading
        return
    edits: tuple[Edit, ...] = ()
    for each in found:
        scale = 1 / model.angle_unit if simulation.joint_type(each[0]) == HINGE else 1.0
        led = led_over(simulation, each)
        edits += model.set("joint", [each[0]], "range", f"{min(led) * scale:.4g} {max(led) * scale:.4g}")
    follower = found[0][0]
    scale = 1 / model.angle_unit if simulation.joint_type(follower) == HINGE else 1.0
    low, high = (end * scale for end in simulation.row("jnt_range", follower, 2))
    led = [place * scale for place in led_over(simulation, found[0])]
    yield Suspect(
        tuple(simulation.name("joint", each[0]) for each in found),
        "range",
        f"{low:.4g} {high:.4g}",
        f"{min(led):.4g} {max(led):.4g}",
        edits,
        Probe("share of a leader's range that leads a joint out of its own", "", lost, (tuple(found),), dynamic=False),
        LOST,
        _astray(simulation, found[0]),
        "a range that holds all that the leader asks for",
    )


def _of_leader(model: ReaderModel, found: list[Coupling]) -> Suspect | None:
    """The range of the one leader, where it is as many times its followers' as another unit makes it; else None."""
    of = model.simulation
    leaders = {leader for _, leader, _ in found}
    times = {round(_times(of, each) / OTHER_UNITS[of.joint_type(each[1])], UNIT_DIGITS) for each in found}
    leader = leaders.pop()
    low, high = of.row("jnt_range", leader, 2)
    wide = high - low > (TURN if of.joint_type(leader) == HINGE else of.extent)
    if leaders or times != {1.0} or not wide:
        return None
    scale = 1 / model.angle_unit if of.joint_type(leader) == HINGE else 1.0
    now, value = (written([low * scale / by, high * scale / by]) for by in (1.0, OTHER_UNITS[of.joint_type(leader)]))
    names = tuple(of.name("joint", joint) for joint in (leader, *(each[0] for each in found)))
    probe = Probe(
        "share of a leader's range that leads a joint out of its own", "", lost, (tuple(found),), dynamic=False
    )
    says = f"{_astray(of, found[0])} That of {names[0]} is in another unit."
    edits = model.set("joint", [leader], "range", value)
    return Suspect(names, "range", now, value, edits, probe, LOST, says, "as wide as its follower's")


def _times(of: Simulation, coupling: Coupling) -> float:
    """How many times as wide as its own range what a follower is led over is."""
    (low, high), led = of.row("jnt_range", coupling[0], 2), led_over(of, coupling)
    return (max(led) - min(led)) / (high - low) if high > low else 0.0


def _astray(of: Simulation, coupling: Coupling) -> str:
    follower, leader, _ = coupling
    (low, high), led = of.row("jnt_range", follower, 2), led_over(of, coupling)
    return (
        f"{of.name('joint', leader)} leads {of.name('joint', follower)} to {min(led):.3g} to {max(led):.3g} "
        f"{of.unit(follower)}, and its range is {low:.3g} to {high:.3g}."
    )


def _turned(of: Simulation, coupling: Coupling) -> tuple[float, ...]:
    """The factors with the other sign, where these lead a joint of its leader's or its twin's range within that.

    Two joints of one body are fingers: with the other sign they go against each other.
    """
    follower, leader, factors = coupling
    own, (_, twin) = of.row("jnt_range", follower, 2), sided(of, "joint").get(follower, ("", leader))
    turned = tuple(-each for each in factors)
    bodies = [of.body_of("joint", joint) for joint in (follower, leader)]
    parents = [of.parent(body) for body in bodies]
    if bodies[0] != bodies[1] and parents[0] == parents[1]:
        of.begin()
        axes = [of.axis(joint) for joint in (follower, leader)]
        alike = _alike(own, of.row("jnt_range", leader, 2)) and turned[1] * dot(*axes) < 0
    else:
        alike = any(_alike(own, of.row("jnt_range", other, 2)) for other in (leader, twin))
    if not alike:
        return ()
    ways = (factors[0], *turned[1:]), turned
    return next((each for each in ways if lost(of, ((follower, leader, each),)) < WITHIN), ())


def _alike(one: Sequence[float], other: Sequence[float]) -> bool:
    """Whether two ranges are one, as they are written: that of a follower often has a little more."""
    span = max(one[1] - one[0], other[1] - other[0])
    return all(abs(a - b) <= MORE * span for a, b in zip(one, other, strict=True))


def _of_sign(model: ReaderModel, number: int, coupling: Coupling, factors: tuple[float, ...]) -> Suspect:
    of = model.simulation
    names = tuple(of.name("joint", joint) for joint in coupling[:2])
    attribute, now, value, edits = with_factors(model, number, factors)
    probe = Probe("share of a leader's range that leads a joint out of its own", "", _lost_by, (number,), dynamic=False)
    says = f"{_astray(of, coupling)} With the other sign it keeps to that."
    return Suspect(names, attribute, now, value, edits, probe, LOST, says, "within its range")


def _lost_by(of: Simulation, number: int) -> float:
    return lost(of, tuple(each for equality, each in couplings(of) if equality == number))


def _constant(model: ReaderModel) -> Iterator[Suspect]:
    """Couplings whose polynomial has a constant alone."""
    of = model.simulation
    for each, (follower, leader, factors) in couplings(of):
        if not _unled(of, each):
            continue
        value = written(_meant(of, factors))
        yield Suspect(
            (of.name("joint", follower),),
            "polycoef",
            " ".join(f"{factor:g}" for factor in factors),
            value,
            model.set("equality", [each], "polycoef", value),
            Probe("1 where a joint does not follow the one that it is coupled to", "", _unled, (each,), dynamic=False),
            0.5,
            f"{of.name('joint', follower)} is held at {factors[0]:g} from its start, wherever "
            f"{of.name('joint', leader)} goes: the first number is a constant, the second the factor.",
            "a factor, the second number",
            level="cause" if factors[0] == 1 else "hint",
        )


def _meant(of: Simulation, factors: tuple[float, ...]) -> tuple[float, ...]:
    """The factors that all other couplings have, two at least, or else the constant as a factor; 1 for a small one."""
    others = [other for _, (_, _, other) in couplings(of) if any(other[1:])]
    if len(others) > 1 and len(set(others)) == 1:
        return others[0]
    return (0.0, factors[0] if abs(factors[0]) > SMALL else 1.0, 0.0, 0.0, 0.0)


def _unled(of: Simulation, equality: int) -> float:
    """1 where a coupling holds its follower at a constant other than its start."""
    found = (factors for each, (_, _, factors) in couplings(of) if each == equality)
    return float(any(factors[0] and not any(factors[1:]) for factors in found))
