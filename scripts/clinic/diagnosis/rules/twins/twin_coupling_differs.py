"""Two joints are coupled on one side otherwise than their mirror images on the other.

Where the axes of left and right are mirrored already, the polynomials of both sides are the same. With the sign turned
once more in `polycoef`, the knee's plate or the finger's tip goes the wrong way on one side.

Bad:

    <mujoco>
      <worldbody>
        <body name="trunk" pos="0 0 1">
          <joint type="slide" axis="0 0 1"/>
          <geom type="box" size="0.1 0.2 0.1"/>
          <body name="thigh_left" pos="0 0.1 -0.1">
            <joint name="knee_left" axis="0 1 0"/>
            <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.03"/>
            <body name="foot_left" pos="0 0 -0.35">
              <joint name="ankle_left" axis="0 1 0"/>
              <joint name="toe_left" axis="0 1 0"/>
              <geom type="capsule" fromto="0 0 0 0.1 0 0" size="0.02"/>
            </body>
          </body>
          <body name="thigh_right" pos="0 -0.1 -0.1">
            <joint name="knee_right" axis="0 1 0"/>
            <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.03"/>
            <body name="foot_right" pos="0 0 -0.35">
              <joint name="ankle_right" axis="0 1 0"/>
              <joint name="toe_right" axis="0 1 0"/>
              <geom type="capsule" fromto="0 0 0 0.1 0 0" size="0.02"/>
            </body>
          </body>
        </body>
      </worldbody>
      <equality>
        <joint joint1="ankle_left" joint2="knee_left" polycoef="0 -0.5 0 0 0"/>
        <joint joint1="ankle_right" joint2="knee_right" polycoef="0 0.5 0 0 0"/>
        <joint joint1="toe_left" joint2="ankle_left" polycoef="0 0.5 0 0 0"/>
        <joint joint1="toe_right" joint2="ankle_right" polycoef="0 0.5 0 0 0"/>
      </equality>
    </mujoco>

Good:

    -     <joint joint1="ankle_left" joint2="knee_left" polycoef="0 -0.5 0 0 0"/>
    +     <joint joint1="ankle_left" joint2="knee_left" polycoef="0 0.5 0 0 0"/>

The number: by how much the followers of a mirrored motion differ, as a share of how far they go; more than 5 %, where
as many pairs of couplings at least agree. Which way a joint of the pair turns is taken from their axes.

When it is wrong: two sides that are meant to differ.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.couplings import Coupling, couplings, lost
from clinic.diagnosis.probes.twins import twins
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A coupling unlike that of the other side"
FAMILIES = ("drifts", "wrong-numbers", "stuck")
UNPLANTED = "no healthy model of the bench couples joints on two sides"

UNLIKE, STEPS = 0.05, 10


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Pairs of couplings that differ, where as many do not."""
    of = model.simulation
    pairs = _pairs(of)
    odd = [pair for pair in pairs if _unlike(of, *pair) > UNLIKE]
    if 2 * len(odd) > len(pairs):
        return
    for pair in odd:
        known = dict(couplings(of))
        left, right = sorted(pair, key=lambda each: -lost(of, (known[each],)))  # the one that is stopped first
        one, other = known[left], known[right]
        now, value = written(one[2]), written(_image(of, other, one))
        says = f"{of.name('joint', one[0])} does not mirror {of.name('joint', other[0])}, by the axes of their joints."
        probe = Probe("couplings of two sides apart by", "of their way", _unlike, (left, right), dynamic=False)
        names = tuple(of.name("joint", joint) for joint in (one[0], other[0], one[1], other[1]))
        edits = model.set("equality", [left], "polycoef", value)
        yield Suspect(names, "polycoef", now, value, edits, probe, UNLIKE, says, "mirror images", level="hint")


def _pairs(of: Simulation) -> list[tuple[int, int]]:
    """The couplings whose two joints are the twins of those of another one."""
    found = twins(of)
    by_joints = {coupling[:2]: each for each, coupling in couplings(of)}
    made = []
    for (follower, leader), each in by_joints.items():
        twin = found.partner("joint", follower), found.partner("joint", leader)
        if twin in by_joints and each < by_joints[twin]:
            made.append((each, by_joints[twin]))
    return made


def _image(of: Simulation, one: Coupling, other: Coupling) -> tuple[float, ...]:
    """The factors that the twin of a coupling has as its mirror image."""
    led, leading = _sign(of, one[0], other[0]), _sign(of, one[1], other[1])
    return tuple(led * factor * leading**power for power, factor in enumerate(one[2]))


def _sign(of: Simulation, one: int, other: int) -> float:
    """Whether equal angles of two twins are mirror images (1) or opposite ones (-1)."""
    found = twins(of)
    left, right = next(pair for pair in found.pairs["joint"] if one in pair and other in pair)
    return found.joint_sign(left, right)[0] if of.body_of("joint", left) in found.images else 1.0


def _unlike(of: Simulation, left: int, right: int) -> float:
    """By how much two couplings differ over the range of the leader, as a share of how far its follower goes."""
    known = dict(couplings(of))
    one, other = known[left], known[right]
    same_part = any(of.body_of("joint", follower) in twins(of).copies for follower, *_ in (one, other))
    image = other[2] if same_part else _image(of, other, one)
    low, high = of.ranges.get(one[1], (-1.0, 1.0))
    ways = [low + (high - low) * step / STEPS for step in range(STEPS + 1)]
    went, mirrored = ([sum(c * way**k for k, c in enumerate(f)) for way in ways] for f in (one[2], image))
    most = max(*map(abs, went), *map(abs, mirrored), 1e-9)
    return max(abs(a - b) for a, b in zip(went, mirrored, strict=True)) / most
