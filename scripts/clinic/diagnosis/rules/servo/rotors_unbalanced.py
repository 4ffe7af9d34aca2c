"""The rotors of a drone cannot lift it, or turn it over while they lift it.

With the same control at all rotors a drone hovers: together they carry its weight, their centre is below or above the
centre of mass, and the drags of those that turn to the left and to the right cancel. A site in the wrong place, one
sign of a gear, a centre of mass aside or a control range below the weight show in the first second of flight.

Bad:

    <mujoco>
      <default><motor ctrlrange="0 1"/></default>
      <worldbody>
        <body name="drone" pos="0 0 1">
          <freejoint/>
          <geom type="box" size="0.1 0.1 0.02" mass="0.5"/>
          <site name="one" pos="-0.1 -0.1 0"/>
          <site name="two" pos="-0.1 0.1 0"/>
          <site name="three" pos="0.1 0.1 0"/>
          <site name="four" pos="0.1 -0.1 0"/>
        </body>
      </worldbody>
      <actuator>
        <motor name="one" site="one" gear="0 0 1 0 0 -0.02"/>
        <motor name="two" site="two" gear="0 0 1 0 0 0.02"/>
        <motor name="three" site="three" gear="0 0 1 0 0 -0.02"/>
        <motor name="four" site="four" gear="0 0 1 0 0 0.02"/>
      </actuator>
    </mujoco>

Good:

    -   <default><motor ctrlrange="0 1"/></default>
    +   <default><motor ctrlrange="0 3"/></default>

The number: how level they push, where all have the gear that is MuJoCo's own, 1 along the x axis of the site. Else the
weight over what the rotors lift at most, above 1 or below 1/30. At equal controls that carry the weight: the torque of
roll and pitch as a share of the weight times the mean arm, above 0.06 (0.2 where more hangs on joints), and the sum of
the drags as a share of the sum of their magnitudes, above 0.22, of four rotors and more. How far the force of a
keyframe that is named for hovering is from the weight, above 5 %. Three rotors at least, along one axis.

When it is wrong: a frame whose rotors are meant to carry unlike shares, and a balloon or a boat whose buoyancy the code
adds. Where `<option>` has the density of water, or a body has `gravcomp`, nothing is told.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import FREE
from clinic.diagnosis.probes.rotors import Rotor, forces, rotors
from clinic.diagnosis.probes.shape import root_of
from clinic.diagnosis.probes.vector import across, add, dot, norm, sub, times, transpose
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, rounded

TITLE = "Rotors that do not hover"
FAMILIES = ("drifts", "sags")
UNPLANTED = "only one of the healthy models flies"

HOVER = re.compile(r"(?i)hover")
LEAST, PAIRED = 3, 4
ALONG = 0.7  # of a rotor's push along the common axis
TILT, LOADED, YAW, OFF = 0.06, 0.2, 0.22, 0.05
STRONG = 30.0  # of the weight
WATER = 100.0  # kg/m3
LEVEL_FROM, UP = 0.9, "0 0 1 0 0 0"


@dataclass(frozen=True)
class Drone:
    """A free body with rotors along one of its axes, and its weight in N; `up` is the way in which they push."""

    body: int
    rotors: tuple[Rotor, ...]
    up: tuple[float, ...]
    weight: float
    loaded: bool

    @property
    def arm(self) -> float:
        """The mean distance of the rotors from the axis through the centre of mass, in m."""
        beside = [norm(across(each.place, self.up)) for each in self.rotors]
        return max(sum(beside) / len(beside), 1e-9)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Drones that do not lift, tilt or turn at equal controls, and keyframes of hovering that do not carry them."""
    of = model.simulation
    for drone in _drones(of):
        names = tuple(of.name("actuator", each.actuator) for each in drone.rotors)
        if _level(of, drone.body) > LEVEL_FROM:
            probe = Probe("how level the rotors push", "", _level, (drone.body,), dynamic=False)
            says = "All push along the x axis of their sites, which is level: no gear says otherwise."
            edits = model.set("actuator", [each.actuator for each in drone.rotors], "gear", UP)
            yield Suspect(names, "gear", "1 0 0 0 0 0", UP, edits, probe, LEVEL_FROM, says, "0, upwards")
            continue
        yield from _lifts(model, drone, names)
        most = LOADED if drone.loaded else TILT
        if _tilt(of, drone.body) > most:
            aside = norm(_torques(of, drone)[1]) / drone.weight
            says = (
                f"Together they push {1000 * aside:.3g} mm beside the centre of mass; their arms are {drone.arm:.3g} m."
            )
            probe = Probe("torque at equal controls", "of weight times arm", _tilt, (drone.body,), dynamic=False)
            yield Suspect(names, "site", "", "about the centre of mass", (), probe, most, says, "around the middle")
        if len(drone.rotors) >= PAIRED and _yaw(of, drone.body) > YAW:
            drags = ", ".join(f"{dot(each.drag, drone.up):+g}" for each in drone.rotors)
            says = f"Their drags do not cancel: {drags} m."
            probe = Probe("drags left over", "of their sum", _yaw, (drone.body,), dynamic=False)
            yield Suspect(names, "gear", "", "half of them turned", (), probe, YAW, says, "as many to each side")
        yield from _hovers(model, drone)


