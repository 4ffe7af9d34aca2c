"""A part that does not roll rubs over the floor with the friction of a tyre.

A caster that is drawn as a fixed ball has no joint to roll with. With the friction of everything else it brakes the
robot, and holds its end when the wheels turn it. Of two geoms the greater `friction` and the greater `condim` count, so
that the floor's are enough: `condim="1"` on the ball, or a small `friction`, acts only beside `priority="1"`.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="2 2 0.1"/>
        <body name="base" pos="0 0 0.035">
          <freejoint/>
          <geom type="cylinder" size="0.15 0.02" pos="0 0 0.03" mass="3"/>
          <geom name="caster" type="sphere" size="0.015" pos="-0.11 0 -0.02" mass="0.02"/>
          <body name="left_wheel" pos="0.03 0.13 0">
            <joint name="left_wheel" axis="0 1 0" damping="0.005" armature="0.001"/>
            <geom type="cylinder" size="0.035 0.01" euler="90 0 0" mass="0.1"/>
          </body>
          <body name="right_wheel" pos="0.03 -0.13 0">
            <joint name="right_wheel" axis="0 1 0" damping="0.005" armature="0.001"/>
            <geom type="cylinder" size="0.035 0.01" euler="90 0 0" mass="0.1"/>
          </body>
        </body>
      </worldbody>
      <actuator>
        <velocity joint="left_wheel" kv="0.3" ctrlrange="-20 20"/>
        <velocity joint="right_wheel" kv="0.3" ctrlrange="-20 20"/>
      </actuator>
    </mujoco>

Good:

    -       <geom name="caster" type="sphere" size="0.015" pos="-0.11 0 -0.02" mass="0.02"/>
    +       <geom name="caster" type="sphere" size="0.015" pos="-0.11 0 -0.02" mass="0.02" condim="1" priority="1"/>

The number: what friction above 0.3 of the parts that have no joint but the free one takes, as a share of the weight,
once the robot stands on driven wheels and on them; above 0.05 is told. A wheel is a body that a driven level hinge
without a range turns about the middle of one of its geoms.

When it is wrong: a foot that a robot is meant to drag.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.shape import root_of, round_about
from clinic.diagnosis.probes.touch import Deciding, resting
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A fixed caster with the friction of a tyre"
FAMILIES = ("stuck", "slow", "drifts")
UNPLANTED = "no healthy model stands on wheels and a fixed caster"

MOST, STICKS, LEVEL_ENOUGH = 0.05, 0.3, 0.3  # of the weight; a friction below that glides; upward part of an axis


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The geoms that drag, of all robots with driven wheels."""
    of = model.simulation
    found = _dragged(of)
    if _share(of) <= MOST:
        return
    geoms = sorted(found)
    edits = model.set("geom", geoms, "condim", "1") + model.set("geom", geoms, "priority", "1")
    says = f"{of.name('geom', geoms[0])} cannot roll, and its friction with the floor is "
    says += f"{found[geoms[0]][1].friction:.3g}: that takes {100 * _share(of):.0f} % of the weight as a brake."
    probe = Probe("friction of what drags over the weight", "of the weight", _share)
    names = tuple(of.name("geom", geom) for geom in geoms)
    now = f"{found[geoms[0]][1].friction:.3g}"
    yield Suspect(names, "friction", now, 'condim="1" priority="1"', edits, probe, MOST, says, "next to nothing")


def _share(of: Simulation) -> float:
    """What friction of the dragged geoms takes of the weight of all that rolls."""
    weight = of.gravity * sum(of.model("body_subtreemass")[root] for root in _rollers(of))
    return sum(force * each.friction for force, each in _dragged(of).values()) / weight if weight > 0 else 0.0


def _dragged(of: Simulation) -> dict[int, tuple[float, Deciding]]:
    """By geom of a free base with driven wheels on the floor: the force on it in N, and what decides its friction."""
    bodies, welds, owner = of.model("geom_bodyid"), of.model("body_weldid"), root_of(of)
    driven, made, rolls = _wheels(of), {}, set()
    for contact, decided in resting(of):
        pair = [geom for geom in contact.geoms if geom >= 0 and owner[int(bodies[geom])]]
        if len(pair) != 1 or decided.kind != "geom":  # both of them move, or a pair decides
            continue
        body = int(bodies[pair[0]])
        if int(welds[body]) in driven:
            rolls.add(owner[body])
        if int(welds[body]) in of.free_bodies and decided.dim > 1 and decided.friction > STICKS:
            made[pair[0]] = (contact.force, decided)
    return {geom: each for geom, each in made.items() if owner[int(bodies[geom])] in rolls}


def _rollers(of: Simulation) -> set[int]:
    owner, bodies = root_of(of), of.model("geom_bodyid")
    return {owner[int(bodies[geom])] for geom in _dragged(of)}


def _wheels(of: Simulation) -> set[int]:
    """The bodies that a driven level hinge without limits turns about their middle, on a free base."""
    of.begin()
    free = set(of.free_bodies)
    owner, made = root_of(of), set()
    for joint in of.drivers:
        body = of.body_of("joint", joint)
        level = abs(of.axis(joint)[2]) < LEVEL_ENOUGH
        if of.continuous(joint) and level and owner[body] in free and round_about(of, joint):
            made.add(body)
    return made
