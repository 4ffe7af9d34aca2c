"""Two things that should touch have collision masks that do not match.

Two geoms collide where `contype` of one and `conaffinity` of the other have a bit in common. Where they have none,
MuJoCo makes no contact and says nothing: what stands on a floor falls through it.

Bad:

    <mujoco>
      <worldbody>
        <geom name="floor" type="plane" size="1 1 0.1" contype="2" conaffinity="2"/>
        <body name="box" pos="0 0 0.5">
          <freejoint/>
          <geom name="box" type="box" size="0.05 0.05 0.05"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -     <geom name="floor" type="plane" size="1 1 0.1" contype="2" conaffinity="2"/>
    +     <geom name="floor" type="plane" size="1 1 0.1"/>

The number: how far the centre of a body ends below a surface that it began above, 2 s after letting go. MuJoCo's
manual, Computation, Collision detection, has the condition.

When it is wrong: something that is meant to pass, such as a ghost of the target. What has a `<pair>` with the surface
is not told, though only some of its geoms may touch it. A robot that sinks in up to its feet is a hint: some have masks
at the feet alone, for speed, and a task that ends when they fall. A body that a geom without masks marks as a place is
not told: only planes, boxes and what collides at all are taken for surfaces.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import PLANE
from clinic.diagnosis.probes.fall import bare, below, fallen, limit
from clinic.diagnosis.probes.shape import collides, geoms_of_tree, masks_told, pair_of, root_of, solid, swims
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect

TITLE = "Collision masks that do not match"
FAMILIES = ("falls-through", "stuck")
CASE = "box-falls-through-floor"

GHOST = "target|goal|ghost|marker|mocap|visual|reference|hint"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The masks of a surface that nothing touches, else those of what falls through it."""
    simulation = model.simulation
    told: set[tuple[Edit, ...]] = set()
    for root, surface in fallen(simulation):
        whole = root_of(simulation)[root] == root and root not in bare(simulation)
        tree = geoms_of_tree(simulation, root) if whole else simulation.geoms_of(root)
        if meeting := [geom for geom in tree if _meet(simulation, geom, surface)]:
            yield from _sinks_to_its_feet(model, root, surface, meeting) if whole else ()
            continue
        if not tree:
            continue
        own = [geom for geom in tree if solid(simulation, geom)] or _bodily(model, tree)
        others = [geom for geom in range(simulation.count("geom")) if geom != surface and geom not in tree]
        lonely = not any(collides(simulation, surface, geom) for geom in others if solid(simulation, geom))
        solids = any(solid(simulation, geom) for geom in tree)
        if not solids and (_ghost(model, root, tree) or swims(simulation, root)):
            continue
        ghost = not solid(simulation, surface)
        if ghost and not solids and int(simulation.model("geom_type")[surface]) != PLANE:
            continue
        odd = [surface] if (lonely and solids and not _usual(model, surface)) or (ghost and solids) else own
        made: tuple[Edit, ...] = ()
        partner = own[0] if odd == [surface] else surface
        types, affinities = (int(simulation.model(f"geom_{each}")[partner]) for each in ("contype", "conaffinity"))
        if not types and not affinities:
            types = affinities = 1
            made += model.set("geom", [partner], "contype", "1") + model.set("geom", [partner], "conaffinity", "1")
        value = {"contype": str(affinities or types), "conaffinity": str(types or affinities)}
        for attribute, number in value.items():
            made += model.set("geom", odd, attribute, number)
        if made in told:
            continue
        told.add(made)
        names = tuple(simulation.name("geom", geom) for geom in odd)
        body = simulation.name("body", root)
        says = f"No geom of {body} and {simulation.name('geom', surface)} have a bit in common: no contact is made."
        yield Suspect(
            (*names, body),
            "contype, conaffinity",
            masks_told(simulation, odd[0]) if odd else "",
            ", ".join(value.values()),
            made,
            below(root, surface),
            limit(simulation, root),
            says,
            excess=3.0,
        )


def _sinks_to_its_feet(model: ReaderModel, root: int, surface: int, meeting: list[int]) -> Iterator[Suspect]:
    """The geoms of a robot whose links, but for some at its end, pass through what these can stand on."""
    of = model.simulation
    able = {of.body_of("geom", geom) for geom in meeting}
    passing = [geom for geom in geoms_of_tree(of, root) if of.body_of("geom", geom) not in able]
    foot = next((geom for geom in meeting if collides(of, geom, surface)), None)
    if foot is None or root in able:
        return
    masks = {each: f"{int(of.model(f'geom_{each}')[foot])}" for each in ("contype", "conaffinity")}
    edits = tuple(edit for name, value in masks.items() for edit in model.set("geom", passing, name, value))
    links = [body for body in of.below(root) if body not in able and not of.geoms_of(body)] if not passing else []
    names = (*(of.name("body", body) for body in links or [root]), *(of.name("geom", geom) for geom in passing))
    says = (
        f"{of.name('geom', surface)} carries {of.name('body', min(able))}, and the rest of the robot sinks through it."
    )
    yield Suspect(
        names,
        "contype, conaffinity" if passing else "geom",
        masks_told(of, passing[0]) if passing else "none",
        ", ".join(masks.values()) if passing else "one that collides",
        edits,
        below(root, surface),
        limit(of, root),
        says,
        level="hint",
    )


def _ghost(model: ReaderModel, root: int, tree: list[int]) -> bool:
    """Whether it is meant to be passed: by its name, or because one can look through it."""
    simulation = model.simulation
    names = [simulation.names("body")[root], *(simulation.names("geom")[geom] for geom in tree)]
    clear = all(simulation.row("geom_rgba", geom, 4)[3] < 1 for geom in tree)
    return clear or any(re.search(GHOST, name, re.IGNORECASE) for name in names)


def _usual(model: ReaderModel, geom: int) -> bool:
    simulation = model.simulation
    return simulation.model("geom_contype")[geom] == 1 and simulation.model("geom_conaffinity")[geom] == 1


def _bodily(model: ReaderModel, tree: list[int]) -> list[int]:
    """Of geoms that all collide with nothing, those that look made for it, in a group that is hidden; else all."""
    groups = model.simulation.model("geom_group")
    hidden = [geom for geom in tree if groups[geom] >= 3]
    return hidden or tree


def _meet(simulation: Simulation, geom: int, surface: int) -> bool:
    return collides(simulation, geom, surface) or pair_of(simulation, geom, surface) is not None
