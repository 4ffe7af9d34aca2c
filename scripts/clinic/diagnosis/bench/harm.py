"""What a fault does to a model: its behaviour beside that of the healthy one, measured without the rules.

Each harm is a number that is 1 where it begins to matter; the limits stand beside the measurements.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np

from clinic.diagnosis.bench.behaviour import SAMPLES, Behaviour, Run
from clinic.diagnosis.engine import HINGE, SLIDE


def pairs(was: Behaviour, now: Behaviour) -> Iterator[tuple[Run, Run]]:
    """The runs that look at the model as a whole, where the healthy one stays calm."""
    for name in ("let_go", "pushed", "driven"):
        before: Run = getattr(was, name)
        if not before.unstable:
            yield before, getattr(now, name)


def unstable(was: Behaviour, now: Behaviour) -> float:
    """It goes to infinity, and the healthy one does not."""
    more = zip(was.commanded, now.commanded, strict=True)
    return 10.0 * any(after.unstable and not before.unstable for before, after in (*pairs(was, now), *more))


def faster(was: Behaviour, now: Behaviour) -> float:
    """Something in it is 5 times as fast, and faster than 5 rad/s."""
    return max((_size(after.fastest / max(5 * before.fastest, 5.0)) for before, after in pairs(was, now)), default=0.0)


def strays(was: Behaviour, now: Behaviour) -> float:
    """A body is elsewhere by a twentieth of the model's extent, and 3 times as far as chaos alone leads."""
    if was.model.nbody != now.model.nbody:
        return 0.0
    chaos = _apart(was.let_go, was.astray)
    least = max(0.05 * was.model.stat.extent, 3 * chaos)
    return max((_size(_apart(before, after) / least) for before, after in pairs(was, now)), default=0.0)


def _apart(one: Run, other: Run) -> float:
    if one.positions is None or other.positions is None:
        return 0.0 if one.positions is None else math.inf
    return float(np.linalg.norm(one.positions - other.positions, axis=2).max())


def sinks(was: Behaviour, now: Behaviour) -> float:
    """Contacts are 3 times as deep, and deeper than a hundredth of the extent."""
    least = 0.01 * was.model.stat.extent
    return max(
        (_size(after.deepest / max(3 * before.deepest, least)) for before, after in pairs(was, now)), default=0.0
    )


def jumps(was: Behaviour, now: Behaviour) -> float:
    """The first acceleration is 3 times the healthy one's and 3 times gravity's over the extent."""
    usual = 3 * 9.81 / max(was.model.stat.extent, 0.01)
    first, after = (float(np.abs(each.start.qacc).max(initial=0)) for each in (was, now))
    return _size(after / max(3 * first, usual))


def reaches(was: Behaviour, now: Behaviour) -> float:
    """A pressed hinge or slide ends elsewhere by 0.1 rad, or by a twentieth of the extent."""
    made = 0.0
    for before, after in zip(was.pressed, now.pressed, strict=True):
        made = max(made, _joints_apart(was, before, after, 0.1))
    return made


def commands(was: Behaviour, now: Behaviour) -> float:
    """At the ends of the controls a joint is elsewhere by 0.2 rad, or by a twentieth of the extent."""
    made = 0.0
    for before, after in zip(was.commanded, now.commanded, strict=True):
        made = max(made, _joints_apart(was, before, after, 0.2))
    return made


def _joints_apart(was: Behaviour, before: Run, after: Run, angle: float) -> float:
    if before.positions is None or after.positions is None or before.joints.shape != after.joints.shape:
        return 10.0 if before.positions is not None and after.positions is None else 0.0
    made = 0.0
    for joint, kind in enumerate(was.model.jnt_type):
        if kind in (SLIDE, HINGE):
            at = was.model.jnt_qposadr[joint]
            limit = angle if kind == HINGE else 0.05 * was.model.stat.extent
            made = max(made, abs(before.joints[-1, at] - after.joints[-1, at]) / limit)
    return _size(made)


