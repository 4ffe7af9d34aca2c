"""Position servos: what they are told to do, and how the joint follows."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

from clinic.diagnosis.engine import (
    ACTUATORS_OFF,
    BIAS_AFFINE,
    CONTACTS_OFF,
    DYN_INTEGRATOR,
    DYN_MUSCLE,
    EULER,
    EULERDAMP_OFF,
    GAIN_FIXED,
    HINGE,
    RK4,
    SPRINGS_OFF,
)
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import probe

STEP = {True: 0.1, False: 0.01}  # of a hinge in rad, of a slide in m
COEFFICIENTS = {  # units of stiffness, damping and inertia, by that of the joint's position
    "rad": ("N m/rad", "N m s/rad", "kg m2"),
    "m": ("N/m", "N s/m", "kg"),
}
BEARS = {EULER: 2.0, RK4: 2.79}  # the largest stable h d / M of a damper; Euler's without eulerdamp


@dataclass(frozen=True)
class Servo:
    """A position servo of a hinge or slide: at the joint, in N m, rad and s, or N, m and s.

    It pulls towards `offset + scale * ctrl` with `stiffness`; `damping` has the joint's in it. `force` is the most
    that it can give.
    """

    actuator: int
    joint: int
    dof: int
    hinge: bool
    stiffness: float
    damping: float
    scale: float
    offset: float
    force: float
    inertia: float
    ctrl: tuple[float, float] | None
    range: tuple[float, float] | None

    @property
    def unit(self) -> str:
        """Of the joint's position."""
        return "rad" if self.hinge else "m"

    @property
    def force_unit(self) -> str:
        """Of the force at the joint."""
        return "N m" if self.hinge else "N"

    @property
    def ratio(self) -> float:
        """The damping ratio; 1 is critical."""
        return self.damping / (2 * math.sqrt(self.stiffness * self.inertia))

    @property
    def targets(self) -> tuple[float, float] | None:
        """Where its control range can send the joint."""
        if self.ctrl is None:
            return None
        ends = [self.target(each) for each in self.ctrl]
        return min(ends), max(ends)

    def target(self, ctrl: float) -> float:
        """The position in rad or m that a control calls for."""
        return self.offset + self.scale * ctrl

    def holding(self, position: float) -> float:
        """The control that calls for a position in rad or m, whatever the control range is."""
        return (position - self.offset) / self.scale

    def command(self, position: float) -> float:
        """The control that calls for a position, within the control range."""
        wanted = self.holding(position)
        return min(max(wanted, self.ctrl[0]), self.ctrl[1]) if self.ctrl else wanted


@kept
def servos(simulation: Simulation) -> list[Servo]:
    """The position servos of hinges and slides that the model has, however they are written."""
    found = (_servo(simulation, actuator) for actuator in range(simulation.count("actuator")))
    return [each for each in found if each is not None]


@kept
def feedback(simulation: Simulation) -> dict[int, tuple[float, float]]:
    """What all actuators of a joint together answer to its position and to its speed: kp and kv, by joint."""
    made: dict[int, tuple[float, float]] = {}
    for actuator in range(simulation.count("actuator")):
        joint = simulation.driven_joint(actuator)
        if joint is None or int(simulation.model("actuator_biastype")[actuator]) != BIAS_AFFINE:
            continue
        bias, gear = simulation.bias(actuator), simulation.gear(actuator)
        kp, kv = made.get(joint, (0.0, 0.0))
        made[joint] = kp + max(0.0, -bias[1] * gear**2), kv + max(0.0, -bias[2] * gear**2)
    return made


def damping_is_implicit(simulation: Simulation) -> bool:
    """Whether Euler takes the damping of joints implicitly."""
    integrator, flags = (int(simulation.model(f"opt.{name}")[0]) for name in ("integrator", "disableflags"))
    return integrator == EULER and not flags & EULERDAMP_OFF


def damped_beyond(simulation: Simulation) -> dict[int, float]:
    """The step's share h d / M of the degrees of freedom whose explicit damping is more than the integrator bears.

    M is what the joint moves, which the joints around it give way to.
    """
    if (limit := BEARS.get(int(simulation.model("opt.integrator")[0]))) is None:
        return {}
    damping, masses, freed = explicit_damping(simulation), simulation.mass_diagonal, simulation.model("dof_invweight0")
    rates = [each * max(1 / max(m, 1e-12), w) for each, m, w in zip(damping, masses, freed, strict=True)]
    shares = [simulation.timestep * rate for rate in rates]
    return {dof: share for dof, share in enumerate(shares) if share > limit}


def explicit_damping(simulation: Simulation) -> list[float]:
    """Each degree of freedom's damping by servos, and by its joint where Euler does not take that implicitly."""
    implicit = damping_is_implicit(simulation)
    damping = [0.0 if implicit else each for each in simulation.model("dof_damping")]
    for joint, (_, kv) in feedback(simulation).items():
        damping[simulation.dof(joint)] += kv
    return damping


def affine(simulation: Simulation, actuator: int) -> bool:
    """Whether a force is a fixed gain times the control, be it filtered, and an affine function of place and speed."""
    gain, bias, dyn = simulation.actuator_types(actuator)
    return gain == GAIN_FIXED and bias == BIAS_AFFINE and dyn not in (DYN_INTEGRATOR, DYN_MUSCLE)


