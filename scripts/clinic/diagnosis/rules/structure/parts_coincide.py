"""Two sliding parts stand in one place.

A gripper whose second finger is a copy of the first with the same `pos` (in a URDF: the same `origin`): both fingers
are one inside of the other, and nothing is ever between them.

Bad:

    <mujoco>
      <worldbody>
        <body name="palm" pos="0 0 0.5">
          <geom type="box" size="0.05 0.05 0.02"/>
          <body name="left_finger" pos="0 0 0.05">
            <joint name="left" type="slide" axis="0 1 0" range="0 0.04"/>
            <geom type="box" size="0.01 0.005 0.03"/>
          </body>
          <body name="right_finger" pos="0 0 0.05">
            <joint name="right" type="slide" axis="0 -1 0" range="0 0.04"/>
            <geom type="box" size="0.01 0.005 0.03"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <body name="palm" pos="0 0 0.5">
          <geom type="box" size="0.05 0.05 0.02"/>
          <body name="left_finger" pos="0 0.005 0.05">
            <joint name="left" type="slide" axis="0 1 0" range="0 0.04"/>
            <geom type="box" size="0.01 0.005 0.03"/>
          </body>
          <body name="right_finger" pos="0 -0.005 0.05">
            <joint name="right" type="slide" axis="0 -1 0" range="0 0.04"/>
            <geom type="box" size="0.01 0.005 0.03"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

The number: pairs of bodies of one parent that slide and have the same place, turn and geoms. Of 289 healthy models
none has one; the legs of a planar walker have, and they hang on hinges.

When it is wrong: parts that are meant to start in one place, and never to touch.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from clinic.diagnosis.engine import SLIDE
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Two fingers in one place"
FAMILIES = ("jumps-at-start", "stuck", "slips")
SINCE = "0.2"
LEVEL = "hint"
UNPLANTED = "fingers of healthy models that are put in one place are told as overlapping"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each pair of sliding twins in one place."""
    of = model.simulation
    for one, other in _pairs(of):
        names = (of.name("body", one), of.name("body", other))
        says = f"{names[0]} and {names[1]} have the same place and shape."
        now = " ".join(f"{x:.4g}" for x in of.row("body_pos", one, 3))
        probe = Probe("pairs of parts in one place", "", _count, dynamic=False)
        yield Suspect(names, "pos", now, "apart from each other", (), probe, 0.1, says, "none")


def _count(of: Simulation) -> float:
    return float(len(_pairs(of)))


def _pairs(of: Simulation) -> list[tuple[int, int]]:
    groups: dict[tuple[float, ...], list[int]] = {}
    for body in range(1, of.count("body")):
        geoms, joints = of.geoms_of(body), of.joints_of(body)
        if geoms and [of.joint_type(joint) for joint in joints] == [SLIDE]:
            key = [of.model("body_parentid")[body], *_row(of, "body_pos", body, 3), *_row(of, "body_quat", body, 4)]
            for geom in geoms:
                key += [of.model("geom_type")[geom], *_row(of, "geom_size", geom, 3)]
                key += [*_row(of, "geom_pos", geom, 3), *_row(of, "geom_quat", geom, 4)]
            groups.setdefault(tuple(key), []).append(body)
    return [pair for bodies in groups.values() for pair in combinations(bodies, 2)]


def _row(of: Simulation, field: str, index: int, width: int) -> tuple[float, ...]:
    return tuple(round(x, 6) for x in of.row(field, index, width))
