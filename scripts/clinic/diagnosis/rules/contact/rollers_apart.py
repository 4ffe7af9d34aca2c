"""A wheel of rollers is a polygon: its rollers stand so far apart that it rises and falls as it turns.

Mecanum and omnidirectional wheels are built of a ring of spheres or capsules on hinges of their own. With few of them
the wheel stands on one roller, drops into the gap and climbs the next one: the base judders at the wheel's speed times
the number of rollers.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="5 5 0.1"/>
        <body name="hub" pos="0 0 0.1">
          <joint axis="0 1 0"/>
          <geom type="cylinder" size="0.05 0.02" zaxis="0 1 0" contype="0" conaffinity="0"/>
          <replicate count="6" euler="0 60 0">
            <body name="roller" pos="0.08 0 0">
              <joint axis="0 0.7 0.7"/>
              <geom size="0.015" mass="0.02"/>
            </body>
          </replicate>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <replicate count="6" euler="0 60 0">
    +       <replicate count="16" euler="0 22.5 0">

The number: how much the radius varies over a turn, as a share of its mean; above 3 % is told. A ring of n spheres of
radius r around R varies by R (1 - cos(pi / n)). A wheel is a hinge that carries five and more bodies with one sphere
or capsule each.

When it is wrong: a paddle wheel, a gear, the legs of a spider on a turning body.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import CAPSULE, SPHERE
from clinic.diagnosis.probes.shape import solid
from clinic.diagnosis.probes.vector import Vector, around, at, dot, sub
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A wheel of rollers that stand apart"
FAMILIES = ("oscillates", "drifts")
UNPLANTED = "no healthy model stands on wheels of rollers"

ENOUGH, MOST = 5, 0.03
ANGLES = 360


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The wheels of rollers that are not round, all together."""
    of = model.simulation
    found = {joint: each for joint in range(of.count("joint")) if (each := _varies(of, joint)) > MOST}
    if found:
        worst = max(found, key=lambda joint: found[joint])
        count = len(_rollers(of, worst))
        says = f"Its {count} rollers make a polygon: over a turn its radius varies by {100 * found[worst]:.2g} %."
        names = tuple(of.name("joint", joint) for joint in (worst, *(each for each in found if each != worst)))
        probe = Probe("radius over a turn of a wheel of rollers, varies by", "of its mean", _worst, dynamic=False)
        wanted = "more of them, smaller, on a larger ring"
        yield Suspect(names, "pos", f"{count} rollers", wanted, (), probe, MOST, says, "below 3 %")


def _worst(of: Simulation) -> float:
    return max((_varies(of, joint) for joint in range(of.count("joint"))), default=0.0)


def _rollers(of: Simulation, joint: int) -> list[int]:
    """The only solid geoms of the bodies with joints that a hinge's body carries; none where one is of another type."""
    hub = of.body_of("joint", joint)
    if not of.continuous(joint):
        return []
    carried = [body for body in of.children.get(hub, []) if of.joints_of(body)]
    geoms = [[geom for geom in of.geoms_of(body) if solid(of, geom)] for body in carried]
    kinds = {int(of.model("geom_type")[geom]) for own in geoms for geom in own}
    alone = all(len(own) == 1 for own in geoms) and not any(solid(of, geom) for geom in of.geoms_of(hub))
    return [own[0] for own in geoms] if alone and len(geoms) >= ENOUGH and kinds <= {SPHERE, CAPSULE} else []


def _varies(of: Simulation, joint: int) -> float:
    """The difference of a wheel's largest and least radius over a turn, as a share of the mean; 0 of what is none."""
    rollers = _rollers(of, joint)
    if not rollers:
        return 0.0
    of.begin()
    axis, anchor = of.axis(joint), of.data_row("xanchor", joint, 3)
    radii = [max(_support(of, geom, anchor, way) for geom in rollers) for way in around(axis, ANGLES)]
    return (max(radii) - min(radii)) * len(radii) / sum(radii) if min(radii) > 0 else 0.0


def _support(of: Simulation, geom: int, anchor: Vector, way: Vector) -> float:
    """How far a sphere or capsule reaches from a point in a direction."""
    radius, half, _ = of.row("geom_size", geom, 3)
    along = of.data_row("geom_xmat", geom, 9)[2::3] if int(of.model("geom_type")[geom]) == CAPSULE else (0.0, 0.0, 0.0)
    return dot(sub(at(of.data("geom_xpos"), geom), anchor), way) + radius + half * abs(dot(along, way))
