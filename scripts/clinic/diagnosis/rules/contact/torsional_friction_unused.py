"""Fingers with a torsional friction that their contacts do not have.

The second number of `friction` resists turning about the contact's normal, and the third one rolling. A contact has
them from `condim="4"` and `condim="6"` on: with `condim="3"`, the default, what two fingers pinch turns between them.

Bad:

    <mujoco>
      <worldbody>
        <body name="left_finger" pos="0 0.03 0.2">
          <joint type="slide" axis="0 1 0" range="-0.02 0.02"/>
          <geom name="left_pad" type="box" size="0.01 0.005 0.02" mass="0.02" friction="1 0.05 0.001"/>
        </body>
        <body name="right_finger" pos="0 -0.03 0.2">
          <joint type="slide" axis="0 1 0" range="-0.02 0.02"/>
          <geom name="right_pad" type="box" size="0.01 0.005 0.02" mass="0.02" friction="1 0.05 0.001"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <geom name="left_pad" type="box" size="0.01 0.005 0.02" mass="0.02" friction="1 0.05 0.001"/>
    +       <geom name="left_pad" type="box" size="0.01 0.005 0.02" mass="0.02" friction="1 0.05 0.001" condim="4"/>

    -       <geom name="right_pad" type="box" size="0.01 0.005 0.02" mass="0.02" friction="1 0.05 0.001"/>
    +       <geom name="right_pad" type="box" size="0.01 0.005 0.02" mass="0.02" friction="1 0.05 0.001" condim="4"/>

The number: how many geoms of fingers, thumbs, jaws, pads and tips have more than 0.02 m, four times the default, in a
model without any `condim` above 3; two at least are told. So are 2 of 206 healthy models.

When it is wrong: a number that was left over, in a task where nothing is to be held from turning.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.grasp import PAD
from clinic.diagnosis.probes.shape import solid
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "Torsional friction that condim leaves out"
FAMILIES = ("slips", "drifts")
MINOR = True
UNPLANTED = "in none of the healthy models do fingers hold anything at the start"

LITTLE, PLAIN = 0.02, 3  # m; the condim up to which a contact has no torsional friction


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The fingers' geoms with torsional friction, where no contact can have it."""
    of = model.simulation
    condim, bodies, fixed = of.model("geom_condim"), of.model("geom_bodyid"), of.model("body_weldid")
    if any(each > PLAIN for each in condim) or of.count("pair"):
        return
    found = [
        geom
        for geom, body in enumerate(bodies)
        if solid(of, geom) and fixed[int(body)] and of.row("geom_friction", geom, 3)[1] > LITTLE
    ]
    found = [geom for geom in found if PAD.search(f"{of.name('geom', geom)} {of.name('body', int(bodies[geom]))}")]
    if len(found) < 2:
        return
    torsional = max(of.row("geom_friction", geom, 3)[1] for geom in found)
    yield Suspect(
        tuple(of.name("geom", geom) for geom in found),
        "condim",
        f"{int(condim[found[0]])}",
        "4",
        model.set("geom", found, "condim", "4"),
        counted("geoms with a torsional friction that no contact has", len(found)),
        1.0,
        f"A torsional friction of {torsional:.3g} m has no effect: no geom's condim is above {PLAIN}.",
        level="hint",
    )
