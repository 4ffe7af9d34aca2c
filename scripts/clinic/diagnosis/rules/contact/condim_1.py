"""Contacts without friction: `condim="1"`.

With `condim="1"` a contact pushes along its normal and nothing else, whatever `friction` says. Things slide as on ice,
piles come apart, wheels spin.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="5 5 0.1" condim="1"/>
        <body name="box" pos="0 0 0.05">
          <freejoint/>
          <geom name="box" type="box" size="0.05 0.05 0.05" condim="1"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -     <geom type="plane" size="5 5 0.1" condim="1"/>
    +     <geom type="plane" size="5 5 0.1"/>

    -       <geom name="box" type="box" size="0.05 0.05 0.05" condim="1"/>
    +       <geom name="box" type="box" size="0.05 0.05 0.05"/>

The number: a push, once at rest, at the speed of a fall over a twentieth of the radius of the smallest thing that is
pushed; with friction 0.3 it would be over when the probe looks. Below 0.3 of the push's speed is well.

When it is wrong: a puck on air. A robot of which some geoms have friction, such as its feet, is left alone.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.push import slides_on
from clinic.diagnosis.probes.shape import geoms_of_tree, root_of, solid
from clinic.diagnosis.probes.touch import all_alike, edits_of, names_of, resting, with_like
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect

TITLE = "Contacts without friction"
FAMILIES = ("slips", "rolls-on")
CASE = "crate-slides-off-table"

MOST = 0.3  # of the push's speed


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """What decides the contacts that carry something and have one dimension."""
    simulation = model.simulation
    bodies, owner = simulation.model("geom_bodyid"), root_of(simulation)
    everything = all_alike(simulation, "geom_condim", 1)
    meant = []
    for contact, decides in resting(simulation):
        trees = {owner[int(bodies[geom])] for geom in contact.geoms} - {0}
        dims = [
            simulation.model("geom_condim")[geom]
            for root in trees
            for geom in geoms_of_tree(simulation, root)
            if solid(simulation, geom)
        ]
        if decides.dim == 1 and (everything or all(dim == 1 for dim in dims) or decides.kind == "pair"):
            meant.append(decides)
    if everything:
        meant = with_like(simulation, meant, lambda geom: True)
    if meant:
        says = "With condim 1 a contact has no friction, whatever `friction` says."
        edits = edits_of(model, meant, "condim", "3")
        yield Suspect(
            names_of(simulation, meant), "condim", "1", "3", edits, slides_on(), MOST, says,
            "3, MuJoCo's default", excess=10.0,
        )  # fmt: skip
