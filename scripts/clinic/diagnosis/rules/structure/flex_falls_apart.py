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
dimension 3 with elasticity is told where it loses more than 0.7 of its height within 1 s, or 0.5 where the weight on
its base is more than `young`, and with 1000 times the `young` does not: foam has 1e4 to 1e6 Pa, rubber 1e6 to 1e8. And
one that explodes within 200 steps, and does not with a tenth, a hundredth or a thousandth of the `damping` of its
elasticity: the steps are too long for that.

When it is wrong: grains that are meant to be loose.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from clinic.diagnosis.edit import Edit, insert, set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.source import Element, Source
from clinic.diagnosis.suspect import Probe, Suspect, counted

TITLE = "A flex that falls apart, goes flat or bursts"
FAMILIES = ("explodes", "falls-through", "sags")
UNPLANTED = "no healthy model with a flex is planted with faults"

FLAT, HALF = 0.7, 0.5  # of its height; the same where more weight is on its base than young
PRESSED = 1.0  # weight on its base over young: it would be shorter by all of its height
LARGE = 600  # degrees of freedom, of which so many steps take long
LONG, SOON, STEPS = 2500, 200, 20  # steps of a run, until it explodes, and from look to look


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Flexcomps of loose points, each."""
    if model.source is None or not model.simulation.gravity:
        return
    yield from _burst(model)
    yield from _soft(model)
    for flex in model.source.elements("flexcomp"):
        if flex.get("rigid") == "true" or _held(model.source, flex) or _pinned(model.simulation, flex):
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
        large = model.simulation.count("dof") > LARGE
        steps = LONG if not large and young > 0 and _weight_on_base(model.simulation, flex) > PRESSED * young else 0
        probe = Probe("height that a flex loses within 1 s", "of its own", _flat, (name, steps))
        value = f"{1000 * young:g}"
        edits = (set_attribute(elastic, "young", value),)
        most = HALF if steps else FLAT
        if young > 0 and model.measured(probe) > most >= model.measured(probe, edits):
            says = f"It goes flat: with young {young:g} Pa it does not carry its own weight."
            told, now = (f'flexcomp "{name}"',), f"{young:g}"
            yield Suspect(told, "young", now, value, edits, probe, most, says, "a body that keeps its shape")


def _burst(model: ReaderModel) -> Iterator[Suspect]:
    """Flexes with elasticity that explode by its damping, each."""
    assert model.source is not None
    probe = Probe("explosions within 200 steps", "", _explodes)
    for flex in model.source.elements("flexcomp"):
        elastic = flex.first("elasticity")
        damping = float((elastic.get("damping") if elastic is not None else "") or "0")
        if elastic is None or damping <= 0 or not model.measured(probe):
            continue
        for less in (10, 100, 1000):
            value = f"{damping / less:g}"
            edits = (set_attribute(elastic, "damping", value),)
            if not model.measured(probe, edits):
                says = f"It explodes at once, and with damping {value} s it does not: the steps are too long for it."
                told, now = (f'flexcomp "{flex.get("name")}"',), f"{damping:g}"
                yield Suspect(told, "damping", now, value, edits, probe, 0.5, says, "a body that stays whole")
                break


def _explodes(of: Simulation) -> float:
    """1 where the run becomes unstable soon, else 0."""
    of.begin()
    for _ in range(min(SOON, of.steps(1.0)) // STEPS):
        of.engine.step(STEPS)
        if of.unstable():
            return 1.0
    return 0.0


def _weight_on_base(of: Simulation, flex: Element) -> float:
    """The weight of a flex over the area of the box around it, in Pa; no less rests on its base."""
    of.begin()
    wide, deep, _ = (max(row) - min(row) for row in _points(of, flex.get("name") or ""))
    return float(flex.get("mass") or "1") * of.gravity / max(wide * deep, 1e-9)


def _flat(of: Simulation, name: str, steps: int) -> float:
    """The share of its height that a flex loses; in so many steps at most, where a large model would do fewer."""
    of.begin()
    before, left = _height(of, name), min(steps, math.ceil(1 / of.timestep))
    for _ in range(left // STEPS):
        of.engine.step(STEPS)
    for _ in of.run(1.0, samples=4) if not left else ():
        if of.unstable():
            return 0.0
    return 1 - _height(of, name) / before if before > 0 else 0.0


def _height(of: Simulation, name: str) -> float:
    """How tall a flex is as the state is now, in m."""
    heights = _points(of, name)[2]
    return max(heights) - min(heights)


def _points(of: Simulation, name: str) -> list[Sequence[float]]:
    """Where the points of a flex are in the world, in m: all x, all y, all z."""
    flex = of.names("flex").index(name)
    first, count = (int(of.model(f"flex_vert{field}")[flex]) for field in ("adr", "num"))
    places = of.data("flexvert_xpos")[3 * first : 3 * (first + count)]
    return [places[axis::3] for axis in range(3)]


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


def _pinned(of: Simulation, flex: Element) -> bool:
    """Whether all points of a flexcomp are pinned to one body."""
    name = flex.get("name")
    if name not in of.names("flex"):
        return False
    each = of.names("flex").index(name)
    first, count = (int(of.model(f"flex_vert{field}")[each]) for field in ("adr", "num"))
    bodies = {int(body) for body in of.model("flex_vertbodyid")[first : first + count]}
    return len(bodies) == 1 and min(bodies) >= 0


def _equal(source: Source) -> Iterator[Element]:
    return (each for each in source.section("equality") if each.tag.startswith("flex"))
