"""A tool hangs on a link's origin, beside the site that the link has for it.

An arm's last link has a site for what is mounted on it: `attachment_site`, `flange`. A hand that is put into the link
without that site's `pos` and `quat` sits in the wrist, or looks to the side.

Bad:

    <mujoco>
      <worldbody>
        <body name="wrist" pos="0 0 0.5">
          <joint axis="0 1 0"/>
          <geom type="capsule" fromto="0 0 0 0 0.1 0" size="0.04"/>
          <site name="attachment_site" pos="0 0.1 0" quat="-1 1 0 0"/>
          <body name="hand">
            <geom type="box" size="0.03 0.06 0.03" pos="0 0 0.03"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <body name="hand">
    +       <body name="hand" pos="0 0.1 0" quat="-1 1 0 0">

The number: how far a body without a joint, with neither place nor turn of its own, is from the only site of its parent
that is called attachment, flange, mount, tool or TCP: more than 1 cm. It is the only such body there, can touch things,
nothing else is at the site, and it is not drawn there.

When it is wrong: a part of the link that is written as a body.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import orient, set_attribute
from clinic.diagnosis.probes.shape import solid
from clinic.diagnosis.probes.vector import norm, sub, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A tool beside the site that it belongs to"
FAMILIES = ("wrong-numbers", "jumps-at-start", "drifts")
AFLOAT = True
UNPLANTED = "few healthy models have a tool in a body of its own, and a site for it"

PLACE = re.compile(r"attach|flange|mount|tool|tcp", re.IGNORECASE)
NEAR = 0.01  # m


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each tool that its link's site calls elsewhere."""
    of = model.simulation
    for link, children in of.children.items():
        bare = [body for body in children if _bare(of, body)]
        if len(bare) != 1 or any(_sites(of, body) and _off(of, body) <= NEAR for body in children):
            continue
        (body,), sites, element = bare, _sites(of, bare[0]), model.element("body", bare[0])
        if len(sites) != 1 or element is None or _off(of, body) <= NEAR or _drawn_there(of, body, sites[0]):
            continue
        place, turn = written(of.row("site_pos", sites[0], 3)), written(of.row("site_quat", sites[0], 4))
        edits = set_attribute(element, "pos", place), *orient(element, "quat", turn)
        site = of.name("site", sites[0])
        says = f"It hangs on the origin of {of.name('body', link)}, whose {site} is {100 * _off(of, body):.3g} cm away."
        probe = Probe("a tool from the site of its link", "m", _off, (body,), dynamic=False)
        yield Suspect((of.name("body", body), site), "pos, quat", "left out", f"{place}, {turn}", edits, probe, NEAR,
                      says, "at the site")  # fmt: skip


def _bare(of: Simulation, body: int) -> bool:
    """Whether a body is its parent's origin, and something hangs on it that can touch."""
    here = not any(of.row("body_pos", body, 3)) and abs(of.row("body_quat", body, 4)[0]) == 1
    touches = any(solid(of, geom) for each in of.below(body) for geom in of.geoms_of(each))
    return here and not of.joints_of(body) and touches


def _drawn_there(of: Simulation, body: int, site: int) -> bool:
    """Whether a body's own geoms are nearer to a site than to its origin: drawn in the frame of the link."""
    there = of.row("site_pos", site, 3)
    places = [of.row("geom_pos", geom, 3) for geom in of.geoms_of(body)]
    return any(norm(sub(place, there)) < norm(place) for place in places)


def _sites(of: Simulation, body: int) -> list[int]:
    """The sites of a body's parent that are for tools; none of the world's."""
    parent, names = of.parent(body), of.names("site")
    owners = of.model("site_bodyid") if parent else ()
    return [site for site, owner in enumerate(owners) if int(owner) == parent and PLACE.search(names[site])]


def _off(of: Simulation, body: int) -> float:
    """How far a body is from the nearest site of its parent for tools, in m."""
    here = of.row("body_pos", body, 3)
    return min((norm(sub(of.row("site_pos", site, 3), here)) for site in _sites(of, body)), default=0.0)
