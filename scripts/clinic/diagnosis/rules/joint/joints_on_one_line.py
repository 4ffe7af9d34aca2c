"""Two joints of one body turn about the same line, or slide along the same direction.

Two corners of a mouth, two ends of a door: one hinge turns about the line through both. A second one on that line adds
no motion, only a number that nothing determines: MuJoCo warns that the inertia matrix is too close to singular.

Bad:

    <mujoco>
      <worldbody>
        <body name="door" pos="0 0 1">
          <joint name="hinge_low" axis="0 0 1" pos="0 0 -0.4"/>
          <joint name="hinge_high" axis="0 0 1" pos="0 0 0.4"/>
          <geom type="box" size="0.3 0.02 0.5" pos="0.3 0 0" mass="5"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <joint name="hinge_high" axis="0 0 1" pos="0 0 0.4"/>

The number: joints of a body that move it as one before them does: hinges whose axes lie within 1 % of the model's size
on one line, and slides that are parallel.

When it is wrong: two motors on one shaft, each with an armature of its own.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import delete
from clinic.diagnosis.engine import HINGE, SLIDE
from clinic.diagnosis.probes.run import let_go
from clinic.diagnosis.probes.vector import cross, norm, sub
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, how_many

TITLE = "Two joints that make the same motion"
FAMILIES = ("explodes", "drifts")
SINCE = "0.1"
UNPLANTED = "a second joint on the line of the first is a fault at every strength"

NEAR, PARALLEL = 0.01, 0.001  # of the model's extent; the sine of an angle


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The joints that move their bodies as one before them, all together."""
    of, source = model.simulation, model.source
    again = _again(of)
    if not again:
        return
    places = [model.element("joint", joint) for joint in again]
    edits = tuple(delete(each) for each in places if each is not None) if all(places) and source else ()
    singular = model.measured(_singular()) > 0
    probe = _singular() if singular else how_many("joints that move a body as another", _again)
    names = tuple(of.name("joint", joint) for pair in again.items() for joint in pair)
    what = "turns about the line" if of.joint_type(next(iter(again))) == HINGE else "slides along the direction"
    says, value = f"{names[0]} {what} of {names[1]}.", f"without {names[0]}"
    yield Suspect(names, "", "", value, edits, probe, 0.0, says, level="cause" if singular else "hint")


def _again(of: Simulation) -> dict[int, int]:
    """The joints that move their bodies as one before them, with that."""
    of.begin()
    near, made = NEAR * of.model("stat.extent")[0], dict[int, int]()
    for body in of.moving_bodies:
        joints = [joint for joint in of.joints_of(body) if of.joint_type(joint) in (HINGE, SLIDE)]
        for place, joint in enumerate(joints):
            for other in joints[:place]:
                axis = of.data_row("xaxis", joint, 3)
                apart = sub(of.data_row("xanchor", joint, 3), of.data_row("xanchor", other, 3))
                parallel = norm(cross(axis, of.data_row("xaxis", other, 3))) < PARALLEL
                on_line = of.joint_type(joint) == SLIDE or norm(cross(axis, apart)) < near
                if parallel and on_line and of.joint_type(joint) == of.joint_type(other):
                    made.setdefault(joint, other)
    return made


def _singular() -> Probe:
    return Probe("warnings that the inertia matrix is singular", "", _warned)


def _warned(of: Simulation) -> float:
    return float(let_go(of).warnings.get("INERTIA", 0))
