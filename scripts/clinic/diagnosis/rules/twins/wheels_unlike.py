"""Two wheels of one axle turn against each other, or are not equally large.

A robot with two driven wheels goes straight when both get the same control. With one `axis` or `gear` turned round it
spins on the spot; with one radius larger it goes in a circle.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="5 5 0.1"/>
        <body name="car" pos="0 0 0.1">
          <freejoint/>
          <geom type="box" size="0.2 0.1 0.03"/>
          <body name="left_wheel" pos="0 0.15 0">
            <joint name="left_wheel" axis="0 1 0"/>
            <geom type="cylinder" size="0.1 0.02" euler="90 0 0"/>
          </body>
          <body name="right_wheel" pos="0 -0.15 0">
            <joint name="right_wheel" axis="0 -1 0"/>
            <geom type="cylinder" size="0.1 0.02" euler="90 0 0"/>
          </body>
        </body>
      </worldbody>
      <actuator>
        <motor joint="left_wheel" ctrlrange="-1 1"/>
        <motor joint="right_wheel" ctrlrange="-1 1"/>
      </actuator>
    </mujoco>

Good:

    -         <joint name="right_wheel" axis="0 -1 0"/>
    +         <joint name="right_wheel" axis="0 1 0"/>

The number: of the two driven wheels on one axle, how much equal controls roll them against each other, from -1, both
the same way, to 1; and by how much the smaller radius is less than the other, from 0.2 % on, of two that are called
left and right as well, whatever drives them.

In a URDF, which has no actuators, it is the hinges that are called wheels'.

When it is wrong: a robot whose code turns one side round, as for motors that are mounted as mirror images.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from clinic.diagnosis.engine import CYLINDER, ELLIPSOID, SPHERE
from clinic.diagnosis.probes.shape import root_of, solid
from clinic.diagnosis.probes.sides import by_name
from clinic.diagnosis.probes.vector import dot, norm, sub
from clinic.diagnosis.probes.wheels import is_wheel
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Two wheels of one axle that are not alike"
FAMILIES = ("drifts", "stuck")
AFLOAT = True
UNPLANTED = "nearly no healthy model stands on wheels"

AGAINST, ALONG, LEVEL_ENOUGH, UNLIKE = 0.9, 0.95, 0.2, 0.002


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Axles whose two wheels turn against each other, and such as have two radii."""
    of = model.simulation
    if not of.count("actuator") and not model.urdf:
        return
    for one, other in _axles(of):
        names = tuple(of.name("joint", joint) for joint in (one, other))
        if _driven(of, one, other) and (against := _against(of, one, other)) > AGAINST:
            probe = Probe(
                "equal controls turn the wheels against each other", "", _against, (one, other), dynamic=False
            )
            says = "Equal controls turn the one forwards and the other backwards."
            axes = [" ".join(f"{x:g}" for x in of.row("jnt_axis", joint, 3)) for joint in (one, other)]
            motors = [_actuator(of, joint) for joint in (one, other)]
            attribute = "axis" if axes[0] != axes[1] or None in motors else "gear"
            now = axes[1] if attribute == "axis" else f"{_gear(of, other):g}"
            value = axes[0] if attribute == "axis" else f"{-_gear(of, other):g}"
            driving = [motor for motor in motors if motor is not None]
            turned = model.turned_axis(other)
            edits = turned if attribute == "axis" else model.set("actuator", driving[1:], "gear", value)
            value = edits[0].value if edits else value
            told = (*names, *(of.name("actuator", motor) for motor in driving))
            yield Suspect(told, attribute, now, value, edits, probe, AGAINST, says, "both the same way", share=against)
        if _unlike(of, one, other) > UNLIKE:
            probe = Probe("radius of one wheel below that of the other by", "", _unlike, (one, other), dynamic=False)
            radii = [_radius(of, joint) for joint in (one, other)]
            geoms = tuple(of.name("geom", _tyre(of, joint)) for joint in (one, other))
            says = f"One has a radius of {radii[0]:.3g} m, the other one of {radii[1]:.3g} m."
            now, value = f"{radii[1]:.3g}", f"{radii[0]:.3g}"
            yield Suspect((*geoms, *names), "size", now, value, (), probe, UNLIKE, says, "equal radii")


def _axles(of: Simulation) -> Iterator[tuple[int, int]]:
    """Pairs of wheels of one robot on one line along their hinges, which are driven or called left and right."""
    of.begin()
    wheels, called = [joint for joint in range(of.count("joint")) if _is_wheel(of, joint)], by_name(of, "joint")
    owner, bodies = root_of(of), of.model("jnt_bodyid")
    for one, other in combinations(wheels, 2):
        if not _driven(of, one, other) and (one, other) not in called and (other, one) not in called:
            continue
        between = sub(of.data_row("xanchor", one, 3), of.data_row("xanchor", other, 3))
        far = norm(between)
        along = [abs(dot(between, of.axis(joint))) for joint in (one, other)]
        if owner[int(bodies[one])] == owner[int(bodies[other])] and far > 0 and min(along) > ALONG * far:
            yield one, other


def _is_wheel(of: Simulation, joint: int) -> bool:
    level = abs(of.axis(joint)[2]) < LEVEL_ENOUGH
    return of.continuous(joint) and level and _tyre(of, joint) >= 0 and of.body_of("joint", joint) > 0


def _driven(of: Simulation, *wheels: int) -> bool:
    """Whether one actuator turns each wheel, or would in a URDF, which has none."""
    if not of.count("actuator"):
        return all(is_wheel(of.names("joint")[each], of.names("body")[of.body_of("joint", each)]) for each in wheels)
    return all(len(of.drivers.get(each, ())) == 1 for each in wheels)


def _tyre(of: Simulation, joint: int) -> int:
    """The largest round geom that collides, of a wheel's body; -1 for none."""
    round_ = [
        geom
        for geom in of.geoms_of(of.body_of("joint", joint))
        if int(of.model("geom_type")[geom]) in (SPHERE, CYLINDER, ELLIPSOID) and solid(of, geom)
    ]
    return max(round_, key=lambda geom: of.model("geom_size")[3 * geom], default=-1)


def _radius(of: Simulation, joint: int) -> float:
    return of.model("geom_size")[3 * _tyre(of, joint)]


def _actuator(of: Simulation, joint: int) -> int | None:
    return next(iter(of.drivers.get(joint, [])), None)


def _gear(of: Simulation, joint: int) -> float:
    motor = _actuator(of, joint)
    return 1.0 if motor is None else of.gear(motor)


def _against(of: Simulation, one: int, other: int) -> float:
    of.begin()
    return -dot(of.axis(one), of.axis(other)) * (1 if _gear(of, one) * _gear(of, other) > 0 else -1)


def _unlike(of: Simulation, one: int, other: int) -> float:
    low, high = sorted((_radius(of, one), _radius(of, other)))
    return 1 - low / high
