"""Triage, step 2: the model as compiled. Each rule names what is unusual about sizes, units and defaults.

A rule's docstring states its threshold in one sentence; the triage page lists them.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator

import mujoco
import numpy as np

from clinic.triage_run import Array, Subject
from clinic.triage_text import shown
from clinic.triage_watch import Trial

Seen = Iterator[tuple[str, str]]
Rule = Callable[[Subject], Seen]
HINGE, SLIDE, BALL, FREE = (
    mujoco.mjtJoint.mjJNT_HINGE,
    mujoco.mjtJoint.mjJNT_SLIDE,
    mujoco.mjtJoint.mjJNT_BALL,
    mujoco.mjtJoint.mjJNT_FREE,
)
DENSE = 300
"""Degrees of freedom up to which eigenvalues are computed."""
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
        elif _kp(m, i) == 1:
            yield s.called("actuator", i), "kp is 1, the default"


def weak_servos(s: Subject) -> Seen:
    """Gravity at the start pulls a position servo more than 0.2 rad or 0.05 m off its target (load/kp)."""
    for i, dof, stiffness in _servos(s):
        hinge = s.model.jnt_type[s.model.dof_jntid[dof]] == HINGE
        sag = abs(s.data.qfrc_bias[dof] - s.data.qfrc_gravcomp[dof]) / stiffness
        if sag > (0.2 if hinge else 0.05):
            load = shown(abs(s.data.qfrc_bias[dof]), "N m" if hinge else "N")
            yield s.called("actuator", i), f"carries {load} with {shown(stiffness, 'N m/rad' if hinge else 'N/m')}"


def undamped(s: Subject) -> Seen:
    """A position servo or a spring acts on a joint with a damping ratio below 0.02."""
    m, inertia = s.model, _inertia(s)
    stiffness, damping = np.array(m.jnt_stiffness[m.dof_jntid]).astype(float), np.array(m.dof_damping).astype(float)
    springs = {int(dof) for dof in np.flatnonzero(stiffness)}
    servos = {}
    for i, dof, k in _servos(s):
        stiffness[dof] += k
        damping[dof] -= m.actuator_biasprm[i, 2] * m.actuator_gear[i, 0] ** 2
        servos[dof] = i
    for dof in sorted(springs | servos.keys()):
        if inertia[dof] > 0 and stiffness[dof] > 0:
            ratio = damping[dof] / (2 * math.sqrt(stiffness[dof] * inertia[dof]))
            if ratio < 0.02:
                kind, element = ("actuator", servos[dof]) if dof in servos else ("joint", int(m.dof_jntid[dof]))
                yield s.called(kind, element), f"damping ratio {shown(ratio, '')}: nothing ends its oscillation"


def masses(s: Subject) -> Seen:
    """A moving body is 10,000 times lighter than the heaviest, weighs over 10 t, or has inertia below 1e-9 kg m²."""
    m = s.model
    moving = np.flatnonzero(m.body_treeid >= 0)
    heaviest = max((m.body_mass[b] for b in moving), default=0.0)
    for b in moving:
        if m.body_mass[b] > 1e4:
            yield s.called("body", b), f"mass {shown(m.body_mass[b], 'kg')}"
        elif 0 < m.body_mass[b] < 1e-4 * heaviest:
            yield s.called("body", b), f"mass {shown(m.body_mass[b], 'kg')} beside {shown(heaviest, 'kg')}"
        elif m.body_mass[b] > 0 and m.body_inertia[b].max() < 1e-9:
            yield s.called("body", b), f"inertia {shown(m.body_inertia[b].max(), 'kg m²')}"


def lengths(s: Subject) -> Seen:
    """The whole scene measures less than 10 mm or more than 1 km, as scenes in a wrong unit do."""
    extent = float(s.model.stat.extent)
    if s.model.ngeom and (extent < 0.01 or extent > 1000):
        yield "scene", f"extent {shown(extent, 'm')}"


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
    """The timestep is not positive, or above half the longest stable step of the springs and servos, 2/omega_max."""
    h = s.model.opt.timestep
    if h <= 0:
        yield "option", f"timestep {shown(h, 's')}: time does not go on"
        return
    name = mujoco.mjtIntegrator(s.model.opt.integrator).name
    omega = omega_max(s)
    if name in LIMITS and omega * h > LIMITS[name] / 2:
        longest = LIMITS[name] / omega
        yield (
            "option",
            f"timestep {shown(1e3 * h, 'ms')}; springs and servos are stable to {shown(1e3 * longest, 'ms')}",
        )


def time_constants(s: Subject) -> Seen:
    """A geom's contact time constant, solref[0], is shorter than two timesteps."""
    h = s.model.opt.timestep
    for i in range(s.model.ngeom):
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
    able = [i for i in range(m.ngeom) if m.geom_contype[i] or m.geom_conaffinity[i]]
    named = set(map(int, [*m.pair_geom1, *m.pair_geom2]))
    for i in able:
        others = [j for j in able if m.geom_bodyid[i] != m.geom_bodyid[j] and _moves(m, i, j)]
        if others and i not in named and not any(_masks_match(m, i, j) for j in others):
            masks = f"contype {m.geom_contype[i]} conaffinity {m.geom_conaffinity[i]}"
            yield s.called("geom", i), f"{masks}: collides with none of {len(others)} geoms"


