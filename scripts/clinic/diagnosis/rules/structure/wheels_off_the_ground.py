"""Something of a wheeled robot reaches lower than its wheels.

A caster or a skid that is some millimetres too low takes the weight, the robot tilts and the wheels slip; over one that
is too high it tips. A URDF whose `base_footprint` is not where the wheels touch the ground puts the robot into the
floor, or above it.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="2 2 0.1"/>
        <body name="base" pos="0 0 0.1">
          <freejoint/>
          <geom type="box" size="0.15 0.08 0.03"/>
          <geom name="caster" size="0.02" pos="0.12 0 -0.04"/>
          <body name="left_wheel" pos="-0.1 0.1 0">
            <joint axis="0 1 0"/>
            <geom type="cylinder" size="0.05 0.01" zaxis="0 1 0"/>
          </body>
          <body name="right_wheel" pos="-0.1 -0.1 0">
            <joint axis="0 1 0"/>
            <geom type="cylinder" size="0.05 0.01" zaxis="0 1 0"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <geom name="caster" size="0.02" pos="0.12 0 -0.04"/>
    +       <geom name="caster" size="0.02" pos="0.12 0 -0.03"/>

The number: how far below the wheels the lowest other geom reaches at the start, or how far a root that is called a
footprint is from the ground under the wheels: more than 1 mm, and less than a wheel's radius. Or how far above the
ground of two wheels the caster ends: more than 0.8 mm, and than a 40th of a wheel's radius; or how many casters beside
two wheels have no geom that can touch the ground. A wheel is the last body of a mechanism, on a level hinge without
limits, and gravity is along z.

When it is wrong: wheels that are let down later, on a suspension.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.engine import CYLINDER, SPHERE
from clinic.diagnosis.probes.shape import in_world, root_of, solid
from clinic.diagnosis.probes.wheels import CASTER, is_wheel
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe, Suspect, how_many

TITLE = "Something lower than the wheels, or a caster above them"
FAMILIES = ("drifts", "slips", "jumps-at-start", "stuck", "falls-through")
AFLOAT = True
UNPLANTED = "nearly no healthy model stands on wheels"

ALOFT, SHARE = 0.0008, 1 / 40  # m; of the radius of a wheel
LEAST, LEVEL_ENOUGH = 0.001, 0.1  # m; of the axle's direction along the vertical


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Geoms below the wheels of their robot, and footprints that are off the ground."""
    of = model.simulation
    of.begin()
    across, along, down = of.model("opt.gravity")
    if math.hypot(across, along) > abs(down):
        return  # another axis than z is up
    if found := _without_geom(of):
        names, probe = tuple(of.name("body", body) for body in found), how_many("casters without a geom", _without_geom)
        says = f"{names[0]} has no geom that can touch the ground: on two wheels alone the robot tips."
        yield Suspect(names, "geom", "none", "a sphere", (), probe, 0, says, "0")
    for root, wheels in _wheels(of).items():
        lowest = min(wheels, key=lambda geom: _bottom(of, geom))
        ground, radius = _bottom(of, lowest), of.model("geom_size")[3 * lowest]
        others = [geom for geom in _others(of, root, wheels) if LEAST < ground - _bottom(of, geom) < radius]
        if others:
            low = min(others, key=lambda geom: _bottom(of, geom))
            body = of.name("body", of.body_of("geom", low))
            below = 1000 * (ground - _bottom(of, low))
            probe = Probe("below the wheels by", "m", _below, (root, low), dynamic=False)
            says = f"It reaches {below:.3g} mm lower than the wheels."
            where = " ".join(f"{x:.4g}" for x in of.row("geom_pos", low, 3))
            yield Suspect(
                (of.name("geom", low), body), "pos", where, f"{below:.3g} mm higher", (), probe, LEAST, says, "0"
            )
        aloft = [geom for geom in _casters(of, root, wheels) if _bottom(of, geom) - ground > max(ALOFT, SHARE * radius)]
        if aloft:
            high = max(aloft, key=lambda geom: _bottom(of, geom))
            above = 1000 * (_bottom(of, high) - ground)
            bodies = dict.fromkeys(of.name("body", of.body_of("geom", geom)) for geom in (high, *wheels))
            probe = Probe("above the ground by", "m", _above, (root, high), dynamic=False)
            says = f"It is {above:.3g} mm above the ground on which the wheels stand: the robot tips until it touches."
            yield Suspect(tuple(bodies), "pos", "", f"{above:.3g} mm lower", (), probe, ALOFT, says, "0")
        off = _footprint_off(of, root)
        if LEAST < abs(off) < radius and "footprint" in of.engine.name("body", root):
            probe = Probe("footprint off the ground by", "m", _far_off, (root,), dynamic=False)
            where = "above" if off > 0 else "below"
            says = f"It is {1000 * abs(off):.3g} mm {where} the ground on which the wheels stand."
            lower = "higher" if off > 0 else "lower"
            value = f"the robot {1000 * abs(off):.3g} mm {lower}"
            names = (of.name("body", root), *(of.name("body", body) for body in of.children.get(root, [])))
            yield Suspect(names, "pos", "", value, (), probe, LEAST, says, "0")


