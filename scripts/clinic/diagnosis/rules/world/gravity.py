"""Gravity points the wrong way, or is a thousand times too large or small.

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

The number: the angle between gravity and the way down to the floor (-z where there is no horizontal plane), at most
45 degrees; and the time in which something falls as far as the model is wide: 0.45 s for 1 m, told where it is under
0.025 s or over 5 s. A hint tells of more than 15 m/s2 or less than 1, but for 981 and 9810 in a model in cm or mm,
where water has a density of 1 and not of 1,000. What points the wrong way keeps a size that is not told: 3.71 on Mars.

When it is wrong: a slope or a wall that is made by tilting gravity. Gravity 0 where free bodies are above a floor is a
hint, for it is often meant, but in a medium as dense as a liquid, in which things swim.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.engine import GRAVITY_OFF, PLANE
from clinic.diagnosis.probes.matter import matter
from clinic.diagnosis.probes.shape import LIQUID, falling
from clinic.diagnosis.probes.vector import dot
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, counted

TITLE = "Gravity points the wrong way, or has the wrong size"
FAMILIES = ("falls-through", "drifts", "stuck", "sags")

ANGLE, SHORT, LONG = 45.0, 0.025, 5.0  # degrees, s, s
USUAL = "0 0 -9.81"
EARTH = 1.0, 15.0  # m/s2
LIGHT = 50.0  # of water's density as it is in kg and m, that is 1,000


def _up(simulation: Simulation) -> tuple[float, float, float]:
    simulation.begin()
    matrices, kinds = simulation.data("geom_xmat"), simulation.model("geom_type")
    ups = [
        (m[2], m[5], m[8]) for g, kind in enumerate(kinds) if int(kind) == PLANE for m in [matrices[9 * g : 9 * g + 9]]
    ]
    level = [up for up in ups if up[2] > 0.5]
    return (0.0, 0.0, 1.0) if level or not ups else ups[0]


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
    if not planes or not falls or model.source is None:
        return
    flags = tuple(set_attribute(each, "gravity", "enable") for each in model.source.elements("flag")) if off else ()
    edits = flags or model.option("gravity", USUAL)
    names = tuple(simulation.name("body", body) for body in falls)
    probe = counted("free bodies that nothing pulls down", len(names))
    says = "Gravity is switched off." if off else f"Gravity is {now}."
    yield Suspect(
        ("gravity", *names), "gravity", "disable" if off else now, USUAL, edits, probe, 0.0, says, level="hint"
    )
