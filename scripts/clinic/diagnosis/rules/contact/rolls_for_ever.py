"""A ball that never stops rolling.

With `condim` 3, the default, a contact has no rolling friction: a ball rolls for ever. With `condim="6"` the third
number of `friction` acts, and its default of 0.0001 m is next to nothing.

Bad:

    <mujoco>
      <worldbody>
        <geom name="field" type="plane" size="9 6 0.1"/>
        <body name="ball" pos="0 0 0.095">
          <freejoint/>
          <geom name="ball" type="sphere" size="0.095" mass="0.45"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <geom name="ball" type="sphere" size="0.095" mass="0.45"/>
    +       <geom name="ball" type="sphere" size="0.095" mass="0.45" condim="6" friction="1 0.005 0.008"/>

The number: of the speed of a rolling ball, what is left 1 s later; above 0.99 is told. With `condim` 3 it is all of it,
with 6 and the default of 0.0001 m 0.9996. And how many balls have a rolling friction of their own, up to a tenth of
their radius, in a model none of whose contacts has a `condim` above 3: nothing reads it.

When it is wrong: it is a hint only, for a ball on a hard floor does roll on.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from clinic.diagnosis.engine import SPHERE
from clinic.diagnosis.probes.push import rolls_on
from clinic.diagnosis.probes.shape import root_of, solid
from clinic.diagnosis.probes.touch import edits_of, names_of, resting
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A ball that never stops rolling"
FAMILIES = ("rolls-on", "drifts")
UNPLANTED = "no healthy model has a ball that is meant to stop"

MOST = 0.99  # of the speed
DEFAULT, BRAKE, ARM = 0.0001, 0.005, 0.1  # m of rolling friction; of the radius
KEPT = {"geom": 2, "pair": 3}  # coefficients before those of rolling


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Contacts of free balls that have no rolling friction."""
    simulation = model.simulation
    if unread := _unread(simulation):
        rolling = simulation.row("geom_friction", unread[0], 3)[2]
        now = f"{int(simulation.model('geom_condim')[unread[0]])}"
        says = f"With condim {now} nothing reads its rolling friction, {rolling:g} m."
        names, edits = tuple(simulation.name("geom", geom) for geom in unread), model.set("geom", unread, "condim", "6")
        probe = how_many("balls whose rolling friction nothing reads", _unread)
        yield Suspect(names, "condim", now, "6", edits, probe, 0, says, "6, for what is to stop rolling", level="hint")
        return
    bodies, kinds, owner = simulation.model("geom_bodyid"), simulation.model("geom_type"), root_of(simulation)
    for body in simulation.free_bodies:
        geoms = tuple(geom for geom in simulation.geoms_of(body) if solid(simulation, geom))
        if owner.count(body) != 1 or len(geoms) != 1 or int(kinds[geoms[0]]) != SPHERE:
            continue
        if simulation.model("dof_damping")[simulation.dof(simulation.joints_of(body)[0])] > 0:
            continue
        found = [
            (decides, [owner[int(bodies[geom])] for geom in contact.geoms])
            for contact, decides in resting(simulation)
            if decides.dim > 1 and body in [int(bodies[geom]) for geom in contact.geoms]
        ]
        meant, on_ground = [decides for decides, _ in found], any(0 in trees for _, trees in found)  # not in a hand
        if meant and on_ground and all(each.dim < 6 for each in meant):
            says = f"With condim {meant[0].dim} a contact has no rolling friction."
            meant = [replace(each, elements=geoms) if {*geoms} <= {*each.elements} else each for each in meant]
            kind, arm = meant[0].kind, min(BRAKE, ARM * simulation.model("geom_size")[3 * geoms[0]])
            meant = [each for each in meant if each.kind == kind]
            kept = simulation.row(f"{kind}_friction", meant[0].elements[0], 5 if kind == "pair" else 3)[: KEPT[kind]]
            friction = written((*kept, *((arm, arm) if kind == "pair" else (arm,))))
            edits = edits_of(model, meant, "condim", "6") + edits_of(model, meant, "friction", friction)
            value = f"6, friction {friction}"
            yield Suspect(
                names_of(simulation, meant), "condim", f"{meant[0].dim}", value, edits,
                rolls_on(body), MOST, says, level="hint",
            )  # fmt: skip
            return


def _unread(of: Simulation) -> list[int]:
    """The free balls with a rolling friction that is not MuJoCo's own, where no contact has any, nor a torsional."""
    if any(each > 3 for each in (*of.model("geom_condim"), *of.model("pair_dim"))):
        return []
    made = []
    for body in of.free_bodies:
        geoms = [geom for geom in of.geoms_of(body) if solid(of, geom)]
        if len(geoms) == 1 and body not in of.children and int(of.model("geom_type")[geoms[0]]) == SPHERE:
            rolling, radius = of.model("geom_friction")[3 * geoms[0] + 2], of.model("geom_size")[3 * geoms[0]]
            if (
                abs(rolling / DEFAULT - 1) > 0.01
                and 0 < rolling < ARM * radius
                and of.model("geom_condim")[geoms[0]] > 1
            ):
                made.append(geoms[0])
    return made
