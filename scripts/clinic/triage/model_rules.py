"""Triage, step 2: the model as compiled. Each rule names what is unusual about sizes, units and defaults.

A rule's docstring states its threshold in one sentence; the triage page lists them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import mujoco
import numpy as np
from numpy.typing import NDArray

from clinic.engine.releases import control_of
from clinic.triage.findings import Finding, StepResult, counted, format_number
from clinic.triage.recording import Array, Subject, flags
from clinic.triage.stiffness import HINGE, SLIDE, highest_frequency, inertias, joint_servos

Seen = Iterator[tuple[str, str]]
Rule = Callable[[Subject], Seen]
LIMITS = {"mjINT_EULER": 2.0, "mjINT_IMPLICIT": 2.0, "mjINT_IMPLICITFAST": 2.0, "mjINT_RK4": 2.83}
"""The longest stable step times omega, by integrator."""


def ranges(s: Subject) -> Seen:
    """A hinge's range is narrower than 0.1 rad (5.7°) or wider than 4 turns, as ranges in a wrong unit are."""
    for i in range(s.model.njnt):
        if s.model.jnt_type[i] == HINGE and s.model.jnt_limited[i]:
            low, high = s.model.jnt_range[i]
            if high - low < 0.1 or high - low > 8 * math.pi:
                yield s.called("joint", i), f"range {format_number(low)} to {format_number(high, 'rad')}"


def unused_ranges(s: Subject) -> Seen:
    """A joint or actuator has a range that is not in force, reversed ranges included."""
    m = s.model
    for i in range(m.njnt):
        if m.jnt_range[i].any() and not m.jnt_limited[i]:
            yield s.called("joint", i), f"range {_pair(m.jnt_range[i])} is given and not in force"
    for i in range(m.nu):
        if m.actuator_ctrlrange[i].any() and not m.actuator_ctrllimited[i]:
            yield s.called("actuator", i), f"ctrlrange {_pair(m.actuator_ctrlrange[i])} is given and not in force"


def start_outside(s: Subject) -> Seen:
    """The start lies outside a joint's range, or a control outside its ctrlrange, by more than 1 % of it."""
    m, d = s.model, s.data
    for i in range(m.njnt):
        value = d.qpos[m.jnt_qposadr[i]]
        if m.jnt_limited[i] and m.jnt_type[i] in (HINGE, SLIDE) and _outside(value, m.jnt_range[i]):
            limits = _pair(m.jnt_range[i], "rad" if m.jnt_type[i] == HINGE else "m")
            yield s.called("joint", i), f"starts at {format_number(value)}, outside its range {limits}"
    for i in range(m.nu):
        control, limits = control_of(m, i), m.actuator_ctrlrange[i]
        if m.actuator_ctrllimited[i] and control is not None and _outside(d.ctrl[control], limits):
            yield s.called("actuator", i), f"control {format_number(d.ctrl[control])} is clamped to {_pair(limits)}"


def still(s: Subject) -> Seen:
    """Nothing can move: there are geoms and gravity, and no degree of freedom."""
    if s.model.nv == 0 and s.model.ngeom and np.any(s.model.opt.gravity):
        yield "model", "has no degree of freedom: nothing can fall or move"


def gains(s: Subject) -> Seen:
    """An actuator's gain or gear is 0."""
    m = s.model
    for i in np.flatnonzero(m.actuator_gaintype == mujoco.mjtGain.mjGAIN_FIXED).tolist():
        if m.actuator_gainprm[i, 0] == 0:
            yield s.called("actuator", i), "gain 0: no control moves anything"
        elif not m.actuator_gear[i].any():
            yield s.called("actuator", i), "gear 0: no control moves anything"


def weak_servos(s: Subject) -> Seen:
    """Gravity at the start pulls a position servo more than 0.2 rad or 0.05 m off its target (load/kp)."""
    for i, dof, stiffness in joint_servos(s):
        hinge = s.model.jnt_type[s.model.dof_jntid[dof]] == HINGE
        sag = abs(s.data.qfrc_bias[dof] - s.data.qfrc_gravcomp[dof]) / stiffness
        if sag > (0.2 if hinge else 0.05):
            load = format_number(abs(s.data.qfrc_bias[dof]), "N m" if hinge else "N")
            kp = format_number(stiffness, "N m/rad" if hinge else "N/m")
            yield s.called("actuator", i), f"carries {load} with {kp}"


