"""An `<exclude>` forbids a contact that is needed.

`<exclude>` keeps two bodies from touching each other; only a `<pair>` of their geoms still does. It is meant for
relatives that overlap. Between a robot or an object and the world, it takes the floor away.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body name="box" pos="0 0 0.5">
          <freejoint/>
          <geom type="box" size="0.05 0.05 0.05"/>
        </body>
      </worldbody>
      <contact>
        <exclude body1="world" body2="box"/>
      </contact>
    </mujoco>

Good:

    -   <contact>
    -     <exclude body1="world" body2="box"/>
    -   </contact>

The number: how far the centre of a body ends below a surface that it began above, 2 s after letting go. And how many
excludes are between the world and a part that a robot stands on: it reaches as low as any other part, to within 2 % of
the robot's height, or 15 % for the end of a limb, at the start or in the first keyframe.

When it is wrong: something that is meant to pass.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import delete
from clinic.diagnosis.engine import PLANE
from clinic.diagnosis.probes.fall import below, fallen, limit
from clinic.diagnosis.probes.key import start_at
from clinic.diagnosis.probes.shape import boxes, falling, geoms_of_tree, in_pairs, root_of, solid
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "An exclude that forbids a contact that is needed"
FAMILIES = ("falls-through",)
LEVEL = "cause"
UNPLANTED = "in the healthy models several bodies touch the floor: one exclusion drops nothing through it"

NEAR, END = 0.02, 0.15  # of the height of a robot: so much higher than its lowest point may a foot be, or a limb's end


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The excludes between what falls and what it falls through."""
    simulation, owner = model.simulation, root_of(model.simulation)
    names = ["world", *simulation.names("body")[1:]]
    if model.source is None:
        return
    written = [each for each in model.source.section("contact") if each.tag == "exclude"]
    for root, surface in fallen(simulation):
        body = simulation.body_of("geom", surface)
        meant = []
        for each in written:
            bodies = {names.index(each.get(side)) for side in ("body1", "body2") if each.get(side) in names}
            if body in bodies and any(owner[other] == root for other in bodies):
                meant.append(each)
        if meant:
            most, says = limit(simulation, root), "The pair is taken out of collision detection."
            yield Suspect(
                (simulation.name("body", root), simulation.name("body", body)), "exclude", "there", "removed",
                tuple(map(delete, meant)), below(root, surface), most, says, excess=4.0,
            )  # fmt: skip
    yield from _feet(model, written)


def _feet(model: ReaderModel, written: list[Element]) -> Iterator[Suspect]:
    """The excludes between the floor and what a robot stands on, where it does not fall through."""
    of = model.simulation
    if not written or not any(int(of.model("geom_type")[geom]) == PLANE for geom in of.geoms_of(0)):
        return
    paired = {of.body_of("geom", geom) for geom in in_pairs(of)}  # which touch it all the same
    owner, lowest = root_of(of), {of.names("body")[body]: body for body in _lowest(of) - paired}
    fall = {root for root, _ in fallen(of)}
    meant = []
    for each in written:
        other = {each.get("body1"): each.get("body2"), each.get("body2"): each.get("body1")}.get("world")
        if other in lowest and owner[lowest[other]] not in fall:
            meant.append((each, of.name("body", lowest[other])))
    if meant:
        says = f"{meant[0][1]} is what it stands on, and the floor is excluded from touching it."
        probe = counted("excludes of the floor and what stands on it", len(meant))
        edits = tuple(delete(each) for each, _ in meant)
        names = tuple(name for _, name in meant)
        yield Suspect(names, "exclude", "there", "removed", edits, probe, 0, says, "no such exclude", level="hint")


def _lowest(of: Simulation) -> set[int]:
    """The bodies with a solid geom about as low as the lowest of their tree, which can fall."""
    made = set[int]()
    for key in range(-1, min(1, of.count("key"))):
        start_at(of, key)
        for root in falling(of):
            found = boxes(of, [geom for geom in geoms_of_tree(of, root) if solid(of, geom)])
            lows = {geom: centre[2] - half[2] for geom, (centre, half) in found.items()}
            tops = [centre[2] + half[2] for centre, half in found.values()]
            lowest = min(lows.values(), default=0.0)
            height = max(tops, default=0.0) - lowest
            for geom, low in lows.items():
                body = of.body_of("geom", geom)
                if low <= lowest + (NEAR if body in of.children else END) * height:
                    made.add(body)
    return made
