"""Closed forms: functions of numbers that a record's arithmetic may name. Each states its source."""

from __future__ import annotations

import math
from functools import partial


def servo_sag(kp: float, load: float) -> float:
    """The angle below horizontal, in rad, at which a position servo holds an arm: the root of kp q = load cos q.

    `kp` is in N m/rad, `load` the gravity torque of the horizontal arm in N m. Newton's method; both sides are
    monotonic on [0, pi/2], so the root is unique.
    """
    angle = min(load / kp, math.pi / 2)
    for _ in range(60):
        angle -= (kp * angle - load * math.cos(angle)) / (kp + load * math.sin(angle))
    return angle


def bits(mask: float, other: float) -> float:
    """The bits that two masks share, as MuJoCo's filter asks for them: `mask & other`."""
    return float(int(mask) & int(other))


def held_share(drop: float, speed: float, room: float, tau: float, h: float, spread: float, count: float) -> float:
    """The share of start heights from which a falling ball is thrown back by a thin shelf.

    One dimension, semi-implicit Euler, one soft contact; formulas from MuJoCo's manual, *Computation*, with the default
    `solimp` and a damping ratio of 1. The contact pushes up while the ball's centre is above the shelf's mid-plane.

    Args:
        drop: Height of the lowest start above the shelf's mid-plane, in m.
        speed: Vertical speed at the start, in m/s.
        room: Half the shelf's thickness plus the ball's radius, in m.
        tau: Time constant of the contact in s; `refsafe` raises it to 2 h.
        h: Timestep in s.
        spread: The range of start heights in m.
        count: How many starts, evenly spaced over the range, both ends included.

    Raises:
        ValueError: For a fall that does not end.
    """
    held = [thrown_back(drop + spread * k / (count - 1), speed, room, max(tau, 2 * h), h) for k in range(int(count))]
    return sum(held) / count


def thrown_back(height: float, speed: float, room: float, tau: float, h: float) -> bool:
    """Whether a ball that starts `height` above the mid-plane of a shelf turns before its centre passes it.

    Raises:
        ValueError: If it has done neither after MOST_STEPS steps.
    """
    damping, stiffness = 2 / (D_MAX * tau), 1 / (D_MAX * tau) ** 2
    for _ in range(MOST_STEPS):
        if height <= 0:
            return False
        depth, acceleration = room - height, -GRAVITY
        if depth > 0:
            d = impedance(depth)
            reference = stiffness * d * depth - damping * speed
            acceleration += max(0.0, d * (reference - acceleration))
        speed += h * acceleration
        height += h * speed
        if speed > 0:
            return True
    raise ValueError(f"a fall of at most {MOST_STEPS} steps")


def impedance(depth: float) -> float:
    """MuJoCo's impedance d(r) for the default `solimp`: 0.9 to 0.95 over 1 mm, two parabolas."""
    x = min(depth / 0.001, 1.0)
    y = 2 * x * x if x <= 0.5 else 1 - 2 * (1 - x) ** 2
    return 0.9 + y * (D_MAX - 0.9)


def upright_time(
    load: float, inertia: float, kp: float, kd: float, period: float, start: float, fallen: float, longest: float
) -> float:
    """How long, in s, an inverted pendulum stays within `fallen` of upright when its controller is called too rarely.

    Between two calls the torque -kp q - kd v is constant and q'' = a^2 (q + q0) has the solution with cosh and sinh;
    linear in the tilt, so `fallen` must be small.

    Args:
        load: Gravity's torque for a small tilt, m g l, in N m/rad.
        inertia: About the hinge, in kg m^2.
        kp: Gain on the tilt in N m/rad.
        kd: Gain on its speed in N m s/rad.
        period: Simulated time between two calls, in s.
        start: Tilt at the start, at rest, in rad.
        fallen: Tilt at which it has fallen, in rad.
        longest: What is returned if it has not fallen by then, in s.

    Raises:
        ValueError: For a period of 0, or more than MOST_STEPS calls.
    """
    if not longest <= period * MOST_STEPS:
        raise ValueError(f"a period above 0, and at most {MOST_STEPS} calls")
    a = math.sqrt(load / inertia)
    q, v, time = start, 0.0, 0.0
    while time < longest:
        offset = -(kp * q + kd * v) / load
        path = partial(_tilt, a, q + offset, v, offset)
        for k in range(SEARCH):
            low, high = period * k / SEARCH, period * (k + 1) / SEARCH
            if abs(path(high)) >= fallen:
                while high - low > 1e-9 and low < (middle := (low + high) / 2) < high:
                    low, high = (low, middle) if abs(path(middle)) >= fallen else (middle, high)
                return min(time + high, longest)
        v = a * (q + offset) * math.sinh(a * period) + v * math.cosh(a * period)
        q, time = path(period), time + period
    return longest


def _tilt(a: float, x: float, v: float, offset: float, t: float) -> float:
    return x * math.cosh(a * t) + v / a * math.sinh(a * t) - offset


SEARCH = 16
MOST_STEPS = 20_000
D_MAX = 0.95
GRAVITY = 9.81
FUNCTIONS = {function.__name__: function for function in (servo_sag, bits, held_share, upright_time)}
MODEL_NUMBERS = ("omega_max", "omega_one_link")  # what a prediction reads of a model: engine/measure.py