def _servo(simulation: Simulation, actuator: int) -> Servo | None:
    joint = simulation.driven_joint(actuator)
    if joint is None or not affine(simulation, actuator):
        return None
    gain, bias = simulation.gain(actuator)[0], simulation.bias(actuator)
    gear = simulation.gear(actuator)
    if not gain or not gear or bias[1] >= 0:
        return None
    dof = simulation.dof(joint)
    damping = simulation.model("dof_damping")[dof]
    limits = [math.inf]
    if simulation.model("actuator_forcelimited")[actuator]:
        limits.append(max(map(abs, simulation.row("actuator_forcerange", actuator, 2))) * abs(gear))
    if simulation.model("jnt_actfrclimited")[joint]:
        limits.append(max(map(abs, simulation.row("jnt_actfrcrange", joint, 2))))
    limited = simulation.model("actuator_ctrllimited")[actuator]
    return Servo(
        actuator,
        joint,
        dof,
        simulation.joint_type(joint) == HINGE,
        -bias[1] * gear**2,
        -bias[2] * gear**2 + damping,
        gain / (-bias[1] * gear),
        bias[0] / (-bias[1] * gear),
        min(limits),
        max(simulation.mass_diagonal[dof], 1e-12),
        simulation.row("actuator_ctrlrange", actuator, 2) if limited else None,  # type: ignore[arg-type]
        simulation.ranges.get(joint),
    )


def speed_gain(simulation: Simulation, actuator: int) -> float:
    """The gain of a velocity servo, before its gear; 0 of another actuator."""
    bias = simulation.bias(actuator)
    return -bias[2] if bias[1] == 0 > bias[2] else 0.0


def hold(simulation: Simulation) -> None:
    """Tells every position servo to stay where its joint is."""
    for servo in servos(simulation):
        command(simulation, servo, simulation.position(servo.joint))


def command(simulation: Simulation, servo: Servo, position: float) -> None:
    """Tells a servo where to go; one with a filter begins there."""
    ctrl = servo.command(position)
    simulation.engine.write("ctrl", [ctrl], servo.actuator)
    state = int(simulation.model("actuator_actadr")[servo.actuator])
    if state >= 0:
        simulation.engine.write("act", [ctrl], state)


@contextmanager
def alone(simulation: Simulation, *, gravity: bool = False, limp: bool = False) -> Iterator[None]:
    """Without contacts and gravity, and where `limp` without actuators and springs, for as long as the block takes."""
    engine = simulation.engine
    flags, pull = simulation.model("opt.disableflags")[0], list(simulation.model("opt.gravity"))
    off = CONTACTS_OFF | (SPRINGS_OFF | ACTUATORS_OFF if limp else 0)
    engine.write_model("opt.disableflags", [int(flags) | off])
    if not gravity:
        engine.write_model("opt.gravity", [0.0, 0.0, 0.0])
    try:
        yield
    finally:
        engine.write_model("opt.disableflags", [int(flags)])
        engine.write_model("opt.gravity", pull)


def servo_of(simulation: Simulation, actuator: int) -> Servo | None:
    """The position servo that an actuator is; None for another kind."""
    return next((each for each in servos(simulation) if each.actuator == actuator), None)


def greatest(simulation: Simulation, number: Callable[[Servo], float], actuators: Collection[int]) -> float:
    """The greatest that a number of the servos among some actuators is, in its own unit; 0 where none is a servo."""
    return max((number(each) for each in servos(simulation) if each.actuator in actuators), default=0.0)


@probe("overshoot of a step of 0.1 rad (0.01 m) without gravity that rings four times, as a share of the step")
def overshoot(simulation: Simulation, actuators: Sequence[int]) -> float:
    """How much a step of a servo rings: its overshoot as a share of the step, 0 where it soon comes to rest."""
    return max((_rings(simulation, actuator) for actuator in actuators), default=0.0)


@kept
def _rings(simulation: Simulation, actuator: int) -> float:
    servo = servo_of(simulation, actuator)
    with alone(simulation):
        return _stepped(simulation, servo) if servo else 0.0


def _begun(simulation: Simulation, servo: Servo) -> tuple[float, float]:
    """Begins a step of a servo, the others holding: where it is told to go, and how far that is."""
    simulation.begin()
    hold(simulation)
    begin = simulation.position(servo.joint)
    step = STEP[servo.hinge]
    if servo.range:
        low, high = servo.range
        step = min(step, 0.1 * (high - low))
        step = step if high - begin > begin - low else -step
    command(simulation, servo, begin + step)
    goal = servo.target(simulation.data("ctrl")[servo.actuator])
    return goal, goal - begin


def _stepped(simulation: Simulation, servo: Servo) -> float:
    """The overshoot as a share of the step where the joint swings through the target four times, else 0."""
    goal, way = _begun(simulation, servo)
    if abs(way) < 0.03 * STEP[servo.hinge]:
        return 0.0
    period = 2 * math.pi * math.sqrt(servo.inertia / servo.stiffness)
    swings, farthest, side = [], 0.0, -1.0
    for _ in simulation.run(min(4.5 * period, 5.0), samples=250):
        if simulation.unstable():
            return math.inf
        beyond = (simulation.position(servo.joint) - goal) / way
        if beyond * side < 0:
            swings.append(farthest)
            farthest, side = 0.0, -side
        farthest = max(farthest, abs(beyond))
    return swings[1] if len(swings) > 4 else 0.0


@probe("share of a step of 0.1 rad (0.01 m) that is left after 1 s, without gravity")
def remaining(simulation: Simulation, actuators: Sequence[int]) -> float:
    """How late servos are."""
    return max((_late(simulation, actuator) for actuator in actuators), default=0.0)


@kept
def _late(simulation: Simulation, actuator: int) -> float:
    """The share of a step that is left after 1 s."""
    servo = servo_of(simulation, actuator)
    if servo is None:
        return 0.0
    with alone(simulation):
        goal, way = _begun(simulation, servo)
        for _ in simulation.run(1.0, samples=5):
            pass
        left = abs(goal - simulation.position(servo.joint)) / max(abs(way), 1e-9)
        return math.inf if simulation.unstable() else left
