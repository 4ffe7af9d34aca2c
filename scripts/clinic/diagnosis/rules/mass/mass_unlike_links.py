"""One link of a robot is many times denser than the others, or lighter.

A mass that is ten times too large, or too small, in a file where the inertia was reckoned from it: nothing in the link
itself looks wrong, beside the others it does.

Bad:

    <mujoco>
      <worldbody>
        <body name="upper" pos="0 0 1">
          <joint axis="0 1 0"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03" mass="1.2"/>
          <body name="fore" pos="0.3 0 0">
            <joint axis="0 1 0"/>
            <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03" mass="10"/>
            <body name="wrist" pos="0.3 0 0">
              <joint axis="0 1 0"/>
              <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.03" mass="0.7"/>
              <body name="hand" pos="0.2 0 0">
                <joint axis="0 1 0"/>
                <geom type="box" pos="0.05 0 0" size="0.05 0.05 0.02" mass="0.3"/>
              </body>
            </body>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <body name="upper" pos="0 0 1">
          <joint axis="0 1 0"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03" mass="1.2"/>
          <body name="fore" pos="0.3 0 0">
            <joint axis="0 1 0"/>
            <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03" mass="1"/>
            <body name="wrist" pos="0.3 0 0">
              <joint axis="0 1 0"/>
              <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.03" mass="0.7"/>
              <body name="hand" pos="0.2 0 0">
                <joint axis="0 1 0"/>
                <geom type="box" pos="0.05 0 0" size="0.05 0.05 0.02" mass="0.3"/>
              </body>
            </body>
          </body>
        </body>
      </worldbody>
    </mujoco>

The number: the mass of a link over the box around its largest geom, beside that of the link in the middle. More than 4
times that and more than 6 % of the robot's mass, or less than a tenth of it in a link that is not a small one. 11 of
147 healthy robots of four links and more have such a link; with ten times its mass 92 % of their links are told, with
a tenth 35 %.

When it is wrong: a link with a battery, or one whose motor is not drawn.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.probes.shape import root_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, rounded

TITLE = "A link unlike the others in density"
FAMILIES = ("wrong-mass", "sags", "drifts")
SINCE = "0.1"
AFLOAT = True
LEVEL = "hint"
UNPLANTED = "what a link should weigh, only its maker knows"

DENSE, SHARE, LIGHT, MANY, GRAM, METAL = 4.0, 0.06, 0.1, 4, 0.001, 24000.0


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The links whose density is away from that of their robot, robot by robot, where they are two at the most."""
    of = model.simulation
    owner, links = root_of(of), _links(of)
    for root in sorted({owner[body] for body in links}):
        robot = {body: each for body, each in links.items() if owner[body] == root}
        found = _unlike(robot)
        if not 0 < len(found) <= 2:
            continue
        ratios = {body: mass / volume / _middle(robot) for body, (mass, volume) in robot.items()}
        worst = max(found, key=lambda body: abs(math.log(ratios[body])))
        mass, ratio = robot[worst][0], ratios[worst]
        side = f"{rounded(ratio)} times as dense" if ratio > 1 else f"of {rounded(ratio)} times the density"
        yield Suspect(
            tuple(of.name("body", body) for body in found),
            "mass",
            f"{rounded(mass)} kg",
            f"near {mass / ratio:.2g} kg",
            (),
            Probe("density beside that of the robot's other links", "times", _ratio, (worst,), dynamic=False),
            DENSE if ratio > 1 else LIGHT,
            f"{of.name('body', worst)} is {side} as the link in the middle of the {len(robot)} of its robot.",
            "0.1 to 4 times in 136 of 147 robots",
            level="hint",
        )


def _ratio(of: Simulation, body: int) -> float:
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
    middle, total = _middle(robot), sum(mass for mass, _ in robot.values())
    large = sorted(volume for _, volume in robot.values())[len(robot) // 2]
    return [
        body
        for body, (mass, volume) in robot.items()
        if (DENSE * middle < mass / volume < METAL and mass > SHARE * total)
        or (mass / volume < LIGHT * middle and volume > large)
    ]
