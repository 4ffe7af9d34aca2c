"""Letting a model go: what happens when nobody does anything, for as long as the reader's start says."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from clinic.diagnosis.engine import Contact
from clinic.diagnosis.probes.shape import root_of
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import probe

FAST = 100.0  # rad/s, 16 turns a second: above it a joint is too fast


@dataclass(frozen=True)
class State:
    """Where everything is at one moment, in MuJoCo's flat arrays, and the contacts."""

    qpos: tuple[float, ...]
    qvel: tuple[float, ...]
    xpos: tuple[float, ...]
    xipos: tuple[float, ...]
    geom_xpos: tuple[float, ...]
    geom_xmat: tuple[float, ...]
    contacts: tuple[Contact, ...]


def state(simulation: Simulation) -> State:
    """The state as it is now; contacts of flexes, which have no geom, are left out."""
    contacts = tuple(each for each in simulation.engine.contacts() if min(each.geoms) >= 0)
    qpos, qvel, xpos, xipos = (tuple(simulation.data(name)) for name in ("qpos", "qvel", "xpos", "xipos"))
    return State(
        qpos, qvel, xpos, xipos, tuple(simulation.data("geom_xpos")), tuple(simulation.data("geom_xmat")), contacts
    )


@kept
def beginning(simulation: Simulation) -> State:
    """The start that the reader chose."""
    simulation.begin()
    return state(simulation)


@dataclass
class LetGo:
    """What was seen: the number of resets, the fastest hinge or slide in rad/s or m/s, the deepest contact in m.

    `late` are the contacts that carried something in the second half, each as wide apart as it was. `rise` is the
    highest that a body's centre came above its start in m. `end` is None where the run went to infinity.
    """

    resets: int
    fastest: float
    deepest: float
    warnings: dict[str, int]
    end: State | None = None
    rise: float = 0.0
    late: tuple[Contact, ...] = ()


@kept
def let_go(simulation: Simulation) -> LetGo:
    """Runs the model from its start with the controls of the start."""
    made, start = LetGo(0, 0.0, 0.0, {}), beginning(simulation)
    simulation.begin()
    late: dict[tuple[int, int], Contact] = {}
    half = simulation.steps(simulation.begin_with.duration) * simulation.timestep / 2
    for time in simulation.run(simulation.begin_with.duration):
        if simulation.unstable():
            made.resets += 1
            made.warnings = simulation.engine.warnings()
            made.fastest = float("inf")
            break
        made.fastest = max([made.fastest, *map(abs, simulation.data("qvel"))])
        contacts = simulation.engine.contacts()
        distances = [contact.distance for contact in contacts]
        for contact in contacts if time > half else ():
            there = late.get(contact.geoms, contact)
            if contact.force > 0 and min(contact.geoms) >= 0 and there.distance <= contact.distance:
                late[contact.geoms] = contact
        made.deepest = max(made.deepest, -min(distances, default=0.0))
        heights = zip(simulation.data("xipos")[5::3], start.xipos[5::3], strict=True)
        made.rise = max(made.rise, max((now - then for now, then in heights), default=0.0))
    else:
        made.late = tuple(late.values())
        made.warnings, made.end = simulation.engine.warnings(), state(simulation)
    return made


@probe("goes to infinity after letting go")
def resets(simulation: Simulation) -> float:
    """Whether the simulation goes to infinity: 0 or 1."""
    return float(let_go(simulation).resets)


@probe("fastest joint after letting go", "rad/s")
def fastest(simulation: Simulation) -> float:
    """The highest speed of a degree of freedom."""
    return let_go(simulation).fastest


@kept
def model_size(simulation: Simulation) -> float:
    """How large the model is in m: its extent, or its largest tree of bodies where somebody wrote a smaller extent."""
    owner, trees = root_of(simulation), dict[int, list[Sequence[float]]]()
    places = beginning(simulation).xipos
    for body in simulation.moving_bodies:
        trees.setdefault(owner[body], []).append(places[3 * body : 3 * body + 3])
    spreads: list[float] = [max(axis) - min(axis) for tree in trees.values() for axis in zip(*tree, strict=True)]
    return max([simulation.extent, *spreads, 1e-9])


@probe("deepest contact after letting go", "of the model's extent")
def sunk(simulation: Simulation) -> float:
    """How deep the deepest contact is while the model is let go, as a share of its extent."""
    return let_go(simulation).deepest / model_size(simulation)
