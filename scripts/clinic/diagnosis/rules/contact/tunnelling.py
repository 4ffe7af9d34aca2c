"""Something fast passes through something thin.

MuJoCo looks for contacts once a step, and they are soft: what hits a floor at 6 m/s sinks in by 45 mm with the default
time constant of 0.02 s. Past the middle of a thin geom, the contact pushes it out at the other side. The flag
`speculative` of MuJoCo 4.0 stops this block, too.

Bad:

    <mujoco>
      <worldbody>
        <geom name="shelf" type="box" pos="0 0 0.2" size="0.08 0.05 0.002"/>
        <body name="block" pos="0 0 2">
          <freejoint/>
          <geom name="block" type="box" size="0.01 0.01 0.01" mass="0.03"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -     <geom name="shelf" type="box" pos="0 0 0.2" size="0.08 0.05 0.002"/>
    +     <geom name="shelf" type="box" pos="0 0 0.15" size="0.08 0.05 0.05"/>

The number: how far the centre of a body ends below a surface that it began above, 2 s after letting go, although the
masks of the two match. Tried: 1/2 to 1/8 of the timestep with a contact of twice that as its time constant.

When it is wrong: a body that is pushed through on purpose.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import PLANE
from clinic.diagnosis.probes.equalities import tied
from clinic.diagnosis.probes.fall import below, fallen, limit
from clinic.diagnosis.probes.overlap import buried
from clinic.diagnosis.probes.shape import collides, geoms_of_tree
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect

TITLE = "Too fast for a thin contact"
FAMILIES = ("falls-through", "sinks")
LEVEL = "cause"
UNPLANTED = "nothing in the healthy models is thrown at something thin"
CASE = "ball-passes-through-shelf"

BURIED = 0.1  # what begins inside of something has another fault


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The timestep and `solref` of what passes through something although it may touch it."""
    simulation = model.simulation
    for root, surface in fallen(simulation):
        if buried(simulation).get(root, (0.0,))[0] > BURIED:
            continue
        own = [geom for geom in geoms_of_tree(simulation, root) if collides(simulation, geom, surface)]
        pairs = (frozenset(simulation.body_of("geom", one) for one in (geom, surface)) for geom in own)
        if not own or int(simulation.model("geom_type")[surface]) == PLANE or len(own) > 8:
            continue
        if not tied(simulation).isdisjoint(pairs):
            continue  # an equality keeps the one in the other
        probe, most = below(root, surface), limit(simulation, root)
        for divisor in (2, 4, 8):
            step = simulation.timestep / divisor
            value = f"{2 * step:g} 1"
            edits = model.option("timestep", f"{step:g}") + model.set("geom", [*own, surface], "solref", value)
            if model.measured(probe, edits) <= most:
                names = tuple(simulation.name("geom", geom) for geom in (*own, surface))
                says = f'At {step:g} s and solref="{value}" the same motion is stopped.'
                now = f"{simulation.timestep:g} s"
                yield Suspect(
                    (*names, "the timestep"), "timestep, solref", now, f"{step:g} s, {value}", edits, probe, most, says
                )
                return
