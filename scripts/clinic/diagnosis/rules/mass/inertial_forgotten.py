"""One body of many has no `<inertial>`, so that its geoms make its mass.

Where a body has no `<inertial>`, MuJoCo makes its mass of its geoms, at 1,000 kg/m3 or the density of their default
class. In a robot whose other bodies all have theirs, it is usually the line that was lost, and the mass is that of the
collision shapes.

Bad:

    <mujoco>
      <worldbody>
        <body name="hip" pos="0 0 1">
          <joint axis="0 1 0" damping="0.5"/>
          <inertial pos="0.1 0 0" mass="1" diaginertia="0.001 0.004 0.004"/>
          <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02"/>
          <body name="thigh" pos="0.2 0 0">
            <joint axis="0 1 0" damping="0.5"/>
            <inertial pos="0.1 0 0" mass="1" diaginertia="0.001 0.004 0.004"/>
            <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02"/>
            <body name="shin" pos="0.2 0 0">
              <joint axis="0 1 0" damping="0.5"/>
              <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02"/>
            </body>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

                <joint axis="0 1 0" damping="0.5"/>
    +           <inertial pos="0.1 0 0" mass="1" diaginertia="0.001 0.004 0.004"/>

The number: told is one body where two others of its mechanism have an `<inertial>`, or two where three in four have
one, and no geom of theirs has a density written on itself, or a mass on itself or in its class. So are parts without a
joint, all together, whose geoms add more than 15 % to the mass of the link they are fixed to, where that link has an
`<inertial>` of its own: a foot's collision geoms weigh as water does. What weighs less than 30 g, or than a tenth of
all that moves, is left alone.

When it is wrong: a body that was added by hand and is as heavy as its geoms.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.inertia import inertial
from clinic.diagnosis.probes.matter import mass_of
from clinic.diagnosis.probes.shape import root_of, roots
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.mass import visual_mass
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect

TITLE = "A body without its inertial"
FAMILIES = ("wrong-mass", "sags", "drifts")
AFLOAT = True
LEVEL = "hint"

SHARE, FEW = 0.75, 2
NOTHING = 1e-6  # kg: a frame without mass
LITTLE, PART = 0.03, 0.1  # kg, or of all that moves where that is less: what makes no difference
MORE = 0.15  # of the link's mass


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Jointed bodies of their geoms' mass among bodies that have an `<inertial>`; parts that are fixed to such.

    Left alone is what weighs too much by geoms that are only seen, and parts beside it: without them it may be right.
    """
    twice = {name for each in visual_mass.suspects(model) for name in each.elements}
    yield from (each for each in (*_fixed(model), *_jointed(model)) if not twice & set(each.elements))


def _jointed(model: ReaderModel) -> Iterator[Suspect]:
    of, owner = model.simulation, root_of(model.simulation)
    for root in roots(of):
        jointed = [body for body, top in enumerate(owner) if top == root and of.joints_of(body)]
        stands = model.urdf and root in of.free_bodies and len(of.children.get(root, [])) < FEW  # an arm's base
        own = [body for body in jointed if not (stands and body == root)]
        bare = [body for body in own if model.element("body", body) and inertial(model, body) is None]
        others = len(jointed) - len(bare)
        if not bare or len(bare) > FEW or others < (2 if len(bare) == 1 else max(3, SHARE * len(jointed))):
            continue
        for body in (each for each in bare if of.model("body_mass")[each] > NOTHING):
            placed = [each for geom in of.geoms_of(body) if (each := model.element("geom", geom)) is not None]
            weighed = any((each.get(name) or "0") != "0" for each in placed for name in ("mass", "density"))
            idle = {text for each in jointed if inertial(model, each) is not None for text in _by_class(model, each)}
            weighed |= bool(_by_class(model, body) - idle)
            if weighed or not (placed or (model.urdf and of.geoms_of(body))):
                continue
            mass = of.model("body_mass")[body]
            says = f"{others} others have an <inertial>; its {mass:.3g} kg are those of its geoms."
            names = (of.name("body", body),)
            yield Suspect(names, "inertial", "left out", "", (), mass_of(body), 0.0, says, "its own <inertial>")


def _by_class(model: ReaderModel, body: int) -> set[str]:
    """What the geoms of a body are let weigh, by themselves or by their classes."""
    return {model.value("geom", geom, "mass") or "0" for geom in model.simulation.geoms_of(body)} - {"0"}


def _fixed(model: ReaderModel) -> Iterator[Suspect]:
    """Parts without a joint whose colliding geoms weigh by default, on links that state what they weigh."""
    if model.source is None:
        return
    of = model.simulation
    masses = of.model("body_mass")
    found: dict[int, int] = {}
    for body in of.moving_bodies:
        link, geoms = of.parent(body), of.geoms_of(body)
        while link and not (of.joints_of(link) or of.geoms_of(link) or inertial(model, link)):
            link = of.parent(link)  # a frame between the two
        if of.joints_of(body) or not geoms or inertial(model, body) is not None or inertial(model, link) is None:
            continue
        if not model.urdf and any(model.element("geom", geom) is None for geom in geoms):
            continue
        written = any(model.value("geom", geom, name) for geom in geoms for name in ("mass", "density"))
        if not written and masses[body] > MORE * masses[link]:
            found[body] = link
    mass = sum(masses[body] for body in found)
    if found and mass > _little(of):
        first = next(iter(found.values()))
        holder = of.name("body", first)
        yield Suspect(
            tuple(of.name("body", body) for body in found),
            "density",
            "1000 (default)",
            "0",
            tuple(edit for body in found for edit in model.set("geom", of.geoms_of(body), "density", "0")),
            mass_of(*found),
            MORE * masses[first],
            f"{holder} states its mass; what is fixed to it adds {mass:.3g} kg by the default density of its geoms.",
            'density="0", where the link\'s <inertial> has all of its mass',
            level="hint",
        )


def _little(of: Simulation) -> float:
    return min(LITTLE, PART * of.moving_mass)