def _drones(of: Simulation) -> Iterator[Drone]:
    g, owner = of.gravity, root_of(of)
    if not g or of.model("opt.density")[0] > WATER:
        return
    for body in of.free_bodies:
        found = _drone(of, body, g * of.model("body_subtreemass")[body])
        tree = [each for each, root in enumerate(owner) if root == body]
        if found and not any(of.model("body_gravcomp")[each] for each in tree):
            yield found


def _drone(of: Simulation, body: int, weight: float) -> Drone | None:
    every = rotors(of, body)
    sums = [sum(abs(each.push[k]) for each in every) for k in range(3)]
    axis = max(range(3), key=lambda k: sums[k])
    along = tuple(each for each in every if abs(each.push[axis]) > ALONG * norm(each.push))
    joints = [joint for joint, at in enumerate(of.model("jnt_bodyid")) if root_of(of)[int(at)] == body]
    moved = sum(of.driven_joint(each) in joints for each in range(of.count("actuator")))
    if len(along) < LEAST or len(along) <= 2 * (len(every) - len(along)) or moved > len(along):
        return None
    up = tuple(math.copysign(float(k == axis), _against(of, body)[axis]) for k in range(3))
    loaded = any(of.joint_type(joint) != FREE for joint in joints)
    return Drone(body, along, up, weight, loaded)


def _against(of: Simulation, body: int) -> tuple[float, ...]:
    """The direction against gravity in a body's axes, as it is now."""
    return times(transpose(of.data_row("xmat", body, 9)), [-x / of.gravity for x in of.model("opt.gravity")])


def _found(of: Simulation, body: int) -> Drone | None:
    return next((each for each in _drones(of) if each.body == body), None)


def _ends(of: Simulation, drone: Drone, end: int) -> list[float]:
    """The upper or the lower ends of the control ranges; 1 and -1 where there is none."""
    limited = of.model("actuator_ctrllimited")
    return [
        of.row("actuator_ctrlrange", each.actuator, 2)[end] if limited[each.actuator] else 2.0 * end - 1
        for each in drone.rotors
    ]


def _most(of: Simulation, drone: Drone) -> float:
    """What the rotors lift at most in N; infinite where a control has no range."""
    if not all(of.model("actuator_ctrllimited")[each.actuator] for each in drone.rotors):
        return math.inf
    of.begin()
    sides = [
        [force * dot(each.push, drone.up) for each, force in zip(drone.rotors, given, strict=True)]
        for given in (forces(of, drone.rotors, _ends(of, drone, end)) for end in (0, 1))
    ]
    return float(sum(map(max, *sides)))


def _short(of: Simulation, body: int) -> float:
    drone = _found(of, body)
    return drone.weight / max(_most(of, drone), 1e-9) if drone else 0.0


def _strength(of: Simulation, body: int) -> float:
    return 1 / max(_short(of, body), 1e-9)


def _torques(of: Simulation, drone: Drone) -> tuple[float, Sequence[float]]:
    """At equal controls that carry the weight: the yaw as a share, and the torque of roll and pitch in N m."""
    of.begin()
    control = min(_ends(of, drone, 1))
    given = forces(of, drone.rotors, [control or 1.0] * len(drone.rotors))
    pairs = list(zip(drone.rotors, given, strict=True))
    lift = sum(force * dot(each.push, drone.up) for each, force in pairs)
    if abs(lift) < 1e-12:
        return 0.0, (0.0, 0.0, 0.0)
    whole: Sequence[float] = (0.0, 0.0, 0.0)
    for each, force in pairs:
        whole = add(whole, each.torque, force * drone.weight / lift)
    drags = [force * dot(each.drag, drone.up) for each, force in pairs]
    return abs(sum(drags)) / max(sum(map(abs, drags)), 1e-12), sub(whole, [dot(whole, drone.up) * x for x in drone.up])


