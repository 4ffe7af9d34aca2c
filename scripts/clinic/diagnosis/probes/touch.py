"""What decides a contact: the parameters of two geoms, mixed as MuJoCo mixes them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import Contact
from clinic.diagnosis.probes.run import let_go
from clinic.diagnosis.probes.shape import pair_of, solid, thickness
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import probe

DRY = {"geom": "1 0.005 0.0001", "pair": "1 1 0.005 0.0001 0.0001"}  # the friction of geoms and pairs by default


@dataclass(frozen=True)
class Deciding:
    """The parameters of a contact of two geoms, and the elements that they come from."""

    dim: int
    friction: float
    kind: str  # "geom" or "pair"
    elements: tuple[int, ...]


def deciding(simulation: Simulation, contact: Contact) -> Deciding:
    """Of a contact's geoms; MuJoCo's manual, Modeling, Contact parameters."""
    if (index := pair_of(simulation, *contact.geoms)) is not None:
        friction = simulation.row("pair_friction", index, 5)[0]
        return Deciding(int(simulation.model("pair_dim")[index]), friction, "pair", (index,))
    priority = simulation.model("geom_priority")
    top = max(priority[geom] for geom in contact.geoms)
    geoms = tuple(sorted({geom for geom in contact.geoms if priority[geom] == top}))
    friction = max(simulation.row("geom_friction", geom, 3)[0] for geom in geoms)
    dim = max(int(simulation.model("geom_condim")[geom]) for geom in geoms)
    return Deciding(dim, friction, "geom", geoms)


def resting(simulation: Simulation) -> list[tuple[Contact, Deciding]]:
    """The contacts that carry something in the second half of the run, and at its end."""
    run = let_go(simulation)
    if run.end is None:
        return []
    there = {contact.geoms: contact for contact in (*run.end.contacts, *run.late) if contact.force > 0}
    return [(each, deciding(simulation, each)) for each in there.values()]


def with_like(simulation: Simulation, found: Iterable[Deciding], is_like: Callable[[int], bool]) -> list[Deciding]:
    """The same and all other geoms that can touch and are like them, for they touch once these are mended."""
    made = list(found)
    like = tuple(geom for geom in range(simulation.count("geom")) if solid(simulation, geom) and is_like(geom))
    geoms = any(each.kind == "geom" for each in made)
    return [*made, Deciding(3, 0.0, "geom", like)] if like and geoms else made


def edits_of(
    model: ReaderModel, of: Iterable[Deciding], attribute: str, value: str | Mapping[str, str]
) -> tuple[Edit, ...]:
    """Gives an attribute of all deciding elements a value, or one by their kind; empty where one has no place."""
    found = {(each.kind, index) for each in of for index in each.elements}
    made: tuple[Edit, ...] = ()
    for kind in ("geom", "pair"):
        indices = sorted(index for other, index in found if other == kind)
        given = value if isinstance(value, str) else value[kind]
        edits = model.set(kind, indices, attribute, given) if indices else ()
        if indices and not edits:
            return ()
        made += edits
    return made


def names_of(simulation: Simulation, of: Iterable[Deciding]) -> tuple[str, ...]:
    """The deciding elements' names."""
    found = sorted({(each.kind, index) for each in of for index in each.elements})
    return tuple(simulation.name(kind, index) for kind, index in found)


@probe("deepest contact 2 s after letting go", "of the geom's thickness")
def depth(simulation: Simulation) -> float:
    """How deep contacts are once the model was let go, as a share of the thinner geom's thickness."""
    made, end = 0.0, let_go(simulation).end
    for contact in end.contacts if end else ():
        thick = min(thickness(simulation, geom) for geom in contact.geoms)
        if contact.force > 0 and 0 < thick < float("inf"):
            made = max(made, -contact.distance / thick)
    return made if end else float("inf")


def all_alike(simulation: Simulation, field: str, value: float) -> bool:
    """Whether all geoms that collide have that value."""
    return all(
        simulation.model(field)[geom] == value for geom in range(simulation.count("geom")) if solid(simulation, geom)
    )
