"""A `<pair>` names a geom that another one has already, and is called after a geom that none has.

A line is copied, its name is changed and the geom is not. The one contact is made twice, and the other, where the masks
of its geoms are off because pairs decide, not at all: that foot passes through the floor.

Bad:

    <mujoco>
      <worldbody>
        <geom name="floor" type="plane" size="1 1 0.1" contype="0" conaffinity="0"/>
        <body pos="0 0 0.1">
          <freejoint/>
          <geom name="left_foot" size="0.05" pos="0 0.1 0" contype="0" conaffinity="0"/>
          <geom name="right_foot" size="0.05" pos="0 -0.1 0" contype="0" conaffinity="0"/>
        </body>
      </worldbody>
      <contact>
        <pair name="left_foot_floor" geom1="left_foot" geom2="floor"/>
        <pair name="right_foot_floor" geom1="left_foot" geom2="floor"/>
      </contact>
    </mujoco>

Good:

    -     <pair name="right_foot_floor" geom1="left_foot" geom2="floor"/>
    +     <pair name="right_foot_floor" geom1="right_foot" geom2="floor"/>

The number: how many pairs are of the same two geoms as another one, and have a name that differs from that one's as the
name of a geom without such a pair differs from theirs. Eleven of 385 healthy models have pairs twice, and none of those
is called after another geom.

When it is wrong: a name that says something else than what it pairs.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.copied import Line, misled
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A pair of another geom than its name says"
FAMILIES = ("falls-through", "slips")
UNPLANTED = "the names of pairs tell it alone"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each pair that is there twice, with the geom of it that should be another one."""
    of = model.simulation
    probe = how_many("pairs of another geom than they are called after", _copied)
    for pair, (geom, meant) in _copied(of).items():
        element, now = model.element("pair", pair), of.names("geom")[geom]
        attribute = "geom1" if element is not None and element.get("geom1") == now else "geom2"
        names = of.name("pair", pair), of.name("geom", geom)
        says = f"Another pair is of the same two geoms, and none is of {meant} and the other one, as its name says."
        edits = model.set("pair", [pair], attribute, meant)
        yield Suspect(names, attribute, now, meant, edits, probe, 0, says, meant)


def _copied(of: Simulation) -> dict[int, tuple[int, str]]:
    """By pair of the same two geoms as another one: the geom that its name contradicts, and what is meant."""
    geoms = [tuple(int(of.model(f"pair_geom{side}")[pair]) for side in (1, 2)) for pair in range(of.count("pair"))]
    names, made = of.names("geom"), dict[int, tuple[int, str]]()
    for other in {geom for both in geoms for geom in both}:
        own = {pair: sum(both) - other for pair, both in enumerate(geoms) if other in both}
        lines = {pair: Line(names[geom], (of.names("pair")[pair],)) for pair, geom in own.items()}
        free = [name for geom, name in enumerate(names) if geom not in (other, *own.values())]
        made |= {pair: (own[pair], meant) for pair, meant in misled(lines, free).items()}
    return made