def _wheels(of: Simulation) -> dict[int, list[int]]:
    """The round geoms of bodies on level hinges without limits, by the root of their robot; two and more."""
    made: dict[int, list[int]] = {}
    for joint in range(of.count("joint")):
        body = of.body_of("joint", joint)
        if not of.continuous(joint) or body in of.children:
            continue
        if abs(of.axis(joint)[2]) < LEVEL_ENOUGH:
            made.setdefault(root_of(of)[body], []).extend(geom for geom in of.geoms_of(body) if _round(of, geom))
    bodies = of.model("geom_bodyid")
    return {root: geoms for root, geoms in made.items() if len({bodies[geom] for geom in geoms}) > 1}


def _round(of: Simulation, geom: int) -> bool:
    kind = int(of.model("geom_type")[geom])
    lies = abs(of.data_row("geom_xmat", geom, 9)[8]) < LEVEL_ENOUGH
    return solid(of, geom) and (kind == SPHERE or (kind == CYLINDER and lies))


def _others(of: Simulation, root: int, wheels: list[int]) -> list[int]:
    owners, bodies = root_of(of), of.model("geom_bodyid")
    turning = {int(bodies[geom]) for geom in wheels}
    return [
        geom
        for geom, body in enumerate(bodies)
        if owners[int(body)] == root and int(body) not in turning and solid(of, geom)
    ]


def _casters(of: Simulation, root: int, wheels: list[int]) -> list[int]:
    """The lowest geom of what is called a caster, of a robot with two wheels beside it."""
    named = [geom for geom in (*_others(of, root, wheels), *wheels) if CASTER.search(_called(of, geom))]
    bodies = of.model("geom_bodyid")
    if len({bodies[geom] for geom in wheels if geom not in named}) != 2:
        return []
    return sorted(named, key=lambda geom: _bottom(of, geom))[:1]


def _without_geom(of: Simulation) -> list[int]:
    """What is called a caster and has no geom that collides, on it or below it, in free robots with two wheels."""
    owners, names = root_of(of), of.names("body")
    hard = {
        above
        for geom, body in enumerate(of.model("geom_bodyid"))
        if solid(of, geom)
        for above in of.ancestors(int(body))
    }
    made = []
    for root in of.free_bodies:
        parts = [body for body, owner in enumerate(owners) if owner == root]
        casters = [body for body in parts if CASTER.search(names[body])]
        wheels = [body for body in parts if body in hard and is_wheel(names[body])]
        if len(wheels) == 2 and not hard & {*casters}:
            made += casters
    return made


def _called(of: Simulation, geom: int) -> str:
    return f"{of.name('geom', geom)} {of.name('body', int(of.model('geom_bodyid')[geom]))}"


def _above(of: Simulation, root: int, geom: int) -> float:
    return -_below(of, root, geom)


@kept
def _bottom(of: Simulation, geom: int) -> float:
    """How high the lowest point of a geom is at the start in m."""
    kind, middle = int(of.model("geom_type")[geom]), of.data_row("geom_xpos", geom, 3)[2]
    if kind == SPHERE or (kind == CYLINDER and abs(of.data_row("geom_xmat", geom, 9)[8]) < LEVEL_ENOUGH):
        return middle - of.model("geom_size")[3 * geom]
    return min(point[2] for point in in_world(of, geom))


def _below(of: Simulation, root: int, geom: int) -> float:
    of.begin()
    return min(_bottom(of, wheel) for wheel in _wheels(of)[root]) - _bottom(of, geom)


def _footprint_off(of: Simulation, root: int) -> float:
    return of.data_row("xpos", root, 3)[2] - min(_bottom(of, wheel) for wheel in _wheels(of)[root])


def _far_off(of: Simulation, root: int) -> float:
    of.begin()
    return abs(_footprint_off(of, root))
