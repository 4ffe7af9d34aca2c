"""Gravity points the wrong way, or is far too large or too small.

MuJoCo's default is `gravity="0 0 -9.81"`: along -z, in m/s2. A sign, an axis, or millimetres turn up here.

Bad:

    <mujoco>
      <option gravity="0 0 9.81"/>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body name="box" pos="0 0 0.5">
          <freejoint/>
          <geom type="box" size="0.05 0.05 0.05"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -   <option gravity="0 0 9.81"/>
    +   <option gravity="0 0 -9.81"/>

The number: the angle between gravity and the way down to the floor (a plane, or a flat box that stands still; -z where
there is none), at most 45 degrees; and the time in which something falls as far as the model is wide: 0.45 s for 1 m,
told where it is under 0.025 s or over 5 s. A hint tells of more than 15 m/s2 or less than 1, but for 981 and 9810 in a
model in cm or mm, where water has a density of 1 and not of 1,000. What points the wrong way keeps a size that is not
told: 3.71 on Mars.

When it is wrong: a slope or a wall that is made by tilting gravity; a mechanism drawn in the plane of x and y, which is
left alone where all its hinges turn about z. Gravity 0 where free bodies are above a floor is a
hint, for it is often meant, but in a medium as dense as a liquid, in which things swim. So is the flag that switches it
off, where a hinge without motor and spring would swing: its weight turns it, and its damping is below a half of the
critical one.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, set_attribute
from clinic.diagnosis.engine import BOX, GRAVITY_OFF, HINGE, PLANE
from clinic.diagnosis.probes.couplings import couplings
from clinic.diagnosis.probes.matter import matter
from clinic.diagnosis.probes.shape import LIQUID, falling, solid
from clinic.diagnosis.probes.vector import dot
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, counted, how_many

TITLE = "Gravity points the wrong way, or has the wrong size"
FAMILIES = ("falls-through", "drifts", "stuck", "sags")

ANGLE, SHORT, LONG = 45.0, 0.025, 5.0  # degrees, s, s
USUAL = "0 0 -9.81"
EARTH = 1.0, 15.0  # m/s2
QUARTERS = tuple(math.pi / 2 * turn for turn in range(4))
SLIGHT, RATIO = 0.1, 0.5  # of the load, dry friction; of critical damping
ALONG, FLAT = 0.99, 0.1  # cosine; thickness over width
LIGHT = 50.0  # of water's density as it is in kg and m, that is 1,000


def _up(simulation: Simulation) -> tuple[float, ...]:
    """Away from the floor; where there is none, and nothing but hinges about z, against a gravity across them."""
    simulation.begin()
    ups = list(_planes(simulation)) or list(_slabs(simulation))
    if ups:
        return (0.0, 0.0, 1.0) if any(up[2] > 0.5 for up in ups) else ups[0]
    hinges = [joint for joint in range(simulation.count("joint")) if simulation.joint_type(joint) == HINGE]
    upright = bool(hinges) and all(abs(simulation.data("xaxis")[3 * joint + 2]) > ALONG for joint in hinges)
    x, y, z = simulation.model("opt.gravity")
    size = simulation.gravity
    return (-x / size, -y / size, 0.0) if upright and abs(z) < SLIGHT * size else (0.0, 0.0, 1.0)


def _planes(of: Simulation) -> Iterator[tuple[float, ...]]:
    """The normals of the planes."""
    for geom, kind in enumerate(of.model("geom_type")):
        if int(kind) == PLANE:
            yield tuple(of.data("geom_xmat")[9 * geom + 2 : 9 * geom + 9 : 3])


def _slabs(of: Simulation) -> Iterator[tuple[float, ...]]:
    """The normals of the flat boxes that stand still: up, or against gravity where they are walls."""
    for geom, kind in enumerate(of.model("geom_type")):
        half = of.row("geom_size", geom, 3)
        thin = min(range(3), key=half.__getitem__)
        still = not of.model("body_weldid")[of.body_of("geom", geom)] and solid(of, geom)
        if int(kind) == BOX and still and half[thin] < FLAT * sorted(half)[1]:
            normal = of.data("geom_xmat")[9 * geom + thin : 9 * geom + 9 : 3]
            away = normal[2] if abs(normal[2]) > 0.5 else -dot(normal, of.model("opt.gravity"))
            yield tuple(each if away > 0 else -each for each in normal)


def _angle(simulation: Simulation) -> float:
    g, size, up = simulation.model("opt.gravity"), simulation.gravity, _up(simulation)
    return math.degrees(math.acos(max(-1.0, min(1.0, -dot(g, up) / size)))) if size else 0.0


def _ratio(simulation: Simulation) -> float:
    size = simulation.gravity
    time = math.sqrt(2 * simulation.extent / size) if size else 0.0
    return max(time / LONG, SHORT / time) if time else 0.0


def _pull(simulation: Simulation) -> float:
    """By how much gravity is more or less than the earth's, as a share of it."""
    return abs(simulation.gravity / 9.81 - 1)


