"""One side of a robot cannot touch what the other side touches.

The bits of `contype` and `conaffinity` of a side's class were chosen with one bit missing: the left arm passes through
the torso, the table and the floor, and the right arm does not.

Bad:

    <mujoco>
      <default>
        <default class="left"><geom contype="2" conaffinity="4"/></default>
        <default class="right"><geom contype="4" conaffinity="3"/></default>
      </default>
      <worldbody>
        <geom name="table" type="box" pos="0.4 0 0.4" size="0.2 0.5 0.02"/>
        <body name="torso" pos="0 0 0.8">
          <geom type="box" size="0.05 0.1 0.2"/>
          <body name="left_upper" pos="0 0.15 0.15" childclass="left">
            <joint axis="0 1 0" range="-90 90" damping="5"/>
            <geom name="left_upper" type="capsule" fromto="0 0 -0.03 0 0 -0.15" size="0.03"/>
            <body name="left_lower" pos="0 0 -0.2">
              <joint axis="0 1 0" range="-90 0" damping="5"/>
              <geom name="left_lower" type="capsule" fromto="0 0 0 0 0 -0.15" size="0.03"/>
              <geom name="left_hand" pos="0 0 -0.2" size="0.03"/>
            </body>
          </body>
          <body name="right_upper" pos="0 -0.15 0.15" childclass="right">
            <joint axis="0 1 0" range="-90 90" damping="5"/>
            <geom name="right_upper" type="capsule" fromto="0 0 -0.03 0 0 -0.15" size="0.03"/>
            <body name="right_lower" pos="0 0 -0.2">
              <joint axis="0 1 0" range="-90 0" damping="5"/>
              <geom name="right_lower" type="capsule" fromto="0 0 0 0 0 -0.15" size="0.03"/>
              <geom name="right_hand" pos="0 0 -0.2" size="0.03"/>
            </body>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -     <default class="left"><geom contype="2" conaffinity="4"/></default>
    +     <default class="left"><geom contype="2" conaffinity="5"/></default>

The number: geoms of one side that the masks keep from something that their twins may touch, of all pairs that collide
at all; told from three on and from 60 %, all of one side. What one pair alone lacks is told by `twin-place-differs`.

When it is wrong: a side that is meant to be a ghost.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.shape import collides, solid
from clinic.diagnosis.probes.twins import twins
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A side that touches less than the other"
FAMILIES = ("falls-through",)
UNPLANTED = "in the healthy models of the bench both sides have the same masks"

ENOUGH, MOST = 3, 0.6


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The side whose geoms cannot touch what nearly all their twins may."""
    of = model.simulation
    for side in (0, 1):
        if _share(of, side) < MOST:
            continue
        less = _less(of)[side]
        names = tuple(of.name("geom", geom) for geom in less)
        missed = sorted({of.name("geom", other) for others in less.values() for other in others})
        other = of.name("geom", next(pair[1 - side] for pair in _pairs(of) if pair[side] in less))
        says = f"By their masks {len(less)} geoms of this side cannot touch {', '.join(missed[:3])}"
        says += (
            f" and {len(missed) - 3} more" * (len(missed) > 3) + f", as {other} and the others of the other side can."
        )
        masks = [f"{of.model(f'geom_{name}')[next(iter(less))]:g}" for name in ("contype", "conaffinity")]
        probe = Probe("share of a side's geoms that touch less than their twins", "", _share, (side,), dynamic=False)
        yield Suspect(names, "contype, conaffinity", ", ".join(masks), "", (), probe, MOST, says, "both sides alike")


def _share(of: Simulation, side: int) -> float:
    """The share of pairs of which one side's geom touches less; 0 where there are few."""
    pairs, less = _pairs(of), _less(of)
    return len(less[side]) / len(pairs) if len(less[side]) >= ENOUGH and not less[1 - side] else 0.0


@kept
def _pairs(of: Simulation) -> list[tuple[int, int]]:
    return [pair for pair in twins(of).pairs["geom"] if any(solid(of, geom) for geom in pair)]


@kept
def _less(of: Simulation) -> tuple[dict[int, list[int]], dict[int, list[int]]]:
    """By geom of the left side, and of the right: what its twin may touch and it may not, of what has no twin."""
    paired = {geom for pair in twins(of).pairs["geom"] for geom in pair}
    middle = [geom for geom in range(of.count("geom")) if geom not in paired]
    made: tuple[dict[int, list[int]], dict[int, list[int]]] = ({}, {})
    for pair in _pairs(of):
        for side, geom in enumerate(pair):
            missed = [each for each in middle if collides(of, pair[1 - side], each) and not collides(of, geom, each)]
            if missed:
                made[side][geom] = missed
    return made
