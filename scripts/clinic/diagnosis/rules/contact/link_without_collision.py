"""One link of a robot touches nothing, and all the others do.

Its collision geom was forgotten, or has the masks of a geom that is only seen: what meets the robot there goes through
it, up to the next link.

Bad:

    <mujoco>
      <worldbody>
        <body name="base" pos="0 0 0.1">
          <joint axis="0 0 1"/>
          <geom type="cylinder" size="0.08 0.1"/>
          <body name="upper" pos="0 0 0.12">
            <joint axis="0 1 0"/>
            <geom type="capsule" fromto="0 0 0.04 0 0 0.26" size="0.03"/>
            <body name="fore" pos="0 0 0.3">
              <joint axis="0 1 0"/>
              <geom type="capsule" fromto="0 0 0.04 0 0 0.26" size="0.03" contype="0" conaffinity="0"/>
              <body name="wrist" pos="0 0 0.3">
                <joint axis="0 1 0"/>
                <geom type="capsule" fromto="0 0 0.04 0 0 0.1" size="0.03"/>
                <body name="hand" pos="0 0 0.15">
                  <joint axis="0 0 1"/>
                  <geom type="box" pos="0 0 0.04" size="0.04 0.02 0.04"/>
                </body>
              </body>
            </body>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -           <geom type="capsule" fromto="0 0 0.04 0 0 0.26" size="0.03" contype="0" conaffinity="0"/>
    +           <geom type="capsule" fromto="0 0 0.04 0 0 0.26" size="0.03"/>

The number: how many of a robot's links have geoms and none that collides; told is one, or two, of five links and more.
Such a link is more than half as large as the link in the middle and weighs more than 2 % of the robot. It is not by
three quarters inside of the boxes around the links beside it, and the link before it collides. So is one limb, such as
a tail, of up to a third of the links and more than 5 % of the mass. With `--symptom falls-through` it tells all such
links of a robot that is free and stands on others.

When it is wrong: a link that another one encloses.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from clinic.diagnosis.probes.shape import clear, in_box, in_pairs, in_world, masks_told, root_of, solid
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A link that touches nothing"
FAMILIES = ("falls-through", "slips")
AFLOAT = True
UNPLANTED = "some links are left out on purpose"

MANY, FEW, SMALL = 5, 2, 0.5
HEAVY, LIGHT = 0.05, 0.02  # of the robot's mass: a whole limb, one link
ENCLOSED, NEAR, MOST_POINTS = 0.75, 0.01, 300  # of its points; m; of a geom


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The links that alone do not collide, all together."""
    of = model.simulation
    kind = _free_and_bare if model.symptom == FAMILIES[0] else _bare
    found = kind(of)
    if not found:
        return
    geoms = [geom for body in found for geom in of.geoms_of(body)]
    probe = how_many("links without a geom that collides", kind)
    names = (*(of.name("body", body) for body in found), *(of.name("geom", geom) for geom in geoms))
    says = f"{of.name('body', found[0])} has no geom that can touch anything, and the other links have one."
    masks = masks_told(of, geoms[0])
    yield Suspect(names, "contype, conaffinity", masks, "1, 1", (), probe, 0, says, "a geom that collides")


def _bare(of: Simulation) -> list[int]:
    """The links that touch nothing, of robots of which nearly all do."""
    owner, welds = root_of(of), of.model("body_weldid")
    links, hard = _links(of)
    size = {link: max(of.model("geom_rbound")[geom] for geom in geoms) for link, geoms in links.items()}
    robots: dict[int, list[int]] = {}
    for link in links:
        robots.setdefault(owner[link], []).append(link)
    made = []
    for root, robot in sorted(robots.items()):
        if not root:
            continue
        bare = [link for link in robot if link not in hard]
        middle = sorted(size[link] for link in robot)[len(robot) // 2]
        above = {link: int(welds[of.parent(link)]) for link in bare}
        limb = [each for each in bare if above[each] in hard]
        if len(robot) >= MANY and 0 < len(bare) <= FEW:
            large = [each for each in limb if size[each] > SMALL * middle and not _light(of, each)]
            made += [each for each in large if not _enclosed(of, each, links)]
        elif len(robot) >= MANY and 2 * len(bare) < len(robot):
            whole = (_limb(of, first, robot) for first in limb)
            made += [link for links in whole if {*links} <= {*bare} for link in links]
    return made


def _free_and_bare(of: Simulation) -> list[int]:
    """All links that touch nothing, of robots that are free and stand on others of their links."""
    owner, (links, hard) = root_of(of), _links(of)
    standing = {owner[link] for link in hard} & {*of.free_bodies}
    return [link for link in links if link not in hard and owner[link] in standing]


def _links(of: Simulation) -> tuple[dict[int, list[int]], set[int]]:
    """The geoms of each link that can be seen, and the links that can touch something, the world among them."""
    links: dict[int, list[int]] = {}
    for geom, body in enumerate(of.model("geom_bodyid")):
        if not clear(of, geom) or solid(of, geom):
            links.setdefault(int(of.model("body_weldid")[int(body)]), []).append(geom)
    paired = in_pairs(of)
    return links, {
        link for link, geoms in links.items() if any(solid(of, each) or each in paired for each in geoms)
    } | {0}


def _light(of: Simulation, link: int) -> bool:
    """Whether a link and what is fixed to it have next to none of the robot's mass."""
    welds, masses = of.model("body_weldid"), of.model("body_mass")
    own = sum(mass for mass, weld in zip(masses, welds, strict=True) if int(weld) == link)
    return own < LIGHT * of.model("body_subtreemass")[root_of(of)[link]]


def _enclosed(of: Simulation, link: int, links: Mapping[int, Sequence[int]]) -> bool:
    """Whether nearly all of a link is in the boxes around what collides of the links beside it, at the start."""
    welds = of.model("body_weldid")
    above = {each: int(welds[of.parent(each)]) for each in links}
    beside = [geom for each in links if above[each] == link or each == above[link] for geom in links[each]]
    of.begin()
    seen = [point for geom in links[link] for point in in_world(of, geom, MOST_POINTS)]
    inside = [any(in_box(of, geom, point, NEAR) for geom in beside if solid(of, geom)) for point in seen]
    return sum(inside) > ENCLOSED * len(seen)


def _limb(of: Simulation, first: int, robot: list[int]) -> list[int]:
    """A link and those that hang on it, where they are several, up to a third of the robot's, and not light."""
    masses, root = of.model("body_subtreemass"), root_of(of)[first]
    links = [link for link in robot if first in of.ancestors(link)]
    return links if 1 < len(links) <= len(robot) / 3 and masses[first] > HEAVY * masses[root] else []
