"""What is held creeps out of the grasp.

Friction in MuJoCo is soft: under a load along the surface a contact slides slowly, however firm the grasp. How slowly
is a matter of `impratio`, of the cone, and of `noslip_iterations`.

Bad:

    <mujoco>
      <worldbody>
        <body name="left" pos="-0.013 0 0.1">
          <joint name="left" type="slide" axis="1 0 0" damping="20"/>
          <geom type="box" size="0.008 0.02 0.02" mass="0.1"/>
        </body>
        <body name="right" pos="0.013 0 0.1">
          <joint name="right" type="slide" axis="-1 0 0" damping="20"/>
          <geom type="box" size="0.008 0.02 0.02" mass="0.1"/>
        </body>
        <body name="pin" pos="0 0 0.1">
          <freejoint/>
          <geom type="capsule" size="0.004 0.015" euler="90 0 0" mass="0.045"/>
        </body>
      </worldbody>
      <actuator>
        <position joint="left" kp="6000" ctrlrange="0 0.003"/>
        <position joint="right" kp="6000" ctrlrange="0 0.003"/>
      </actuator>
      <keyframe>
        <key name="squeeze" qpos="0.001 0.001 0 0 0.1 1 0 0 0" ctrl="0.003 0.003"/>
      </keyframe>
    </mujoco>

Good:

      <mujoco>
    +   <option noslip_iterations="10"/>

The number: how fast contacts slide on what is held by moving parts alone, at the end of 2 s from the keyframe, in
radii of the thing a second; below 0.05 is well. Measured with this pin: 2 mm/s, and 0.02 mm/s with the edit.
`cone="elliptic"` with `impratio="10"` helps as well.

When it is wrong: what slips fast has too little friction, or fingers that are too weak.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.push import creeps
from clinic.diagnosis.probes.run import let_go
from clinic.diagnosis.probes.shape import root_of
from clinic.diagnosis.probes.vector import dot
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect

TITLE = "A grasp that creeps"
FAMILIES = ("slips", "drifts")
SINCE = "0.1"
CASE = "box-creeps-out-of-grasp"
UNPLANTED = "nothing is held in a grasp at the start of a healthy model"

OPPOSITE = 0.7
MOST = 0.05  # radii a second


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The solver's options, where a free body hangs on moving parts alone."""
    simulation = model.simulation
    run, bodies, owner = let_go(simulation), simulation.model("geom_bodyid"), root_of(simulation)
    if run.end is None or simulation.model("opt.noslip_iterations")[0] > 0 or not any(simulation.model("opt.gravity")):
        return
    for body in simulation.free_bodies:
        trees = [[owner[int(bodies[geom])] for geom in contact.geoms] for contact in run.end.contacts]
        others = [tree for pair in trees if body in pair for tree in pair if tree != body]
        if _squeezed(model, body) and not set(others) & {0, *simulation.free_bodies}:
            edits = model.option("noslip_iterations", "10")
            says = "Soft friction slides under a steady load; the no-slip pass of the solver takes that away."
            now = f"{int(simulation.model('opt.noslip_iterations')[0])}"
            yield Suspect(
                (simulation.name("body", body),), "noslip_iterations", now, "10", edits, creeps(body), MOST, says,
                share=0.2,
            )  # fmt: skip
            return


def _squeezed(model: ReaderModel, body: int) -> bool:
    """Whether contacts press on a body from opposite sides."""
    run, bodies = let_go(model.simulation), model.simulation.model("geom_bodyid")
    pressed = []
    for contact in run.end.contacts if run.end else ():
        sides = [int(bodies[geom]) for geom in contact.geoms]
        if body in sides and contact.force > 0:
            sign = 1 if sides[1] == body else -1
            pressed.append((sign * contact.normal[0], sign * contact.normal[1], sign * contact.normal[2]))
    return any(dot(one, other) < -OPPOSITE for one in pressed for other in pressed)