def misses(was: Behaviour, now: Behaviour) -> float:
    """A servo ends a quarter of its step further from the target, or 0.1 rad, or swings by as much."""
    before, after = was.stepped, now.stepped
    if before.positions is None or after.positions is None or before.lengths.shape != after.lengths.shape:
        return 10.0 if before.positions is not None and after.positions is None else 0.0
    made = 0.0
    for i in was.servos:
        joint = was.model.actuator_trnid[i, 0]
        at = was.model.jnt_qposadr[joint]
        step = max(abs(was.targets[i] - was.start.qpos[at]), 1e-6)
        error = [float(np.abs(run.joints[SAMPLES // 2 :, at] - was.targets[i]).max()) for run in (before, after)]
        made = max(made, (error[1] - error[0]) / (0.25 * step))
    return _size(made)


def weighs(was: Behaviour, now: Behaviour) -> float:
    """The model's mass, or that of a body that has a hundredth of it, is off by 20 %."""
    if was.model.nbody != now.model.nbody:
        return 0.0
    share = 0.01 * was.model.body_mass.sum()
    total = (was.model.body_mass.sum(), now.model.body_mass.sum())
    masses = [(was.model.body_mass[i], now.model.body_mass[i]) for i in range(1, was.model.nbody)]
    return _size(max(_factor(*each) for each in (total, *masses) if max(each) > share) / 1.2)


def accelerates(was: Behaviour, now: Behaviour) -> float:
    """What some joint has to move, or has to hold at the start, is off by a third."""
    if was.model.nv != now.model.nv:
        return 0.0
    moved = max(map(_factor, was.mass_diagonal, now.mass_diagonal), default=1.0) / (4 / 3)
    loads = [np.abs(each.start.qfrc_bias) for each in (was, now)]
    some = 0.05 * max(1e-9, float(loads[0].max(initial=0)))
    held = max((_factor(a, b) for a, b in zip(*loads, strict=True) if max(a, b) > some), default=1.0) / (4 / 3)
    return _size(max(moved, held if was.model.opt.gravity.any() else 0.0))


def reads(was: Behaviour, now: Behaviour) -> float:
    """A sensor that told something tells at most a tenth of it."""
    made = 0.0
    for before, after in pairs(was, now):
        if not after.unstable and before.sensors.shape == after.sensors.shape:
            told = before.sensors > 1e-6
            made = max([made, *(before.sensors[told] / np.maximum(10 * after.sensors[told], 1e-9))])
    return _size(made)


def keys(was: Behaviour, now: Behaviour) -> float:
    """A keyframe, where the healthy model has none, begins elsewhere than it by 0.2, in rad or m."""
    if (was.model.key_qpos != was.model.qpos0).any() or was.model.nq != now.model.nq:
        return 0.0
    return _size(float(np.abs(now.model.key_qpos - was.model.qpos0).max(initial=0)) / 0.2)


def looks(was: Behaviour, now: Behaviour) -> float:
    """A camera is turned by 30 degrees, or its field of view is off by a third."""
    made = 0.0
    for i in range(min(was.model.ncam, now.model.ncam)):
        one, other = was.start.cam_xmat[i].reshape(3, 3), now.start.cam_xmat[i].reshape(3, 3)
        angle = math.acos(min(1.0, max(-1.0, (np.trace(one.T @ other) - 1) / 2)))
        made = max(made, angle / math.radians(30), _factor(was.model.cam_fovy[i], now.model.cam_fovy[i]) / (4 / 3))
    return made


def _factor(one: float, other: float) -> float:
    """How many times the larger is the smaller; 1 where both are next to nothing."""
    low, high = sorted((abs(float(one)), abs(float(other))))
    return 1.0 if high < 1e-12 else min(1e6, high / max(low, 1e-12))


def _size(excess: float) -> float:
    """Bounded, so that it can be told."""
    return 10.0 if math.isnan(excess) else float(min(10.0, max(0.0, excess)))


HARMS: dict[str, Callable[[Behaviour, Behaviour], float]] = {
    each.__name__: each
    for each in (
        unstable,
        faster,
        strays,
        sinks,
        jumps,
        reaches,
        commands,
        misses,
        weighs,
        accelerates,
        reads,
        keys,
        looks,
    )
}
