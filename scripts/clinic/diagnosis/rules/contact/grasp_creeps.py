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

The number: how fast contacts slide on what is held by moving parts alone, at the end of 2 s from the keyframe, in radii
of the thing a second; below 0.05 is well. Measured with this pin: 3.6 mm/s, and less than 0.001 mm/s with the edit.
`cone="elliptic"` with `impratio="10"` helps as well. Where nothing is held, a free thing is put between the jaws, which
close on it for 1 s, and pulled across by its weight for 2 s: from 0.01 radii a second on that is a hint. With
`--symptom slips` or `drifts` both are told as hints from a tenth of that on.

When it is wrong: what slips fast has too little friction, or fingers that are too weak.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from clinic.diagnosis.probes.grasp import OPPOSITE, grasps, leaves, pressing
from clinic.diagnosis.probes.push import creeps
from clinic.diagnosis.probes.run import let_go
from clinic.diagnosis.probes.shape import root_of
from clinic.diagnosis.probes.vector import dot
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A grasp that creeps"
FAMILIES = ("slips", "drifts")
CASE = "box-creeps-out-of-grasp"
LEVEL = "cause"
UNPLANTED = "nothing is held in a grasp at the start of a healthy model"

MOST, SLOW = 0.05, 0.01  # radii a second; of a hint, in jaws that closed on it
SHARE, HALF = 0.2, 0.6  # of it, with an edit that helps
KEEN = 0.1  # of these, where the reader sees something slip
FIRM = 3.0  # times the weight, that friction carries


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The solver's options, where a free body hangs on moving parts alone, or slides in jaws that hold it firmly."""
    of = model.simulation
    if not of.gravity:
        return
    passes = of.model("opt.noslip_iterations")[0] > 0
    hung = None if passes else next(_hung(of), None)
    part = KEEN if model.symptom in FAMILIES else 1.0
    firm_ones = [each for each in grasps(of) if each.weight * FIRM < each.carries]
    slides = ((each.body, slow) for slow in (SLOW, part * SLOW) for each in firm_ones if each.leaves > slow)
    if hung is not None:
        firm = part < 1 and model.measured(creeps(hung)) <= MOST
        held = _noslip(model, hung, creeps(hung), part * MOST if firm else MOST)
        yield replace(held, level="hint") if firm else held
    elif (slide := next(slides, None)) is not None:
        body, slow = slide
        edits = (*model.option("cone", "elliptic"), *model.option("impratio", "10"))
        if model.measured(leaves(body), edits) > slow:
            if not passes:
                yield replace(_noslip(model, body, leaves(body), slow), level="hint")
            return
        now = f"{of.model('opt.impratio')[0]:g}"
        says = (
            'Soft friction slides in a firm grasp; under cone="elliptic" an impratio of 10 makes it ten times as stiff.'
        )
        names = (of.name("body", body),)
        yield Suspect(names, "impratio", now, "10", edits, leaves(body), slow, says, share=HALF, level="hint")


def _noslip(model: ReaderModel, body: int, probe: Probe, limit: float) -> Suspect:
    of = model.simulation
    says = "Soft friction slides under a steady load; the no-slip pass of the solver takes that away."
    now = f"{int(of.model('opt.noslip_iterations')[0])}"
    edits, names = model.option("noslip_iterations", "10"), (of.name("body", body),)
    return Suspect(names, "noslip_iterations", now, "10", edits, probe, limit, says, share=SHARE)


def _hung(of: Simulation) -> Iterator[int]:
    """The free bodies that moving parts alone press on from both sides."""
    end, bodies, owner = let_go(of).end, of.model("geom_bodyid"), root_of(of)
    contacts = end.contacts if end else ()
    for body in of.free_bodies:
        trees = [[owner[int(bodies[geom])] for geom in contact.geoms] for contact in contacts]
        others = [tree for pair in trees if body in pair for tree in pair if tree != body]
        if _squeezed(of, body) and not set(others) & {0, *of.free_bodies}:
            yield body


def _squeezed(of: Simulation, body: int) -> bool:
    """Whether contacts press on a body from opposite sides."""
    end = let_go(of).end
    normals = [normal for *_, normal in pressing(of, end.contacts if end else (), body)]
    return any(dot(one, other) < OPPOSITE for one in normals for other in normals)