def _level(of: Simulation, body: int) -> float:
    """The sine of the angle between gravity and rotors that are left with the gear of x; 0 for others."""
    drone = _found(of, body)
    gears = {of.row("actuator_gear", each.actuator, 6) for each in drone.rotors} if drone else set()
    if drone is None or gears != {(1.0, 0.0, 0.0, 0.0, 0.0, 0.0)}:
        return 0.0
    of.begin()
    sites = [int(of.model("actuator_trnid")[2 * each.actuator]) for each in drone.rotors]
    upright = all(of.data_row("site_xmat", site, 9)[8] > LEVEL_FROM for site in sites)
    places = [each.place for each in drone.rotors]
    middle = tuple(sum(place[k] for place in places) / len(places) for k in range(3))
    around = norm(middle) < sum(map(norm, places)) / len(places) / 2  # and not behind
    return math.sqrt(max(0.0, 1 - dot(drone.up, _against(of, body)) ** 2)) if upright and around else 0.0


def _tilt(of: Simulation, body: int) -> float:
    drone = _found(of, body)
    return norm(_torques(of, drone)[1]) / (drone.weight * drone.arm) if drone else 0.0


def _yaw(of: Simulation, body: int) -> float:
    drone = _found(of, body)
    return _torques(of, drone)[0] if drone else 0.0


def _lifts(model: ReaderModel, drone: Drone, names: tuple[str, ...]) -> Iterator[Suspect]:
    """A drone whose weight is above what its rotors give at the ends of their control ranges, or next to nothing."""
    of = model.simulation
    most = _most(of, drone)
    numbers = [each.actuator for each in drone.rotors]
    low, high = of.row("actuator_ctrlrange", numbers[0], 2)
    if STRONG * drone.weight < most < math.inf:
        probe = Probe("what the rotors lift at most over the weight", "", _strength, (drone.body,), dynamic=False)
        says = f"They lift {most:.3g} N at most, {most / drone.weight:.0f} times what the drone weighs."
        yield Suspect(names, "ctrlrange", f"{low:g} {high:g}", "twice the weight", (), probe, STRONG, says, "2 to 10")
    if drone.weight <= most:
        return
    value = f"{low:g} {rounded(high * 2 * drone.weight / most)}" if most > 0 < high else ""
    edits: tuple[Edit, ...] = model.set("actuator", numbers, "ctrlrange", value) if value else ()
    yield Suspect(
        names,
        "ctrlrange",
        f"{low:g} {high:g}",
        value or "above the weight",
        edits,
        Probe("weight over what the rotors lift at most", "", _short, (drone.body,), dynamic=False),
        1.0,
        f"They lift {max(most, 0.0):.3g} N at most, and {of.name('body', drone.body)} weighs {drone.weight:.3g} N.",
        "twice the weight",
    )


def _carried(of: Simulation, body: int, key: int) -> float:
    """How far the vertical force at a keyframe is from the weight, as a share of it."""
    drone = _found(of, body)
    if not drone:
        return 0.0
    of.engine.reset(key)
    given = forces(of, drone.rotors, [of.data("ctrl")[each.actuator] for each in drone.rotors])
    up = _against(of, body)
    return abs(sum(f * dot(each.push, up) for each, f in zip(drone.rotors, given, strict=True)) / drone.weight - 1)


def _hovers(model: ReaderModel, drone: Drone) -> Iterator[Suspect]:
    """Keyframes of hovering whose controls do not carry the weight; those without controls are left alone."""
    of = model.simulation
    for key, name in enumerate(of.names("key")):
        controls = of.row("key_ctrl", key, of.count("actuator"))
        if not HOVER.search(name) or not any(controls) or (off := _carried(of, drone.body, key)) <= OFF:
            continue
        yield Suspect(
            (of.name("key", key),),
            "ctrl",
            f"{controls[drone.rotors[0].actuator]:g}",
            "the weight",
            (),
            Probe("force at the keyframe off the weight", "of it", _carried, (drone.body, key), dynamic=False),
            OFF,
            f"Its controls give a force that is {100 * off:.3g} % off the weight of {drone.weight:.4g} N.",
            "the weight over the number of rotors",
        )
