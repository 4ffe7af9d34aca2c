"""One link of a robot is many times denser than the others.

A mass that is ten times too large, in a file where the inertia was reckoned from it: nothing in the link
itself looks wrong, beside the others it does.

Bad:

    <mujoco>
      <worldbody>
        <body name="upper" pos="0 0 1">
          <joint axis="0 1 0" damping="0.5"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03" mass="1.2"/>
          <body name="fore" pos="0.3 0 0">
            <joint axis="0 1 0" damping="0.5"/>
            <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03" mass="10"/>
            <body name="wrist" pos="0.3 0 0">
              <joint axis="0 1 0" damping="0.5"/>
              <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.03" mass="0.7"/>
              <body name="hand" pos="0.2 0 0">
                <joint axis="0 1 0" damping="0.5"/>
                <geom type="box" pos="0.05 0 0" size="0.05 0.05 0.02" mass="0.3"/>
              </body>
            </body>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -         <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03" mass="10"/>
    +         <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03" mass="1"/>

The number: the mass of a link over the box around its largest geom, beside that of the link in the middle; more than 4
times that, and more than 6 % of the robot's mass. It also weighs more than 2.5 times as much as the link in the middle,
or what most of them do, a placeholder: one that is only drawn small does not. Left alone are the first link, which has
the battery or the drive, a link of whose mass another rule tells, and one that is too light, for a shell is drawn as if
it were full.

When it is wrong: a link with a battery, or one whose motor is not drawn.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.shape import root_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.mass import (
    denser_than_metal,
    inertial_forgotten,
    lighter_than_air,
    mass_unlike_inertia,
    visual_mass,
)
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, rounded

TITLE = "A link unlike the others in density"
FAMILIES = ("wrong-mass", "sags", "drifts")
AFLOAT = True
UNPLANTED = "what a link should weigh, only its maker knows"

DENSE, SHARE, MANY, GRAM = 4.0, 0.06, 4, 0.001
HEAVY = 2.5  # times the link in the middle
OTHERS = (denser_than_metal, inertial_forgotten, mass_unlike_inertia, visual_mass)  # tell of a mass with more reason


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The links whose density is away from that of their robot, robot by robot, where they are two at the most."""
    of = model.simulation
    owner, links = root_of(of), _links(of)
    told = {name for rule in (OTHERS if links else ()) for each in rule.suspects(model) for name in each.elements}
    if links and any(lighter_than_air.suspects(model)):
        return
    for root in sorted({owner[body] for body in links}):
        robot = {body: each for body, each in links.items() if owner[body] == root}
        found = [body for body in _unlike(robot) if body != root]
        if not 0 < len(found) <= 2 or told & {of.name("body", body) for body in found}:
            continue
        worst = max(found, key=lambda body: robot[body][0] / robot[body][1])
        mass, ratio = robot[worst][0], robot[worst][0] / robot[worst][1] / _middle(robot)
        yield Suspect(
            tuple(of.name("body", body) for body in found),
            "mass",
            f"{rounded(mass)} kg",
            f"near {mass / ratio:.2g} kg",
            (),
            Probe("density beside that of the robot's other links", "times", _ratio, (worst,), dynamic=False),
            DENSE,
            f"{of.name('body', worst)} is {rounded(ratio)} times as dense as the link in the middle of the "
            f"{len(robot)} of its robot.",
            "below 4 times in 130 of 135 robots",
        )


def _ratio(of: Simulation, body: int) -> float:
    """The density of a link over that of the link in the middle."""
    owner, links = root_of(of), _links(of)
    robot = {other: each for other, each in links.items() if owner[other] == owner[body]}
    return links[body][0] / links[body][1] / _middle(robot) if body in robot else 1.0


def _links(of: Simulation) -> dict[int, tuple[float, float]]:
    """By body that moves in its parent, with what is fixed to it: the mass in kg and the largest geom's box in m3."""
    welds, moving, masses = of.model("body_weldid"), set(of.moving_bodies), of.model("body_mass")
    mass, volume = dict.fromkeys(moving, 0.0), dict.fromkeys(moving, 0.0)
    for body in moving:
        link = int(welds[body])
        mass[link] += masses[body]
        for geom in of.geoms_of(body):
            x, y, z = of.row("geom_aabb", geom, 6)[3:]
            volume[link] = max(volume[link], 8 * x * y * z)
    return {body: (mass[body], volume[body]) for body in moving if mass[body] > GRAM and volume[body] > 0}


def _middle(robot: dict[int, tuple[float, float]]) -> float:
    return sorted(mass / volume for mass, volume in robot.values())[len(robot) // 2]


def _unlike(robot: dict[int, tuple[float, float]]) -> list[int]:
    if len(robot) < MANY:
        return []
    masses = sorted(mass for mass, _ in robot.values())
    middle, usual, least = _middle(robot), masses[len(masses) // 2], SHARE * sum(masses)
    dense = [body for body, (mass, volume) in robot.items() if mass / volume > DENSE * middle and mass > least]
    return [body for body in dense if robot[body][0] > HEAVY * usual or masses.count(robot[body][0]) > len(masses) / 2]
