"""Triage, step 2: the model as compiled. Each rule names what is unusual about sizes, units and defaults.

A rule's docstring states its threshold in one sentence; the triage page lists them.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator

import mujoco
import numpy as np

from clinic.triage.run import Subject
from clinic.triage.stiffness import HINGE, SLIDE, inertia, kp, omega_max, servos
from clinic.triage.text import counted, shown
from clinic.triage.watch import Trial

Seen = Iterator[tuple[str, str]]
Rule = Callable[[Subject], Seen]
BALL = int(mujoco.mjtJoint.mjJNT_BALL)
LIMITS = {"mjINT_EULER": 2.0, "mjINT_IMPLICIT": 2.0, "mjINT_IMPLICITFAST": 2.0, "mjINT_RK4": 2.83}
"""The longest stable step times omega, by integrator."""


def ranges(s: Subject) -> Seen:
    """A hinge's range is narrower than 0.1 rad (5.7°) or wider than 4 turns, as ranges in a wrong unit are."""
    for i in range(s.model.njnt):
        if s.model.jnt_type[i] == HINGE and s.model.jnt_limited[i]:
            low, high = s.model.jnt_range[i]
            if high - low < 0.1 or high - low > 8 * math.pi:
                yield s.called("joint", i), f"range {shown(low, '')} to {shown(high, 'rad')}"


def unused_ranges(s: Subject) -> Seen:
    """A joint or actuator has a range that is not in force, reversed ranges included."""
    m = s.model
    for i in range(m.njnt):
        if m.jnt_range[i].any() and not m.jnt_limited[i] and m.jnt_type[i] in (HINGE, SLIDE, BALL):
            yield s.called("joint", i), f"range {_pair(m.jnt_range[i])} is given and not in force"
    for i in range(m.nu):
        if m.actuator_ctrlrange[i].any() and not m.actuator_ctrllimited[i]:
            yield s.called("actuator", i), f"ctrlrange {_pair(m.actuator_ctrlrange[i])} is given and not in force"


def start_outside(s: Subject) -> Seen:
    """The start lies outside a joint's range, or a control outside its ctrlrange, by more than 1 % of it."""
    m, d = s.model, s.data
    for i in range(m.njnt):
        if m.jnt_limited[i] and m.jnt_type[i] in (HINGE, SLIDE):
            low, high = m.jnt_range[i]
            value, slack = d.qpos[m.jnt_qposadr[i]], 0.01 * (high - low)
            if not low - slack <= value <= high + slack:
                yield s.called("joint", i), f"starts at {shown(value, '')}, outside its range {_pair((low, high))}"
    for i in range(m.nu):
        if m.actuator_ctrllimited[i] and m.actuator_ctrlnum[i] == 1:
            low, high = m.actuator_ctrlrange[i]
            value, slack = d.ctrl[m.actuator_ctrladr[i]], 0.01 * (high - low)
            if not low - slack <= value <= high + slack:
                yield s.called("actuator", i), f"control {shown(value, '')} is clamped to {_pair((low, high))}"


def gains(s: Subject) -> Seen:
    """An actuator's gain or gear is 0, or a position actuator's kp is 1, which is the default."""
    m = s.model
    for i in range(m.nu):
        if m.actuator_gaintype[i] != mujoco.mjtGain.mjGAIN_FIXED:
            continue
        if m.actuator_gainprm[i, 0] == 0:
            yield s.called("actuator", i), "gain 0: no control moves anything"
        elif not m.actuator_gear[i].any():
            yield s.called("actuator", i), "gear 0: no control moves anything"
        elif kp(m, i) == 1:
            yield s.called("actuator", i), "kp is 1, the default"


def weak_servos(s: Subject) -> Seen:
    """Gravity at the start pulls a position servo more than 0.2 rad or 0.05 m off its target (load/kp)."""
    for i, dof, stiffness in servos(s):
        hinge = s.model.jnt_type[s.model.dof_jntid[dof]] == HINGE
        sag = abs(s.data.qfrc_bias[dof] - s.data.qfrc_gravcomp[dof]) / stiffness
        if sag > (0.2 if hinge else 0.05):
            load = shown(abs(s.data.qfrc_bias[dof]), "N m" if hinge else "N")
            yield s.called("actuator", i), f"carries {load} with {shown(stiffness, 'N m/rad' if hinge else 'N/m')}"


