"""The centre of mass of a link is put into its joint: the place of the `<inertial>` was left out.

An `<inertial>` of URDF without `<origin>`, or with `pos="0 0 0"` in MJCF, has its centre where the joint is. Gravity
does not turn such a link, and its inertia about the joint is too small.

Bad:

    <mujoco>
      <worldbody>
        <body name="upper" pos="0 0 1">
          <joint axis="0 1 0"/>
          <inertial pos="0 0 0.15" mass="1" diaginertia="0.008 0.008 0.0005"/>
          <geom type="capsule" fromto="0 0 0 0 0 0.3" size="0.03"/>
          <body name="fore" pos="0 0 0.3">
            <joint axis="0 1 0"/>
            <inertial pos="0 0 0" mass="1" diaginertia="0.008 0.008 0.0005"/>
            <geom type="capsule" fromto="0 0 0 0 0 0.3" size="0.03"/>
            <body name="hand" pos="0 0 0.3">
              <joint axis="0 1 0"/>
              <inertial pos="0 0 0.05" mass="0.3" diaginertia="0.0005 0.0005 0.0002"/>
              <geom type="capsule" fromto="0 0 0 0 0 0.1" size="0.03"/>
            </body>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -         <inertial pos="0 0 0" mass="1" diaginertia="0.008 0.008 0.0005"/>
    +         <inertial pos="0 0 0.15" mass="1" diaginertia="0.008 0.008 0.0005"/>

The number: how far the middle of the geoms is from the joint, in half lengths of the box around them; told from 0.7 on
of one link that a hinge turns, where no other is so; of several, where the joint is more than half a half length
outside of the box.

With `--symptom wrong-mass` every such link is told, of one that is fixed to its parent as well.

And a centre on the hinge's axis, near the edge of the geoms, beside an inertia of its own that has no room then: mass
between a and b whose centre is c has a mean square distance from it of (b - c)(c - a) at most. Twice that is told,
where there is room about the middle of the geoms.

When it is wrong: a link that a counterweight balances.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.probes.inertia import set_inertial
from clinic.diagnosis.probes.matter import explicit, matter
from clinic.diagnosis.probes.vector import across, cross, norm, sub, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A centre of mass in the joint"
FAMILIES = ("wrong-mass", "sags", "drifts")
AFLOAT = True
UNPLANTED = "which link a counterweight balances, only its maker knows"

FAR, OUTSIDE = 0.7, 0.5
ON, TWICE, TINY = 1e-4, 2.0, 1e-2  # of the size of the body; times the room; of the room
LIGHT = 0.01  # of the mass of all


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Jointed links with the centre of mass at their origin and the geoms beside it, where the others' is elsewhere."""
    of = model.simulation
    keen = model.symptom == FAMILIES[0]
    heavy = [(body, each) for body, each in explicit(model) if each.mass > LIGHT * of.moving_mass]
    heavy = [(body, each) for body, each in heavy if keen or _turns(of, body)]
    here = [(body, each) for body, each in heavy if not any(each.centre) and not _hung_aside(of, body)]
    found = [(body, each) for body, each in here if norm(each.solid_centre) > FAR * max(each.half)]
    if len(found) != 1 and not keen:
        found = [(body, each) for body, each in found if each.outside > OUTSIDE * max(each.half)]
    if len(heavy) - len(here) < 2 and not keen:
        found = []
    for body, each in heavy:
        far, crowded = norm(sub(each.solid_centre, each.centre)), _crowded(of, body)
        if (body, each) not in found and crowded <= TWICE:
            continue
        where = "in its joint" if of.joints_of(body) else "at its origin"
        probe = Probe("middle of the geoms from the centre of mass", "half lengths", _apart, (body,), dynamic=False)
        if crowded > TWICE:
            probe = Probe("spread of the mass over the room for it", "times", _crowded, (body,), dynamic=False)
        yield Suspect(
            (of.name("body", body),),
            "inertial",
            f"pos {written(each.centre)}",
            f"pos {written(each.solid_centre)}",
            set_inertial(model, body, each.mass, each.solid_centre, each.about),
            probe,
            TWICE if crowded > TWICE else FAR,
            f"{each.mass:.3g} kg lie {where}, and the middle of its geoms {far:.3g} m from there.",
            "where the geoms are",
        )


def _crowded(of: Simulation, body: int) -> float:
    """How often the spread of a body's mass is what fits into its geoms beside a centre on its hinge's axis.

    0 where the centre is off the axis, the inertia no measured one, or does not fit about the geoms' own centre either.
    """
    joints, found = of.joints_of(body), matter(of, body)
    if len(joints) != 1 or found is None or found.even:
        return 0.0
    axis, off = of.row("jnt_axis", joints[0], 3), sub(found.centre, of.row("jnt_pos", joints[0], 3))
    apart = sub(found.solid_centre, found.centre)
    aside = [abs(x) for x in across(apart, axis)]
    side = aside.index(max(aside))
    low, high = (found.middle[side] + sign * found.half[side] for sign in (-1, 1))
    spread = (sum(found.about[::4]) / 2 - found.about[4 * side]) / found.mass
    room, own = ((high - at[side]) * (at[side] - low) for at in (found.centre, found.solid_centre))
    on_axis = norm(cross(axis, off)) < ON * max(found.half)
    return spread / max(room, TINY * own) if on_axis and 0 < spread < own else 0.0


def _hung_aside(of: Simulation, body: int) -> bool:
    """Whether a joint of a body is not at its origin."""
    return any(any(of.row("jnt_pos", joint, 3)) for joint in of.joints_of(body))


def _turns(of: Simulation, body: int) -> bool:
    return any(of.joint_type(joint) == HINGE for joint in of.joints_of(body))


def _apart(of: Simulation, body: int) -> float:
    found = matter(of, body)
    return norm(sub(found.solid_centre, found.centre)) / max(found.half) if found is not None else 0.0
