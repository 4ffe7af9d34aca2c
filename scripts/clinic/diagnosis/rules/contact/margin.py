"""Contacts push before anything touches: a large `margin`.

`margin` is a layer around the geom: things rest on it, in the air. The margins of both geoms are added. Before MuJoCo
3.9 the `gap` was taken off: `margin` = `gap` made contacts that are seen and do not push. Now the same text lifts
things by the margin.

Bad:

    <mujoco>
      <worldbody>
        <geom name="floor" type="plane" size="1 1 0.1"/>
        <body name="box" pos="0 0 0.2">
          <freejoint/>
          <geom name="box" type="box" size="0.05 0.05 0.05" margin="0.05"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <geom name="box" type="box" size="0.05 0.05 0.05" margin="0.05"/>
    +       <geom name="box" type="box" size="0.05 0.05 0.05" margin="0.0005"/>

The number: the widest gap of a contact that carries something, 2 s after letting go, as a share of the thinner geom's
thickness; below 0.2 is well, and below 0.5 % of how far the thing itself reaches. Where nothing rests, a margin of more
than 5 cm and a fifth of the largest thing is a hint. MuJoCo's manual, Computation, Margin and gap.

When it is wrong: an air bearing.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import Contact
from clinic.diagnosis.probes.overlap import tree_extent
from clinic.diagnosis.probes.run import let_go
from clinic.diagnosis.probes.shape import falling, root_of, roots, solid, thickness
from clinic.diagnosis.probes.touch import resting
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Contacts that push before anything touches"
FAMILIES = ("stuck", "sinks", "jumps-at-start")

MOST = 0.2  # of the thinner geom's thickness
SEEN = 0.005  # of how far the thing reaches
THICK, PART = 0.05, 0.2  # m, and of how far the largest thing reaches


def _hovers(simulation: Simulation) -> float:
    made = 0.0
    for contact in _floating(simulation):
        thick = min(thickness(simulation, geom) for geom in contact.geoms)
        if 0 < thick < float("inf") and contact.distance > SEEN * _reach(simulation, contact):
            made = max(made, contact.distance / thick)
    return made if let_go(simulation).end else float("inf")


def _reach(simulation: Simulation, contact: Contact) -> float:
    """How far the smaller thing of a contact that can fall reaches, in m."""
    owner, bodies = root_of(simulation), simulation.model("geom_bodyid")
    trees = {owner[int(bodies[geom])] for geom in contact.geoms} & set(falling(simulation))
    return min((tree_extent(simulation, root) for root in trees), default=0.0)


def _floating(simulation: Simulation) -> list[Contact]:
    """The contacts that carry something that can fall and touch nothing."""
    falls, owner, bodies = falling(simulation), root_of(simulation), simulation.model("geom_bodyid")
    apart = [contact for contact, _ in resting(simulation) if contact.distance > 0]
    return [each for each in apart if any(owner[int(bodies[geom])] in falls for geom in each.geoms)]


def _thick(model: ReaderModel) -> Iterator[Suspect]:
    """The margins that are thick where nothing rests on them, so that they only keep things away."""
    of, margins = model.simulation, model.simulation.model("geom_margin")
    if max(margins, default=0.0) <= THICK:
        return
    reach = max((tree_extent(of, root) for root in roots(of)), default=0.0)
    wide = [geom for geom, margin in enumerate(margins) if margin > max(THICK, PART * reach) and solid(of, geom)]
    if wide and reach > 0:
        most, names = max(margins[geom] for geom in wide), tuple(of.name("geom", geom) for geom in wide)
        probe = Probe("widest margin", "m", _widest, dynamic=False)
        says = f"It pushes what is less than {most:g} m away; the largest thing here reaches {reach:.2g} m."
        edits, limit = model.set("geom", wide, "margin", "0"), max(THICK, PART * reach)
        healthy = "0, MuJoCo's default"
        yield Suspect(names, "margin", f"{most:g}", "0", edits, probe, limit, says, healthy, level="hint")


def _widest(of: Simulation) -> float:
    return max(of.model("geom_margin"))


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The margins of the geoms that hover."""
    simulation = model.simulation
    margins = simulation.model("geom_margin")
    geoms = {geom for contact in _floating(simulation) for geom in contact.geoms}
    if not geoms:
        yield from _thick(model)
    least = 0.5 * max((margins[geom] for geom in geoms), default=0.0)
    wide = [g for g in range(len(margins)) if margins[g] > 0 and (g in geoms or margins[g] >= least > 0)]
    pairs = [i for i, each in enumerate(simulation.model("pair_margin")) if each > 0]
    if not wide and not pairs:
        return
    edits = (model.set("geom", wide, "margin", "0") if wide else ()) + (
        model.set("pair", pairs, "margin", "0") if pairs else ()
    )
    most = max([margins[geom] for geom in wide] + [simulation.model("pair_margin")[i] for i in pairs])
    names = tuple(simulation.name(kind, i) for kind, some in (("geom", wide), ("pair", pairs)) for i in some)
    probe = Probe("widest gap of a contact that carries, at rest", "of the geom's thickness", _hovers)
    says = f"A margin of {most:g} m carries before anything touches."
    yield Suspect(names, "margin", f"{most:g}", "0", edits, probe, MOST, says, "0, MuJoCo's default", excess=3.0)
