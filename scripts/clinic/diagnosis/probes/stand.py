"""Standing: whether servos that hold the start carry a robot with a free base, or let it go down."""

from __future__ import annotations

from dataclasses import dataclass

from clinic.diagnosis.probes.servo import Servo, hold, servos
from clinic.diagnosis.probes.shape import boxes, geoms_of_tree, in_pairs, plane_heights, root_of, solid
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe, probe

SECONDS = 1.0
LEAST = 4  # servos of one robot
NEAR = 0.15  # of its height: so far above the floor it may begin
LOST, BENT = 0.25, 0.45  # of its height, rad: more, and the servos do not carry it
FULL = 0.98  # of the greatest force


@dataclass(frozen=True)
class Stance:
    """What was seen of one robot.

    Attributes:
        lost: The share of its height that its base went down; 0 where nothing stands.
        bent: How far each of its hinges is off its target at the end in rad, by servo.
        full: The servos that give all that they can.
    """

    lost: float
    bent: dict[Servo, float]
    full: tuple[Servo, ...]


def stance(simulation: Simulation) -> Stance:
    """The robot with most servos, 1 s after they were told to hold the start."""
    return stance_after(simulation, SECONDS)


@kept
def stance_after(simulation: Simulation, seconds: float) -> Stance:
    """The same after so many seconds."""
    none = Stance(0.0, {}, ())
    owner, bodies = root_of(simulation), simulation.model("jnt_bodyid")
    by_root: dict[int, list[Servo]] = {}
    for servo in servos(simulation):
        if servo.hinge:
            by_root.setdefault(owner[int(bodies[servo.joint])], []).append(servo)
    root, own = max(by_root.items(), key=lambda each: len(each[1]), default=(0, []))
    if root not in simulation.free_bodies or len(own) < LEAST or not simulation.gravity:
        return none
    simulation.begin()
    hold(simulation)
    low, floor = _lowest(simulation, root), max(plane_heights(simulation), default=None)
    high = simulation.data_row("xpos", root, 3)[2]
    height = high - low
    if floor is None or height <= 0 or abs(low - floor) > NEAR * height:
        return none
    for _ in simulation.run(seconds):
        if simulation.unstable():
            return none
    down = floor + height - simulation.data_row("xpos", root, 3)[2]
    targets = simulation.data("ctrl")
    bent = {s: abs(s.target(targets[s.actuator]) - simulation.position(s.joint)) for s in own}
    forces, gears = simulation.data("actuator_force"), simulation.model("actuator_gear")
    full = [s for s in own if abs(forces[s.actuator] * gears[6 * s.actuator]) >= FULL * s.force]
    return Stance(down / height, bent, tuple(full))


def _lowest(simulation: Simulation, root: int) -> float:
    """The lowest point of what collides of a tree, in m."""
    paired = in_pairs(simulation)
    geoms = [each for each in geoms_of_tree(simulation, root) if solid(simulation, each) or each in paired]
    found = boxes(simulation, geoms)
    return min((centre[2] - half[2] for centre, half in found.values()), default=float("inf"))


def _lost(simulation: Simulation, seconds: float) -> float:
    return stance_after(simulation, seconds).lost


def goes_down(seconds: float = SECONDS) -> Probe:
    """How far a robot goes down whose servos hold the start."""
    title = f"height that the base loses within {seconds:g} s while all servos hold the start"
    return Probe(title, "of its height", _lost, (seconds,))


@probe(f"servos that give all they can after {SECONDS:g} s in which all of them hold the start")
def at_their_limit(simulation: Simulation) -> float:
    """How many servos give all they can under a robot that stands."""
    return float(len(stance(simulation).full))
