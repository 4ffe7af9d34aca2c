"""Friction next to nothing, or a slippery geom that has the last word.

Of two geoms the larger friction counts, unless one has a higher `priority`: then its own counts alone, however small. A
`<pair>` has its own.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="5 5 0.1"/>
        <body name="box" pos="0 0 0.05">
          <freejoint/>
          <geom name="box" type="box" size="0.05 0.05 0.05" friction="0.05" priority="1"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <geom name="box" type="box" size="0.05 0.05 0.05" friction="0.05" priority="1"/>
    +       <geom name="box" type="box" size="0.05 0.05 0.05" friction="0.5" priority="1"/>

The number: a push, once at rest, at the speed of a fall over a twentieth of the radius of the smallest thing that is
pushed; with friction 0.3 it would be over when the probe looks. Below 0.5 of the push's speed, which is friction 0.15,
is well; tried is friction below 0.12. PTFE on PTFE has 0.04, wet ice less, steel on steel 0.4 and more. Geoms without
friction that can touch each other later are a hint, and so are the pads of fingers that decide by their priority, with
less than 0.05: they touch nothing at the start.

When it is wrong: ice.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from clinic.diagnosis.engine import CONTACTS_OFF, FREE
from clinic.diagnosis.probes.grasp import PAD
from clinic.diagnosis.probes.push import slides_on
from clinic.diagnosis.probes.shape import collides, pair_of, solid
from clinic.diagnosis.probes.touch import DRY, edits_of, names_of, resting, with_like
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.probes.wheels import CASTER
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, how_many

TITLE = "Friction next to nothing"
FAMILIES = ("slips", "rolls-on")

LOW, MOST = 0.12, 0.5
GRIP = 0.05  # friction
NONE, MANY = 0.001, 60  # friction; geoms of which pairs are looked at


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """What decides the contacts that carry something with friction below 0.12."""
    simulation = model.simulation
    low = [decides for _, decides in resting(simulation) if decides.dim > 1 and decides.friction < LOW]
    low = [each for each in low if not any(map(CASTER.search, names_of(simulation, [each])))]
    if not low or model.measured(slides_on()) <= MOST:
        yield from _none(model)
        yield from _pads(model)
        return
    least = min(each.friction for each in low)
    frictions = simulation.model("geom_friction")
    names = names_of(simulation, low)
    priority = simulation.model("geom_priority")
    first = [each for each in low if each.kind == "geom" and any(priority[geom] for geom in each.elements)]
    healthy = "0.15 to 2 for dry solids"
    if first and len(first) == len(low):
        says = f"The geom with the higher priority has the last word, and its friction is {least:g}."
        edits = edits_of(model, first, "priority", "0")
        if edits and model.measured(slides_on(), edits) <= MOST:
            top = max(priority[geom] for each in first for geom in each.elements)
            yield Suspect(
                names,
                "priority",
                f"{int(top)}",
                "0",
                edits,
                slides_on(),
                MOST,
                says,
                healthy,
                excess=LOW / max(least, 1e-6),
            )
            return
    says = f"Friction {least:g} holds nothing on a slope steeper than {100 * least:.2g} %."
    low = with_like(simulation, low, lambda geom: frictions[3 * geom] < LOW)
    edits = edits_of(model, low, "friction", DRY)
    yield Suspect(
        names, "friction", f"{least:g}", "1", edits, slides_on(), MOST, says, healthy, excess=LOW / max(least, 1e-6)
    )


def _none(model: ReaderModel) -> Iterator[Suspect]:
    """Geoms without any friction that can touch each other, and do not yet: a hint."""
    of = model.simulation
    frictions, dims = of.model("geom_friction"), of.model("geom_condim")
    bare = [geom for geom in range(of.count("geom")) if frictions[3 * geom] < NONE and dims[geom] > 1]
    bare = [] if int(of.model("opt.disableflags")[0]) & CONTACTS_OFF else bare[:MANY]
    meet = [pair for pair in combinations(bare, 2) if collides(of, *pair) and _may_touch(of, *pair)]
    if meet:
        geoms = tuple(dict.fromkeys(geom for pair in meet for geom in pair))
        yield Suspect(
            tuple(of.name("geom", geom) for geom in geoms),
            "friction",
            f"{frictions[3 * geoms[0]]:g}",
            "1",
            (),
            Probe("geoms without friction that can touch each other", "", _bare, (geoms,), dynamic=False),
            1.5,
            "Where they touch each other there is no friction, although condim asks for it.",
            "0.15 to 2 for dry solids",
        )


def _pads(model: ReaderModel) -> Iterator[Suspect]:
    """Fingers that hold nothing, for their pads have the last word on every contact."""
    of = model.simulation
    if found := _slick_pads(of):
        rows = {geom: of.row("geom_friction", geom, 3) for geom in found}
        values = {geom: written((1.0, *row[1:])) for geom, row in rows.items()}
        names, least = tuple(of.name("geom", geom) for geom in found), min(row[0] for row in rows.values())
        says = f"The pads of fingers have the last word by their priority, and hold nothing with friction {least:g}."
        edits = model.set_each("geom", "friction", values)
        probe = how_many("pads without a grip", _slick_pads)
        healthy = "0.15 to 2 for dry solids"
        yield Suspect(names, "friction", f"{least:g}", "1", edits, probe, 0, says, healthy, level="hint")


def _slick_pads(of: Simulation) -> list[int]:
    """The geoms of fingers whose priority decides, with friction next to nothing where condim asks for some."""
    made = []
    for geom, priority in enumerate(of.model("geom_priority")):
        body = of.body_of("geom", geom)
        hinged = any(of.joint_type(joint) != FREE for each in of.ancestors(body) for joint in of.joints_of(each))
        called = PAD.search(f"{of.names('geom')[geom]} {of.names('body')[body]}")
        low = of.model("geom_friction")[3 * geom] < GRIP and of.model("geom_condim")[geom] > 1
        if priority > 0 and low and solid(of, geom) and hinged and called:
            made.append(geom)
    return made


def _may_touch(of: Simulation, one: int, other: int) -> bool:
    """Whether nothing but the masks decides, and the two are not of one body, or of a body and its parent."""
    welds, bodies = of.model("body_weldid"), of.model("geom_bodyid")
    mine, theirs = (int(welds[int(bodies[geom])]) for geom in (one, other))
    related = mine == theirs or mine == welds[of.parent(theirs)] or theirs == welds[of.parent(mine)]
    low, high = sorted((int(bodies[one]), int(bodies[other])))
    excluded = (low << 16) + high in of.model("exclude_signature")
    return not related and not excluded and pair_of(of, one, other) is None


def _bare(of: Simulation, geoms: tuple[int, ...]) -> float:
    return float(sum(of.model("geom_friction")[3 * geom] < NONE for geom in geoms))