def undamped(s: Subject) -> Seen:
    """A position servo or a spring acts on a joint with a damping ratio below 0.02."""
    m, inertias = s.model, inertia(s)
    stiffness, damping = np.array(m.jnt_stiffness[m.dof_jntid]).astype(float), np.array(m.dof_damping).astype(float)
    springs = {int(dof) for dof in np.flatnonzero(stiffness)}
    held = {}
    for i, dof, k in servos(s):
        stiffness[dof] += k
        damping[dof] -= m.actuator_biasprm[i, 2] * m.actuator_gear[i, 0] ** 2
        held[dof] = i
    for dof in sorted(springs | held.keys()):
        if inertias[dof] > 0 and stiffness[dof] > 0:
            ratio = damping[dof] / (2 * math.sqrt(stiffness[dof] * inertias[dof]))
            if ratio < 0.02:
                kind, element = ("actuator", held[dof]) if dof in held else ("joint", int(m.dof_jntid[dof]))
                yield s.called(kind, element), f"damping ratio {shown(ratio, '')}: nothing ends its oscillation"


def masses(s: Subject) -> Seen:
    """A moving body is 10,000 times lighter than the heaviest, weighs over 10 t, or has inertia below 1e-9 kg m²."""
    m = s.model
    moving = [int(b) for b in np.flatnonzero(m.body_treeid >= 0)]
    heaviest = max((m.body_mass[b] for b in moving), default=0.0)
    for b in moving:
        if m.body_mass[b] > 1e4:
            yield s.called("body", b), f"mass {shown(m.body_mass[b], 'kg')}"
        elif 0 < m.body_mass[b] < 1e-4 * heaviest:
            yield s.called("body", b), f"mass {shown(m.body_mass[b], 'kg')} beside {shown(heaviest, 'kg')}"
        elif m.body_mass[b] > 0 and m.body_inertia[b].max() < 1e-9:
            yield s.called("body", b), f"inertia {shown(m.body_inertia[b].max(), 'kg m²')}"


def lengths(s: Subject) -> Seen:
    """All geoms together fit into 10 mm or reach over 1 km, as those of scenes in a wrong unit do; planes left out."""
    bounded = s.model.geom_rbound > 0
    if bounded.any():
        radii = s.model.geom_rbound[bounded, None]
        centres = s.data.geom_xpos[bounded]
        size = float(((centres + radii).max(axis=0) - (centres - radii).min(axis=0)).max())
        if size < 0.01 or size > 1000:
            yield "scene", f"is {shown(size, 'm')} long"


def gravity(s: Subject) -> Seen:
    """Gravity is not between 9 and 10.5 m/s² along −z."""
    g = np.asarray(s.model.opt.gravity)
    if not (9 <= -g[2] <= 10.5 and abs(g[:2]).max() < 0.1):
        yield "option", f"gravity {' '.join(shown(v, '') for v in g)} m/s²"


def switches(s: Subject) -> Seen:
    """A part of the physics is switched off by a flag."""
    names = ("CONSTRAINT", "EQUALITY", "LIMIT", "CONTACT", "SPRING", "DAMPER", "GRAVITY", "ACTUATION", "AUTORESET")
    for name in names:
        if s.model.opt.disableflags & getattr(mujoco.mjtDisableBit, f"mjDSBL_{name}"):
            yield "option", f"{name.lower()} is disabled by a flag"


def time_steps(s: Subject) -> Seen:
    """The timestep is not positive, or above 80 % of the longest that springs and servos allow, 2/omega_max."""
    h = s.model.opt.timestep
    if h <= 0:
        yield "option", f"timestep {shown(h, 's')}: time does not go on"
        return
    name = mujoco.mjtIntegrator(s.model.opt.integrator).name
    omega = omega_max(s)
    if name in LIMITS and omega * h > 0.8 * LIMITS[name]:
        longest = LIMITS[name] / omega
        yield (
            "option",
            f"timestep {shown(1e3 * h, 'ms')}; springs and servos are stable to {shown(1e3 * longest, 'ms')}",
        )


def time_constants(s: Subject) -> Seen:
    """A geom's contact time constant, solref[0], is shorter than two timesteps."""
    h = s.model.opt.timestep
    for i in range(0 if _switched_off(s.model) else s.model.ngeom):
        if 0 < s.model.geom_solref[i, 0] < 2 * h * (1 - 1e-9) and (
            s.model.geom_contype[i] or s.model.geom_conaffinity[i]
        ):
            yield (
                s.called("geom", i),
                f"solref {shown(1e3 * s.model.geom_solref[i, 0], 'ms')}, two steps are {shown(2e3 * h, 'ms')}",
            )


def lonely(s: Subject) -> Seen:
    """A geom has contact masks, and there are moving geoms, but its masks match none that could meet it."""
    m = s.model
    able = [i for i in range(m.ngeom) if (m.geom_contype[i] or m.geom_conaffinity[i]) and not _switched_off(m)]
    named = set(map(int, [*m.pair_geom1, *m.pair_geom2]))
    for i in able:
        others = [j for j in able if m.geom_bodyid[i] != m.geom_bodyid[j] and _moves(m, i, j)]
        if others and i not in named and not any(_masks_match(m, i, j) for j in others):
            masks = f"contype {m.geom_contype[i]} conaffinity {m.geom_conaffinity[i]}"
            yield s.called("geom", i), f"{masks}: collides with no other of {counted(len(others), 'geom')}"


