"""What is called left is on the right.

The two wheels or cameras of a pair are exchanged: the robot turns to the right when it is told to turn left, and depth
that is computed from both images is negative.

Bad:

    <mujoco>
      <worldbody>
        <body name="head" pos="0 0 1">
          <freejoint/>
          <geom type="box" size="0.05 0.1 0.05"/>
          <camera name="left_eye" pos="0.05 -0.03 0" xyaxes="0 -1 0 0 0 1"/>
          <camera name="right_eye" pos="0.05 0.03 0" xyaxes="0 -1 0 0 0 1"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <camera name="left_eye" pos="0.05 -0.03 0" xyaxes="0 -1 0 0 0 1"/>
    +       <camera name="left_eye" pos="0.05 0.03 0" xyaxes="0 -1 0 0 0 1"/>
    -       <camera name="right_eye" pos="0.05 0.03 0" xyaxes="0 -1 0 0 0 1"/>
    +       <camera name="right_eye" pos="0.05 -0.03 0" xyaxes="0 -1 0 0 0 1"/>

The number: how far the left one is to the right of the other: along the image of two cameras of one body that look the
same way; for wheels, hinges without limits, against y of the robot's root, where x is forward. Of 289 healthy models
none has such a pair.

When it is wrong: a robot whose forward is not x; names that are those of the viewer who stands in front of it.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.shape import root_of
from clinic.diagnosis.probes.sides import right_of
from clinic.diagnosis.probes.vector import Vector, dot, norm, sub
from clinic.diagnosis.probes.view import axes
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "What is called left is on the right"
FAMILIES = ("drifts", "camera", "wrong-numbers")
UNPLANTED = "which side is which, only the names of a pair tell"

LEAST, ALIKE = 0.005, 0.9  # m; cosine between the views of two cameras


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Pairs of cameras and of wheels that are exchanged."""
    of = model.simulation
    wheels = _wheels(of)
    for kind in ("camera", "body"):
        for left, right in _pairs(of, kind):
            if not ({left, right} <= wheels if kind == "body" else _stereo(of, left, right)):
                continue
            off = _to_the_right(of, kind, left, right)
            if off <= LEAST:
                continue
            names = (of.name(kind, left), of.name(kind, right))
            probe = Probe("left one is to the right by", "m", _to_the_right, (kind, left, right), dynamic=False)
            says = f"{names[0]} is {off:.3g} m to the right of {names[1]}."
            now = " ".join(f"{x:.4g}" for x in of.row("cam_pos" if kind == "camera" else "body_pos", left, 3))
            yield Suspect(names, "pos", now, f"that of {names[1]}", (), probe, LEAST, says, "on its own side")


def _pairs(of: Simulation, kind: str) -> Iterator[tuple[int, int]]:
    places = {name: index for index, name in enumerate(of.names(kind)) if name}
    for name, left in places.items():
        right = next((places[other] for other in right_of(name) if other in places), None)
        if right is not None:
            yield left, right


def _wheels(of: Simulation) -> set[int]:
    """The bodies that turn without limits about an axis across the way forward."""
    of.begin()
    return {
        int(body)
        for joint, body in enumerate(of.model("jnt_bodyid"))
        if of.continuous(joint)
        and abs(dot(of.axis(joint), _y(of, int(body)))) > ALIKE
        and of.model("body_jntnum")[int(body)] == 1
    }


def _stereo(of: Simulation, left: int, right: int) -> bool:
    """Whether two cameras are on one body."""
    bodies = of.model("cam_bodyid")
    return bodies[left] == bodies[right]


def _y(of: Simulation, body: int) -> Vector:
    """The y of the robot's root; of the world, where that does not move."""
    root = root_of(of)[body]
    return tuple(of.data_row("xmat", root if root != body else 0, 9)[1::3])


def _to_the_right(of: Simulation, kind: str, left: int, right: int) -> float:
    of.begin()
    if kind == "body":
        between = sub(of.data_row("xpos", right, 3), of.data_row("xpos", left, 3))
        aside = dot(between, _y(of, left))
        return aside if abs(aside) > 0.8 * norm(between) else 0.0
    (across, _, forward), (_, _, other) = axes(of, left), axes(of, right)
    between = sub(of.data_row("cam_xpos", left, 3), of.data_row("cam_xpos", right, 3))
    aside = dot(between, across)
    return aside if dot(forward, other) > ALIKE and abs(aside) > 0.8 * norm(between) else 0.0