def priorities(s: Subject) -> Seen:
    """Geoms of unequal priority can meet, and the one that decides has less than half the other's friction."""
    m = s.model
    high = [i for i in range(m.ngeom) if m.geom_priority[i] > m.geom_priority.min()]
    for i in high:
        for j in range(m.ngeom):
            lower = m.geom_priority[j] < m.geom_priority[i]
            weaker = m.geom_friction[i, 0] < 0.5 * m.geom_friction[j, 0]
            if lower and weaker and m.geom_bodyid[i] != m.geom_bodyid[j] and _moves(m, i, j) and _masks_match(m, i, j):
                mine, yours = shown(m.geom_friction[i, 0], ""), shown(m.geom_friction[j, 0], "")
                yield (
                    s.called("geom", i),
                    f"priority {m.geom_priority[i]} sets friction {mine} against {s.called('geom', j)} with {yours}",
                )
                break


def frictions(s: Subject) -> Seen:
    """A colliding geom's sliding friction is below 0.05 or above 5."""
    m = s.model
    for i in range(m.ngeom):
        mu = m.geom_friction[i, 0]
        if (m.geom_contype[i] or m.geom_conaffinity[i]) and not 0.05 <= mu <= 5:
            yield s.called("geom", i), f"friction {shown(mu, '')}"


def quaternions(s: Subject) -> Seen:
    """A quaternion in the file is not of unit length, or is a half turn that would be a plain yaw with w written last."""
    for kind, elements in (("body", s.spec.bodies), ("geom", s.spec.geoms), ("site", s.spec.sites)):
        for element in elements:
            q = np.asarray(element.quat, dtype=float)
            if not np.isfinite(q).all() or element.alt.type != mujoco.mjtOrientation.mjORIENTATION_QUAT:
                continue
            name, text = f"{kind} {element.name}".strip(), " ".join(f"{v:.6g}" for v in q)
            if abs(np.linalg.norm(q) - 1) > 1e-2:
                yield name, f"quat {text} has length {shown(float(np.linalg.norm(q)), '')}"
            elif abs(q[0]) < 1e-6 and abs(q[1]) < 1e-6 and min(abs(q[2]), abs(q[3])) > 1e-3:
                turn = math.degrees(2 * math.atan2(q[2], q[3]))
                yield name, f"quat {text} is a half turn about a slanted axis; w last it is {turn:.0f}° about z"


def visual_mass(s: Subject) -> Seen:
    """A geom that collides with nothing has mass, on a moving body whose inertia comes from its geoms, some colliding."""
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
    for key in s.spec.keys:
        given = len(key.qpos)
        if 0 < given < s.model.nq:
            yield f"key {key.name}", f"qpos gives {given} of {s.model.nq} numbers"