def priorities(s: Subject) -> Seen:
    """Geoms of unequal priority can meet, and the one that decides has less than half the other's friction."""
    m = s.model
    for i in range(m.ngeom):
        others = [
            j
            for j in np.flatnonzero(m.geom_priority < m.geom_priority[i]).tolist()
            if m.geom_bodyid[i] != m.geom_bodyid[j] and _moves(m, i, j) and _masks_match(m, i, j)
        ]
        roughest = max(others, key=lambda j: float(m.geom_friction[j, 0]), default=i)
        mine, yours = float(m.geom_friction[i, 0]), float(m.geom_friction[roughest, 0])
        if mine < 0.5 * yours:
            sets = f"priority {m.geom_priority[i]} sets friction {shown(mine, '')}"
            yield s.called("geom", i), f"{sets} against {shown(yours, '')} of {s.called('geom', roughest)}"


def frictions(s: Subject) -> Seen:
    """A colliding geom's sliding friction is below 0.05 or above 5."""
    m = s.model
    for i in range(m.ngeom):
        mu = m.geom_friction[i, 0]
        if (m.geom_contype[i] or m.geom_conaffinity[i]) and not 0.05 <= mu <= 5:
            yield s.called("geom", i), f"friction {shown(mu, '')}"


def quaternions(s: Subject) -> Seen:
    """A quaternion in the file is not of unit length (0 and ±1 aside), or a body placed in the world has a half turn
    about a slanted axis that would be a turn about z with w written last.
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
                yield name, f"quat {text} has length {shown(length, '')}"
            elif element.name in world and abs(q[:2]).max() < 1e-6 and abs(q[2:]).min() > 1e-3:
                turn = math.degrees(math.remainder(2 * math.atan2(q[2], q[3]), 2 * math.pi))
                yield name, f"quat {text} is a half turn about a slanted axis; w last it is {turn:.0f}° about z"


def visual_mass(s: Subject) -> Seen:
    """A geom that collides with nothing has mass, on a moving body that takes its inertia from its geoms."""
    low, high = s.spec.compiler.inertiagrouprange
    for body in s.spec.bodies[1:]:
        if body.explicitinertial or s.model.body_treeid[body.id] < 0:
            continue
        looks = {g.id: g for g in body.geoms if not (s.model.geom_contype[g.id] or s.model.geom_conaffinity[g.id])}
        if len(looks) < len(body.geoms):
            for i, g in looks.items():
                given = g.mass if math.isfinite(g.mass) else g.density
                if given > 0 and low <= s.model.geom_group[i] <= high:
                    yield s.called("geom", i), "collides with nothing and has mass"


def keyframes(s: Subject) -> Seen:
    """A keyframe in the file gives some of the model's positions; the rest is filled from the defaults."""
    for name, given in s.given.items():
        if 0 < given < s.model.nq:
            yield f"key {name}", f"qpos gives {given} of {s.model.nq} numbers"


RULES: tuple[Rule, ...] = (
    ranges, unused_ranges, start_outside, gains, weak_servos, undamped, masses, lengths, gravity, switches, time_steps,
    time_constants, lonely, priorities, frictions, quaternions, visual_mass, keyframes,
)  # fmt: skip


def look(trial: Trial) -> tuple[str, list[tuple[str, str, str]]]:
    """Applies every rule to the compiled model."""
    s, m = trial.subject, trial.subject.model
    found = [(rule.__name__, element, text) for rule in RULES for element, text in rule(s)]
    sizes = [counted(m.nbody - 1, "body", "bodies"), counted(m.njnt, "joint"), counted(m.nu, "actuator")]
    return f"{', '.join(sizes)}, timestep {shown(1e3 * m.opt.timestep, 'ms')}", found


def line_of(message: str) -> int:
    """The line that a message of MuJoCo's names, or 1."""
    match = re.search(r"Element\b.*\bline (\d+)|Line number=(\d+)", message)
    return max(1, int(match[1] or match[2])) if match else 1


def _moves(m: mujoco.MjModel, i: int, j: int) -> bool:
    """Whether two geoms can move against each other."""
    return bool(m.body_treeid[m.geom_bodyid[i]] >= 0 or m.body_treeid[m.geom_bodyid[j]] >= 0)


def _switched_off(m: mujoco.MjModel) -> bool:
    """Whether contacts are switched off by a flag."""
    flags = mujoco.mjtDisableBit.mjDSBL_CONTACT | mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    return bool(m.opt.disableflags & flags)


def _masks_match(m: mujoco.MjModel, i: int, j: int) -> bool:
    return bool((m.geom_contype[i] & m.geom_conaffinity[j]) | (m.geom_contype[j] & m.geom_conaffinity[i]))


def _pair(values: object) -> str:
    low, high = np.asarray(values, dtype=float)
    return f"{shown(low, '')} to {shown(high, '')}"
