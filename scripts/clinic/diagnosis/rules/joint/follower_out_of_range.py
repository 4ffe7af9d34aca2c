"""A joint that follows another may not go where it is led.

`<equality><joint joint1=".." joint2=".."/>` (in URDF `<mimic>`) makes joint1 follow joint2. Where the follower's range
leaves out what the leader's range asks for, limit and equality fight, and the leader is held.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="knuckle" axis="0 1 0" range="0 50"/>
          <geom type="capsule" fromto="0 0 0 0.05 0 0" size="0.01" mass="0.05"/>
        </body>
        <body pos="0 0.1 1">
          <joint name="tip" axis="0 1 0" range="0 50"/>
          <geom type="capsule" fromto="0 0 0 0.05 0 0" size="0.01" mass="0.05"/>
        </body>
      </worldbody>
      <equality>
        <joint joint1="tip" joint2="knuckle" polycoef="0 -1 0 0 0"/>
      </equality>
    </mujoco>

Good:

    -       <joint name="tip" axis="0 1 0" range="0 50"/>
    +       <joint name="tip" axis="0 1 0" range="-50 0"/>

The number: the share of the leader's range that leads the follower out of its own; more than a half. A `polycoef` of a
constant alone, such as `1 0 0 0 0` for `0 1 0 0 0`, leads the follower nowhere: 1 where that is so.

When it is wrong: a leader that something else keeps to a part of its range.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.probes.couplings import couplings, led_over, lost
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.joint.fingers_move_together import sign_lost
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A joint may not go where it is led"
FAMILIES = ("stuck", "jumps-at-start")
SINCE = "0.1"
UNPLANTED = "one healthy model has a joint that follows another"

LOST = 0.5


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Followers whose range leaves out most of what they are led to, all together."""
    simulation = model.simulation
    yield from _constant(model)
    every = couplings(simulation)
    found = [each for number, each in every if lost(simulation, (each,)) > LOST and any(each[2][1:])
             and not sign_lost(simulation, number, each)]  # fmt: skip
    if not found:
        return
    edits: tuple[Edit, ...] = ()
    for each in found:
        scale = 1 / model.angle_unit if simulation.joint_type(each[0]) == HINGE else 1.0
        led = led_over(simulation, each)
        edits += model.set("joint", [each[0]], "range", f"{min(led) * scale:.4g} {max(led) * scale:.4g}")
    follower, leader, _ = found[0]
    low, high = simulation.row("jnt_range", follower, 2)
    led = led_over(simulation, found[0])
    yield Suspect(
        tuple(simulation.name("joint", each[0]) for each in found),
        "range",
        f"{low:.3g} {high:.3g}",
        f"{min(led):.3g} {max(led):.3g}",
        edits,
        Probe("share of a leader's range that leads a joint out of its own", "", lost, (tuple(found),), dynamic=False),
        LOST,
        f"{simulation.name('joint', leader)} leads {simulation.name('joint', follower)} to {min(led):.3g} to "
        f"{max(led):.3g}, and its range is {low:.3g} to {high:.3g}.",
        "a range that holds all that the leader asks for",
    )


def _constant(model: ReaderModel) -> Iterator[Suspect]:
    """Couplings whose polynomial has a constant alone."""
    of = model.simulation
    for each, (follower, leader, factors) in couplings(of):
        if not _unled(of, each):
            continue
        yield Suspect(
            (of.name("joint", follower),),
            "polycoef",
            " ".join(f"{factor:g}" for factor in factors),
            "0 1 0 0 0",
            model.set("equality", [each], "polycoef", "0 1 0 0 0"),
            Probe("1 where a joint does not follow the one that it is coupled to", "", _unled, (each,), dynamic=False),
            0.5,
            f"{of.name('joint', follower)} is held at {factors[0]:g} from its start, wherever "
            f"{of.name('joint', leader)} goes: the first number is a constant, the second the factor.",
            "a factor, the second number",
            level="cause" if factors[0] == 1 else "hint",
        )


def _unled(of: Simulation, equality: int) -> float:
    """1 where a coupling holds its follower at a constant other than its start."""
    found = (factors for each, (_, _, factors) in couplings(of) if each == equality)
    return float(any(factors[0] and not any(factors[1:]) for factors in found))