def undamped(s: Subject) -> Seen:
    """A position servo or a spring acts on a joint with a damping ratio below 0.02."""
    m = s.model
    stiffness, damping = m.jnt_stiffness[m.dof_jntid].astype(float), np.array(m.dof_damping, dtype=float)
    elements = {int(dof): ("joint", int(m.dof_jntid[dof])) for dof in np.flatnonzero(stiffness)}
    for i, dof, k in joint_servos(s):
        stiffness[dof] += k
        damping[dof] -= m.actuator_biasprm[i, 2] * m.actuator_gear[i, 0] ** 2
        elements[dof] = ("actuator", i)
    critical = 2 * np.sqrt(stiffness * inertias(s))
    for dof, element in sorted(elements.items()):
        if damping[dof] < 0.02 * critical[dof]:
            ratio = format_number(damping[dof] / critical[dof])
            yield s.called(*element), f"damping ratio {ratio}: nothing ends its oscillation"


def masses(s: Subject) -> Seen:
    """A moving body is more than 10,000 times lighter than the heaviest, or weighs over 10 t."""
    m = s.model
    moving = [int(b) for b in np.flatnonzero(m.body_treeid >= 0)]
    heaviest = max((m.body_mass[b] for b in moving), default=0.0)
    for b in moving:
        mass = format_number(m.body_mass[b], "kg")
        if m.body_mass[b] > 1e4:
            yield s.called("body", b), f"mass {mass}"
        elif 0 < m.body_mass[b] < 1e-4 * heaviest:
            yield s.called("body", b), f"mass {mass} beside {format_number(heaviest, 'kg')}"


def lengths(s: Subject) -> Seen:
    """The scene fits into 10 mm or reaches over 1 km, as scenes in a wrong unit do; planes left out."""
    size = s.model.stat.extent
    if s.model.ngeom and not 0.01 <= size <= 1000:
        yield "scene", f"is {format_number(size, 'm')} long"


def gravity(s: Subject) -> Seen:
    """Gravity is not between 9 and 10.5 m/s² along −z."""
    g = np.asarray(s.model.opt.gravity)
    if not (9 <= -g[2] <= 10.5 and abs(g[:2]).max() < 0.1):
        yield "option", f"gravity {' '.join(format_number(v) for v in g)} m/s²"


def switches(s: Subject) -> Seen:
    """A part of the physics is switched off by a flag."""
    for name in ("constraint", "equality", "limit", "contact", "spring", "damper", "gravity", "actuation", "autoreset"):
        if s.model.opt.disableflags & flags(name):
            yield "option", f"{name} is disabled by a flag"


def time_steps(s: Subject) -> Seen:
    """The timestep is not positive, or above 80 % of the longest that springs and servos allow: 2/omega_max, or
    2.83/omega_max under RK4.
    """
    h, name = s.model.opt.timestep, mujoco.mjtIntegrator(s.model.opt.integrator).name
    if h <= 0:
        yield "option", f"timestep {format_number(h, 's')}: time does not go on"
    elif name in LIMITS and highest_frequency(s) * h > 0.8 * LIMITS[name]:
        longest = format_number(1e3 * LIMITS[name] / highest_frequency(s), "ms")
        yield "option", f"timestep {format_number(1e3 * h, 'ms')}; springs and servos are stable to {longest}"


def time_constants(s: Subject) -> Seen:
    """A geom's contact time constant, solref[0], is shorter than two timesteps."""
    m, shortest = s.model, 2 * s.model.opt.timestep
    for i in filter(lambda i: collides(m, i), range(m.ngeom)):
        if 0 < m.geom_solref[i, 0] < shortest * (1 - 1e-9):
            solref, two = format_number(1e3 * m.geom_solref[i, 0], "ms"), format_number(1e3 * shortest, "ms")
            yield s.called("geom", i), f"solref {solref}, two steps are {two}"


def lonely(s: Subject) -> Seen:
    """A geom has contact masks, and there are moving geoms, but its masks match none that could meet it."""
    m = s.model
    named = {int(i) for i in (*m.pair_geom1, *m.pair_geom2)}
    for i in range(m.ngeom):
        others, matching = _partners(m, i)
        if collides(m, i) and i not in named and len(others) and not matching.any():
            masks = f"contype {m.geom_contype[i]} conaffinity {m.geom_conaffinity[i]}"
            yield s.called("geom", i), f"{masks}: collides with no other of {counted(len(others), 'geom')}"


def priorities(s: Subject) -> Seen:
    """Geoms of unequal priority can meet, and the one that decides has less than half the other's friction."""
    m, friction = s.model, s.model.geom_friction[:, 0]
    for i in np.flatnonzero(m.geom_priority > m.geom_priority.min(initial=0)).tolist():
        others, matching = _partners(m, i)
        lower = others[matching & (m.geom_priority[others] < m.geom_priority[i])]
        roughest = int(lower[friction[lower].argmax()]) if len(lower) else i
        if friction[i] < 0.5 * friction[roughest]:
            sets = f"priority {m.geom_priority[i]} sets friction {format_number(friction[i])}"
            other = f"{format_number(friction[roughest])} of {s.called('geom', roughest)}"
            yield s.called("geom", i), f"{sets} against {other}"


