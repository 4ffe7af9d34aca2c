"""A tendon turns back on its way, and is much shorter with two of its sites exchanged.

A tendon goes through its sites in the order in which they are written. Where two of them change places it runs past the
one, back, and on again; a muscle then bends the joint that it should stretch.

Bad:

    <mujoco>
      <worldbody>
        <site name="hip" pos="0 0 1"/>
        <body name="shank" pos="0 0 0.5">
          <joint name="knee" axis="0 1 0"/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.4" size="0.03"/>
          <site name="patella" pos="0.05 0 -0.05"/>
          <site name="tibia" pos="0.05 0 -0.38"/>
        </body>
      </worldbody>
      <tendon>
        <spatial name="quadriceps">
          <site site="hip"/>
          <site site="tibia"/>
          <site site="patella"/>
        </spatial>
      </tendon>
    </mujoco>

Good:

    -       <site site="tibia"/>
    -       <site site="patella"/>
    +       <site site="patella"/>
    +       <site site="tibia"/>

The number: by which share of its length, straight from site to site as the model is written, it is shorter with two
that follow each other exchanged; more than a quarter. Of 583 tendons through sites alone in 23 models none saves 5 %.

Muscles turn back too where a hinge bends the other way than they are for: within its range they get shorter and then
longer, and pull it one way and then the other. The range is told where most of the muscles on it, and two at least, do
so, and with its sign turned none of them does.

When it is wrong: a cable that is led to and fro.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from collections.abc import Set as AbstractSet
from itertools import pairwise

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.engine import GAIN_MUSCLE, HINGE
from clinic.diagnosis.probes.couplings import couplings
from clinic.diagnosis.probes.tendons import path, pulled
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, how_many

TITLE = "A tendon that turns back on its way"
FAMILIES = ("wrong-numbers", "stuck", "drifts")
UNPLANTED = "few healthy models of the bench have a tendon through sites"

SHORTER = 0.25
POSES, MANY, ASIDE = 25, 60, 0.2  # joints that are tried; how far beyond zero a range may go, of its other end
MOVES, SLIGHT = 1e-3, 0.15  # m per rad; of the most that a tendon's length changes in a step


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The spatial tendons that are shorter so, each with the exchange that makes it shortest."""
    of = model.simulation
    yield from _bent_back(model)
    for tendon in range(of.count("tendon")):
        share, place = _shorter(of, tendon)
        if share <= SHORTER:
            continue
        element, names = model.element("tendon", tendon), [of.names("site")[site] for _, site in path(of, tendon)]
        one, other = names[place : place + 2]
        parts = [each for each in element.children if each.tag in ("site", "geom")] if element else []
        both = parts[place : place + 2]
        edits = tuple(set_attribute(each, "site", name) for each, name in zip(both, (other, one), strict=False))
        says = f"It goes through {one} before {other}, and would be {100 * share:.0f} % shorter the other way round."
        probe = Probe("length that an exchange of two sites saves", "of it", _saved, (tendon,), dynamic=False)
        now, value = f"{one}, {other}", f"{other}, {one}"
        yield Suspect((of.name("tendon", tendon),), "site", now, value, edits, probe, SHORTER, says, "straight on")


def _bent_back(model: ReaderModel) -> Iterator[Suspect]:
    """The hinges that bend the other way than their muscles are for."""
    of = model.simulation
    for joint, muscles in _wrong_way(of).items():
        low, high = (each / model.angle_unit for each in of.ranges[joint])
        now, value = written((low, high)), written([round(each, 6) + 0.0 for each in (-high, -low)])
        names = of.name("joint", joint), *(of.name("tendon", each) for each in muscles)
        says = (
            f"Within the range {len(muscles)} of its muscles turn back, and pull it the other way; mirrored none does."
        )
        probe, edits = (
            how_many("hinges that bend the other way", _wrong_way),
            model.set("joint", [joint], "range", value),
        )
        yield Suspect(names, "range", now, value, edits, probe, 0, says, "the way that its muscles bend it")


def _wrong_way(of: Simulation) -> dict[int, list[int]]:
    """By hinge that bends to one side of its zero, its muscles that turn back there, where none does on the other."""
    kinds = of.model("actuator_gaintype")
    muscles = {tendon for actuator, tendon in pulled(of).items() if int(kinds[actuator]) == GAIN_MUSCLE}
    led = {joint for _, (*two, _) in couplings(of) for joint in two}
    made: dict[int, list[int]] = {}
    for joint, (low, high) in list(of.ranges.items())[: MANY if len(muscles) > 1 else 0]:
        near, far = sorted(map(abs, (low, high)))
        if of.joint_type(joint) != HINGE or joint in led or near > ASIDE * far:
            continue
        turns = _turning(of, joint, low, high, muscles)
        back = [tendon for tendon, each in turns.items() if each]
        if len(back) > 1 and len(back) > len(turns) / 2 and not any(_turning(of, joint, -high, -low, muscles).values()):
            made[joint] = back
    return made


def _turning(of: Simulation, joint: int, low: float, high: float, tendons: AbstractSet[int]) -> dict[int, bool]:
    """By tendon that a hinge moves, whether its length turns back between two angles, beyond next to nothing."""
    lengths = list[Sequence[float]]()
    for step in range(POSES):
        of.as_written()
        of.put(joint, low + (high - low) * step / (POSES - 1))
        of.engine.forward()
        lengths.append(tuple(of.data("ten_length")))
    made = {}
    for tendon in sorted(tendons):
        ways = [after[tendon] - before[tendon] for before, after in pairwise(lengths)]
        most = max(map(abs, ways))
        if most > MOVES * (high - low) / (POSES - 1):
            made[tendon] = len({way > 0 for way in ways if abs(way) > SLIGHT * most}) > 1
    return made


def _saved(of: Simulation, tendon: int) -> float:
    return _shorter(of, tendon)[0]


def _shorter(of: Simulation, tendon: int) -> tuple[float, int]:
    """By which share a tendon is shorter with two sites exchanged, and the place of the first; 0 for other tendons."""
    points = path(of, tendon)
    if len(points) < 3 or len(points) < of.model("tendon_num")[tendon] or {kind for kind, _ in points} != {"site"}:
        return 0.0, 0
    of.as_written()
    places = [of.data_row("site_xpos", site, 3) for _, site in points]
    ways = {0.0: 0}
    for place in range(len(places) - 1):
        turned = [*places[:place], places[place + 1], places[place], *places[place + 2 :]]
        ways[1 - _length(turned) / max(_length(places), 1e-9)] = place
    return max(ways), ways[max(ways)]


def _length(places: list[tuple[float, ...]]) -> float:
    return sum(math.dist(*pair) for pair in pairwise(places))
