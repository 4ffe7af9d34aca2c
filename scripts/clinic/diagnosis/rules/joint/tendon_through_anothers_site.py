"""A tendon goes through a site of another one, and its own is left out.

The sites of a muscle are called after it: where it begins, where it is led, where it ends. One that was copied from its
neighbour pulls where that pulls, often to the other side of the joint.

Bad:

    <mujoco>
      <worldbody>
        <body name="shank" pos="0 0 1">
          <geom type="capsule" fromto="0 0 0 0 0 -0.4" size="0.02"/>
          <site name="tib_o" pos="0.03 0 -0.1"/>
          <site name="tib_via" pos="0.03 0 -0.36"/>
          <site name="sol_o" pos="-0.03 0 -0.1"/>
          <body name="foot" pos="0 0 -0.42">
            <joint name="ankle" axis="0 1 0" range="-40 40" damping="0.5"/>
            <geom type="capsule" fromto="-0.05 0 -0.03 0.15 0 -0.03" size="0.02"/>
            <site name="tib_i" pos="0.07 0 -0.02"/>
            <site name="heel" pos="-0.06 0 -0.02"/>
          </body>
        </body>
      </worldbody>
      <tendon>
        <spatial name="soleus">
          <site site="sol_o"/>
          <site site="heel"/>
        </spatial>
        <spatial name="tibialis">
          <site site="tib_o"/>
          <site site="tib_via"/>
          <site site="heel"/>
        </spatial>
      </tendon>
    </mujoco>

Good:

            <site site="tib_via"/>
    -       <site site="heel"/>
    +       <site site="tib_i"/>

The number: sites that a tendon shares with another one, and that lack a word which all its other sites have, two at
least. One site of the same body has their words, and no tendon names it. And sites at which two tendons of as many
sites are in the same place of their paths, where what sets the names of the two or of their other sites apart makes of
it one site that no tendon names, unless the tendon and that site have twins.

When it is wrong: a muscle that ends in a tendon of several, beside a site that only marks a place.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterator, Sequence

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.probes.copied import Line, misled
from clinic.diagnosis.probes.sides import sided
from clinic.diagnosis.probes.tendons import WRAPS, path
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A tendon through the site of another"
FAMILIES = ("wrong-numbers", "stuck", "drifts")
UNPLANTED = "few healthy models have tendons with three sites"

WORD = re.compile(r"[A-Z]?[a-z]+|[A-Z]+|\d+")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each place of a path where a site of the tendon's own is meant."""
    of, names = model.simulation, model.simulation.names("site")
    for (tendon, place), meant in _misled(of).items():
        element, site = model.element("tendon", tendon), path(of, tendon)[place][1]
        parts = [each for each in element.children if each.get("site") == names[site]] if element is not None else []
        edits = (set_attribute(parts[0], "site", names[meant]),) if len(parts) == 1 else ()
        told, shared, own = of.name("tendon", tendon), of.name("site", site), of.name("site", meant)
        says = f"It goes through {shared}, as another one does, and none through {own}, which is called like its own."
        probe = how_many("sites of a tendon that are another's", _misled)
        yield Suspect((told, shared), "site", names[site], names[meant], edits, probe, 0, says, "sites of its own")


def _misled(of: Simulation) -> dict[tuple[int, int], int]:
    """By tendon and place in its path: the site that is meant there."""
    paths = [[each for each in path(of, tendon) if each[0] == "site"] for tendon in range(of.count("tendon"))]
    times = Counter(site for sites in paths for _, site in set(sites))
    wraps = zip(of.model("wrap_type"), of.model("wrap_prm"), strict=True)
    beside = {int(side) for kind, side in wraps if WRAPS.get(int(kind)) == "geom"}
    free = set(range(of.count("site"))) - times.keys() - beside
    words = [set(WORD.findall(name)) for name in of.names("site")]
    made = {}
    for tendon, sites in enumerate(paths):
        for _, site in sites if len({*sites}) > 2 else ():
            others = set.intersection(*(words[each] for _, each in sites if each != site))
            body = of.body_of("site", site)
            meant = [each for each in free if others <= words[each] and of.body_of("site", each) == body]
            if times[site] > 1 and others - words[site] and len(meant) == 1:
                made[tendon, path(of, tendon).index(("site", site))] = meant[0]
    return made or _copied(of, paths, free)


def _copied(
    of: Simulation, paths: Sequence[Sequence[tuple[str, int]]], free: Collection[int]
) -> dict[tuple[int, int], int]:
    """The same where two tendons of as many sites go through one in the same place of their paths."""
    names, called = of.names("site"), of.names("tendon")
    made: dict[tuple[int, int], int] = {}
    for long in {len(sites) for sites in paths}:
        rows = {tendon: [names[site] for _, site in sites] for tendon, sites in enumerate(paths) if len(sites) == long}
        for at in range(long):
            lines = {each: Line(row[at], (called[each], *row[:at], *row[at + 1 :])) for each, row in rows.items()}
            for tendon, name in misled(lines, [names[each] for each in free]).items():
                if tendon not in sided(of, "tendon") or names.index(name) not in sided(of, "site"):
                    made[tendon, path(of, tendon).index(paths[tendon][at])] = names.index(name)
    return made if len(made) == 1 else {}