def _metres(of: Simulation, size: float) -> bool:
    """Whether lengths are in m: gravity is not that in cm or mm, or water would be one as heavy as in kg and m."""
    if not any(abs(size / each - 1) < 0.02 for each in (981, 9810)):
        return True
    heaviest = matter(of, max(of.moving_bodies, key=lambda body: of.model("body_mass")[body]))
    return heaviest is not None and heaviest.density > LIGHT


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Gravity's direction, its size beside the model's, and its absence."""
    simulation = model.simulation
    g, falls = simulation.row("opt.gravity", 0, 3), bool(simulation.count("dof"))
    off = bool(int(simulation.model("opt.disableflags")[0]) & GRAVITY_OFF)
    now = " ".join(f"{each:g}" for each in g)
    name = ("gravity",)
    if not falls:
        return
    if not any(g) or off:
        yield from _none(model, now, off)
        return
    up, size = _up(simulation), simulation.gravity
    kept = size if EARTH[0] < size < EARTH[1] or not _metres(simulation, size) else 9.81
    value = " ".join(f"{-kept * each + 0.0:.4g}" for each in up).replace("-0 ", "0 ")
    edits = model.option("gravity", value)
    angle = Probe("angle between gravity and down", "degrees", _angle, dynamic=False)
    says = f"Gravity is {now} m/s2."
    yield Suspect(name, "gravity", now, value, edits, angle, ANGLE, says, USUAL, share=0.1)
    took = math.sqrt(2 * simulation.extent / size)
    says = f"With {size:.3g} m/s2 a fall of {simulation.extent:.2g} m, the model's extent, takes {took:.2g} s."
    ratio = Probe("time of a fall over the model's extent, beyond 0.025 to 5 s by", "times", _ratio, dynamic=False)
    scaled = " ".join(f"{9.81 * each / size + 0.0:.4g}" for each in g)
    yield Suspect(name, "gravity", now, scaled, model.option("gravity", scaled), ratio, 1.0, says, USUAL)
    if _ratio(simulation) <= 1 and not EARTH[0] < size < EARTH[1] and _metres(simulation, size):
        pull = Probe("share by which gravity differs from that of the earth", "", _pull, dynamic=False)
        says = f"Gravity is {size:.3g} m/s2, {size / 9.81:.2g} times that of the earth."
        edits = model.option("gravity", scaled)
        yield Suspect(name, "gravity", now, scaled, edits, pull, 0.5, says, USUAL, level="hint")


def _none(model: ReaderModel, now: str, off: bool) -> Iterator[Suspect]:
    simulation = model.simulation
    planes = any(int(kind) == PLANE for kind in simulation.model("geom_type"))
    falls = sorted(falling(simulation)) if simulation.model("opt.density")[0] < LIQUID else []
    if model.source is None:
        return
    flags = tuple(set_attribute(each, "gravity", "enable") for each in model.source.elements("flag")) if off else ()
    if not planes or not falls:
        yield from _hanging(simulation, flags)
        return
    edits = flags or model.option("gravity", USUAL)
    names = tuple(simulation.name("body", body) for body in falls)
    probe = counted("free bodies that nothing pulls down", len(names))
    says = "Gravity is switched off." if off else f"Gravity is {now}."
    yield Suspect(
        ("gravity", *names), "gravity", "disable" if off else now, USUAL, edits, probe, 0.0, says, level="hint"
    )


def _hanging(of: Simulation, flags: tuple[Edit, ...]) -> Iterator[Suspect]:
    """The flag, where it leaves pendulums without their weight."""
    if flags and (found := _pendulums(of)):
        names = tuple(of.name("joint", joint) for joint in found)
        says = f"Gravity is switched off, and nothing else moves {names[0]}."
        probe = how_many("hinges that would swing and have no weight", _pendulums)
        yield Suspect(("gravity", *names), "gravity", "disable", "enable", flags, probe, 0, says, USUAL, level="hint")


def _pendulums(of: Simulation) -> list[int]:
    """The hinges without motor, spring and coupling that would swing if gravity were not switched off."""
    flags = int(of.model("opt.disableflags")[0])
    if not flags & GRAVITY_OFF or of.model("opt.density")[0] >= LIQUID or of.count("tendon"):
        return []
    coupled = {joint for _, (*two, _) in couplings(of) for joint in two}
    masses, made = of.mass_diagonal, []
    of.engine.write_model("opt.disableflags", [flags & ~GRAVITY_OFF])
    try:
        for joint in range(of.count("joint")):
            idle = joint not in of.drivers and joint not in coupled and not of.model("jnt_stiffness")[joint]
            if of.joint_type(joint) != HINGE or not idle:
                continue
            load, dof = _load(of, joint), of.dof(joint)
            damping, loss = of.model("dof_damping")[dof], of.model("dof_frictionloss")[dof]
            if load > 0 and loss < SLIGHT * load and damping < RATIO * 2 * math.sqrt(load * masses[dof]):
                made.append(joint)
    finally:
        of.engine.write_model("opt.disableflags", [flags])
    return made


def _load(of: Simulation, joint: int) -> float:
    """The most that gravity turns a hinge with from the start on, in N m; 0 where that is next to nothing."""
    of.begin(forward=False)
    begin, low_high = of.position(joint), of.ranges.get(joint, (-math.inf, math.inf))
    most = 0.0
    for turn in QUARTERS:
        of.begin(forward=False)
        of.put(joint, min(max(begin + turn, low_high[0]), low_high[1]))
        of.engine.write("qvel", [0.0] * of.count("dof"))
        of.engine.forward()
        dof = of.dof(joint)
        most = max(most, abs(of.data("qfrc_bias")[dof] - of.data("qfrc_gravcomp")[dof]))
    weight = of.gravity * of.model("body_subtreemass")[of.body_of("joint", joint)]
    return most if most > weight * of.extent / 1000 else 0.0