def quaternions(s: Subject) -> Seen:
    """A quaternion in the file has a length other than 1 by more than 0.01 (those of 0 and ±1 alone aside), or a body
    placed in the world has a half turn about a slanted axis that would be a turn about z with w written last.
    """
    world = {element.name for element in [*s.spec.worldbody.bodies, *s.spec.worldbody.geoms] if element.name}
    for kind, elements in (("body", s.spec.bodies[1:]), ("geom", s.spec.geoms), ("site", s.spec.sites)):
        for element in elements:
            q = np.asarray(element.quat, dtype=float)
            if not np.isfinite(q).all() or element.alt.type != mujoco.mjtOrientation.mjORIENTATION_QUAT:
                continue
            name, text = f"{kind} {element.name}".strip(), " ".join(f"{v:.6g}" for v in q)
            length = float(np.linalg.norm(q))
            if abs(length - 1) > 1e-2 and not np.isin(np.abs(q), (0, 1)).all():
                yield name, f"quat {text} has length {format_number(length)}"
            elif element.name in world and abs(q[:2]).max() < 1e-6 and abs(q[2:]).min() > 1e-3:
                turn = math.degrees(math.remainder(2 * math.atan2(q[2], q[3]), 2 * math.pi))
                yield name, f"quat {text} is a half turn about a slanted axis; w last it is {turn:.0f}° about z"


def visual_mass(s: Subject) -> Seen:
    """A geom that collides with nothing has mass, on a moving body that takes its inertia from its geoms."""
    low, high = s.spec.compiler.inertiagrouprange
    for body in s.spec.bodies[1:]:
        geoms = list(body.geoms)
        if body.explicitinertial or s.model.body_treeid[body.id] < 0 or not any(collides(s.model, g.id) for g in geoms):
            continue
        for geom in geoms:
            given = geom.mass if math.isfinite(geom.mass) else geom.density
            if not collides(s.model, geom.id) and given > 0 and low <= s.model.geom_group[geom.id] <= high:
                yield s.called("geom", geom.id), "collides with nothing and has mass"


def keyframes(s: Subject) -> Seen:
    """A keyframe in the file gives some of the model's positions; the rest is filled from the defaults."""
    given = {name: count for name, count in s.given.items() if 0 < count < s.model.nq}
    return ((f"key {name}", f"qpos gives {count} of {s.model.nq} numbers") for name, count in given.items())


RULES: tuple[Rule, ...] = (
    still, ranges, unused_ranges, start_outside, gains, weak_servos, undamped, masses, lengths, gravity, switches,
    time_steps, time_constants, lonely, priorities, quaternions, visual_mass, keyframes,
)  # fmt: skip


def look(s: Subject) -> StepResult:
    """Applies every rule to the compiled model."""
    m = s.model
    sizes = [counted(m.nbody - 1, "body", "bodies"), counted(m.njnt, "joint"), counted(m.nu, "actuator")]
    return f"{', '.join(sizes)}, timestep {format_number(1e3 * m.opt.timestep, 'ms')}", apply(RULES, s)


def apply(rules: tuple[Rule, ...], s: Subject) -> list[Finding]:
    """What the rules find, each thing once."""
    return [Finding(rule.__name__, *seen) for rule in rules for seen in dict.fromkeys(rule(s))]


def collides(m: mujoco.MjModel, geom: int) -> bool:
    """Whether a geom has contact masks, and contacts are not switched off."""
    on = not m.opt.disableflags & flags("contact", "constraint")
    return on and bool(m.geom_contype[geom] or m.geom_conaffinity[geom])


def _partners(m: mujoco.MjModel, i: int) -> tuple[NDArray[np.intp], NDArray[np.bool_]]:
    """The colliding geoms that can move against geom i, by id, and for each whether the contact masks match."""
    moving = m.body_treeid[m.geom_bodyid] >= 0
    able = ((m.geom_contype != 0) | (m.geom_conaffinity != 0)) & (moving | moving[i])
    others = np.flatnonzero(able & (m.geom_bodyid != m.geom_bodyid[i]))
    match = (m.geom_contype[i] & m.geom_conaffinity[others]) | (m.geom_contype[others] & m.geom_conaffinity[i])
    return others, match != 0


def _outside(value: float, limits: Array) -> bool:
    slack = 0.01 * (limits[1] - limits[0])
    return not limits[0] - slack <= value <= limits[1] + slack


def _pair(limits: Array, unit: str = "") -> str:
    return f"{format_number(limits[0])} to {format_number(limits[1], unit)}"