RULES: tuple[Rule, ...] = (
    ranges, unused_ranges, start_outside, gains, weak_servos, undamped, masses, lengths, gravity, switches, time_steps,
    time_constants, lonely, priorities, frictions, quaternions, visual_mass, keyframes,
)  # fmt: skip


def look(trial: Trial) -> tuple[str, list[tuple[str, str, str]]]:
    """Applies every rule to the compiled model."""
    s, m = trial.subject, trial.subject.model
    found = [(rule.__name__, element, text) for rule in RULES for element, text in rule(s)]
    return (
        f"{m.nbody - 1} bodies, {m.njnt} joints, {m.nu} actuators, timestep {shown(1e3 * m.opt.timestep, 'ms')}",
        found,
    )


def line_of(message: str) -> int:
    """The line that a message of MuJoCo's names, or 1."""
    match = re.search(r"line(?: number)?[ =](\d+)", message, re.IGNORECASE)
    return max(1, int(match[1])) if match else 1


def omega_max(s: Subject) -> float:
    """The highest natural frequency of the springs and servos at the start, in rad/s; 0 without any."""
    m = s.model
    if not 0 < m.nv <= DENSE:
        return 0.0
    stiffness = np.diag(m.jnt_stiffness[m.dof_jntid].astype(float))
    for _, row, k in _rows(s):
        stiffness += k * np.outer(row, row)
    if not stiffness.any():
        return 0.0
    inertia = np.zeros((m.nv, m.nv))
    mujoco.mj_fullM(m, s.data, inertia)
    with np.errstate(all="ignore"):
        squares = np.linalg.eigvals(np.linalg.solve(inertia, stiffness)).real
    return math.sqrt(max(0.0, float(squares.max()))) if np.isfinite(squares).all() else 0.0


def _kp(m: mujoco.MjModel, i: int) -> float:
    """The stiffness of an actuator that is a position servo, else 0."""
    affine = m.actuator_biastype[i] == mujoco.mjtBias.mjBIAS_AFFINE
    return float(-m.actuator_biasprm[i, 1]) if affine and m.actuator_outnum[i] == 1 else 0.0


def _rows(s: Subject) -> Iterator[tuple[int, Array, float]]:
    """Every position servo with its moment arms, shape (nv,), and its stiffness."""
    for i in range(s.model.nu):
        if (kp := _kp(s.model, i)) > 0:
            out = s.model.actuator_outadr[i]
            begin, count = s.data.moment_rowadr[out], s.data.moment_rownnz[out]
            row = np.zeros(s.model.nv)
            row[s.data.moment_colind[begin : begin + count]] = s.data.actuator_moment[begin : begin + count]
            yield i, row, kp


def _servos(s: Subject) -> Iterator[tuple[int, int, float]]:
    """Every position servo that acts on one hinge or slide: actuator, degree of freedom, stiffness at it."""
    for i, row, kp in _rows(s):
        dofs = np.flatnonzero(row)
        if len(dofs) == 1 and s.model.jnt_type[s.model.dof_jntid[dofs[0]]] in (HINGE, SLIDE):
            yield i, int(dofs[0]), kp * float(row[dofs[0]]) ** 2


def _inertia(s: Subject) -> Array:
    """The diagonal of the inertia matrix at the start, shape (nv,)."""
    m = s.model
    if not 0 < m.nv <= DENSE:
        return np.zeros(m.nv)
    full = np.zeros((m.nv, m.nv))
    mujoco.mj_fullM(m, s.data, full)
    return np.diag(full).copy()


def _moves(m: mujoco.MjModel, i: int, j: int) -> bool:
    """Whether two geoms can move against each other."""
    return bool(m.body_treeid[m.geom_bodyid[i]] >= 0 or m.body_treeid[m.geom_bodyid[j]] >= 0)


def _masks_match(m: mujoco.MjModel, i: int, j: int) -> bool:
    return bool((m.geom_contype[i] & m.geom_conaffinity[j]) | (m.geom_contype[j] & m.geom_conaffinity[i]))


def _pair(values: object) -> str:
    low, high = np.asarray(values, dtype=float)
    return f"{shown(low, '')} to {shown(high, '')}"
