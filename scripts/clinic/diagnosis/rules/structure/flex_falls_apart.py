"""A cloth, rope or soft body has nothing that holds it together, or too little.

A `<flexcomp>` without `<edge equality="true"/>` and without elasticity is a swarm of points: it falls to dust. For a
cloth (dimension 2), `young` acts only with `elastic2d`, which is `none` by default.

Bad:

    <mujoco>
      <worldbody>
        <flexcomp name="towel" type="grid" dim="2" count="4 4 1" spacing="0.1 0.1 0.1" pos="0 0 1" radius="0.01">
          <edge damping="0.1"/>
        </flexcomp>
      </worldbody>
    </mujoco>

Good:

    -       <edge damping="0.1"/>
    +       <edge damping="0.1" equality="true"/>

The number: flexcomps that move and have no equality, no stiffness of their edges, no elasticity and no plugin. One of
dimension 3 with elasticity is told where it loses more than 0.7 of its height within 1 s, and with 1000 times the
`young` does not: foam has 1e4 to 1e6 Pa, rubber 1e6 to 1e8.

When it is wrong: grains that are meant to be loose.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, insert, set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.source import Element, Source
from clinic.diagnosis.suspect import Probe, Suspect, counted

TITLE = "A flex that falls apart or goes flat"
FAMILIES = ("explodes", "falls-through", "sags")
UNPLANTED = "no healthy model with a flex is planted with faults"

FLAT = 0.7  # of its height


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Flexcomps of loose points, each."""
    if model.source is None or not model.simulation.gravity:
        return
    yield from _soft(model)
    for flex in model.source.elements("flexcomp"):
        if flex.get("rigid") == "true" or _held(model.source, flex):
            continue
        elastic = flex.first("elasticity")
        flat = flex.get("dim", "2") == "2" and elastic is not None and elastic.get("young", "0") != "0"
        edits: tuple[Edit, ...]
        if flat and elastic is not None:
            says = (
                "young acts on a flex of dimension 2 only with elastic2d, which is none by default: points fall apart."
            )
            attribute, now, value = "elastic2d", elastic.get("elastic2d", "left out"), "both"
            edits = (set_attribute(elastic, attribute, value),)
        else:
            says = "Its edges have no equality and no stiffness, and it has no elasticity: its points fall apart."
            attribute, now, value = "equality", "left out", "true"
            edge = flex.first("edge")
            edits = (
                insert(flex, '<edge equality="true"/>') if edge is None else set_attribute(edge, "equality", "true"),
            )
        name = f'flexcomp "{flex.get("name")}"'
        probe = counted("flexes of loose points", 1)
        yield Suspect((name,), attribute, now, value, edits, probe, 0.5, says, "edges or elasticity that hold it")


def _soft(model: ReaderModel) -> Iterator[Suspect]:
    """Flexes of dimension 3 that go flat, and do not with the young of kPa, each."""
    assert model.source is not None
    for flex in model.source.elements("flexcomp"):
        elastic, name = flex.first("elasticity"), flex.get("name")
        if flex.get("dim") != "3" or elastic is None or name not in model.simulation.names("flex"):
            continue
        young = float(elastic.get("young") or "0")
        value, probe = f"{1000 * young:g}", Probe("height that a flex loses within 1 s", "of its own", _flat, (name,))
        edits = (set_attribute(elastic, "young", value),)
        if young > 0 and model.measured(probe) > FLAT >= model.measured(probe, edits):
            says = f"It goes flat: with young {young:g} Pa it does not carry its own weight."
            told, now = (f'flexcomp "{name}"',), f"{young:g}"
            yield Suspect(told, "young", now, value, edits, probe, FLAT, says, "a body that keeps its shape")


def _flat(of: Simulation, name: str) -> float:
    """The share of its height that a flex loses."""
    of.begin()
    before = _height(of, name)
    for _ in of.run(1.0, samples=4):
        if of.unstable():
            return 0.0
    return 1 - _height(of, name) / before if before > 0 else 0.0


def _height(of: Simulation, name: str) -> float:
    """How tall a flex is as the state is now, in m."""
    flex = of.names("flex").index(name)
    first, count = (int(of.model(f"flex_vert{field}")[flex]) for field in ("adr", "num"))
    heights = of.data("flexvert_xpos")[3 * first + 2 : 3 * (first + count) : 3]
    return max(heights) - min(heights)


def _held(source: Source, flex: Element) -> bool:
    """Whether anything holds the points of a flexcomp to each other."""
    edge, elastic = flex.first("edge"), flex.first("elasticity")
    if flex.first("plugin") is not None or any(flex.get("name") in each.attributes.values() for each in _equal(source)):
        return True
    if edge is not None and (edge.get("equality", "false") != "false" or float(edge.get("stiffness") or "0") > 0):
        return True
    if elastic is None or float(elastic.get("young") or "0") <= 0:
        return False
    return flex.get("dim", "2") != "2" or elastic.get("elastic2d", "none") != "none"


def _equal(source: Source) -> Iterator[Element]:
    return (each for each in source.section("equality") if each.tag.startswith("flex"))
