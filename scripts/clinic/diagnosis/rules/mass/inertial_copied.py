"""Two links that are not the same part have the mass and inertia of one.

It was copied with the link, or the script that wrote the model gave the part of one name to another: the sensor frame
on a mast weighs what the mast does.

Bad:

    <mujoco>
      <worldbody>
        <body name="mast" pos="0 0 1">
          <inertial pos="0.0123 0 0.214" mass="2.9535" diaginertia="0.0514 0.0513 0.00271"/>
          <joint name="turn" axis="0 0 1"/>
          <geom type="capsule" fromto="0 0 0 0 0 0.5" size="0.04"/>
          <body name="camera" pos="0 0 0.55">
            <inertial pos="0.0123 0 0.214" mass="2.9535" diaginertia="0.0514 0.0513 0.00271"/>
            <joint name="tilt" axis="0 1 0"/>
            <geom type="box" size="0.02 0.04 0.02"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

            <body name="camera" pos="0 0 0.55">
    -         <inertial pos="0.0123 0 0.214" mass="2.9535" diaginertia="0.0514 0.0513 0.00271"/>
    +         <inertial pos="0 0 0" mass="0.11" diaginertia="0.00006 0.00002 0.00006"/>

The number: the mass of the links that share mass and principal inertia, to four digits, with one before them that has
another name but for numbers and sides, and whose largest geom differs by more than 2 % in length, width or height: the
parts that the fingers of a hand share agree to 0.7 %. A mass of fewer than four digits is a placeholder, and left
alone, but where a link has the centre too of the one that it hangs on, off its joint, and every other link has an
inertial of its own.

When it is wrong: one part under two names.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.probes.inertia import inertial
from clinic.diagnosis.probes.matter import mass_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect

TITLE = "An inertial copied from another link"
FAMILIES = ("wrong-mass", "drifts", "sags")
AFLOAT = True
UNPLANTED = "which of two links an inertial is of stands nowhere"

SIDE = re.compile(r"left|right|front|rear|back|upper|lower|(?<![a-z])(?:[lrfb]|[fhrblm][lrfhb])(?![a-z])|[\W\d_]+")
DIGITS, OTHERS, SAME = 4, 3, 0.02


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each group of links of one inertial that are not one part, but for its first."""
    of = model.simulation
    if pair := _next_of_kin(model):
        yield _told(model, pair[0], [pair[1]], ", centre")
        return
    groups: dict[tuple[float, ...], list[int]] = {}
    for body in of.moving_bodies:
        element = inertial(model, body)
        if element is not None and _digits(element) >= DIGITS:
            moments = of.row("body_inertia", body, 3)
            key = (of.model("body_mass")[body], *sorted(moments))
            groups.setdefault(tuple(float(f"{number:.4g}") for number in key), []).append(body)
    for bodies in groups.values():
        parts: list[int] = []
        names: dict[str, int] = {}
        for body in bodies:
            parts += [body] * (not any(_one_part(of, body, each) for each in parts))
            names.setdefault(_plain(of.engine.name("body", body)), body)
        copies = [body for body in parts[1:] if body in names.values()]
        if copies:
            yield _told(model, bodies[0], copies)


def _told(model: ReaderModel, body: int, copies: list[int], more: str = "") -> Suspect:
    of = model.simulation
    first, mass = of.name("body", body), of.model("body_mass")[body]
    says = f"Mass{more} and principal inertia are those of {first}, {mass:.4g} kg, to four digits."
    told, at = tuple(of.name("body", each) for each in copies), model.element("body", copies[0])
    healthy, probe = "each link its own", mass_of(*copies)
    return Suspect((*told, first), "inertial", f"{mass:.4g} kg", "its own", (), probe, 0.0, says, healthy, at=at)


def _next_of_kin(model: ReaderModel) -> tuple[int, int] | None:
    """The one link that has mass, centre and inertia of the link that it hangs on, where no others have them alike."""
    of = model.simulation
    groups: dict[tuple[float, ...], list[int]] = {}
    for body in of.moving_bodies:
        if inertial(model, body) is not None:
            fields = (("body_ipos", 3), ("body_inertia", 3), ("body_mass", 1))
            groups.setdefault(tuple(x for name, width in fields for x in of.row(name, body, width)), []).append(body)
    alike = [(key, bodies) for key, bodies in groups.items() if len(bodies) > 1]
    if len(alike) != 1 or len(alike[0][1]) != 2 or len(groups) <= OTHERS:
        return None
    numbers, (above, below) = alike[0]
    hangs, placeholder = of.parent(below) == above, not any(numbers[:3]) or len(set(numbers[3:6])) == 1
    return (above, below) if hangs and not placeholder and not _one_part(of, above, below) else None


def _digits(element: Element) -> int:
    """How many digits the mass is written with, noughts at its ends left out."""
    inner = element.first("mass")
    written = element.get("mass") or (inner.get("value") if inner else "")
    return len(re.sub(r"\D", "", written.lower().partition("e")[0]).strip("0"))


def _plain(name: str) -> str:
    """A name without the numbers and sides in it."""
    return SIDE.sub("", name.lower())


def _one_part(of: Simulation, one: int, other: int) -> bool:
    """Whether two bodies are one part, or one has no geom: their largest geoms are as long, as wide and as high."""
    pairs = zip(_extents(of, one), _extents(of, other), strict=False)
    return all(abs(mine - its) <= SAME * max(mine, its) for mine, its in pairs)


def _extents(of: Simulation, body: int) -> list[float]:
    """The half sizes of a body's largest geom in m, the least first; none without geoms."""
    largest = max(of.geoms_of(body), key=lambda geom: of.model("geom_rbound")[geom], default=None)
    return [] if largest is None else sorted(of.row("geom_aabb", largest, 6)[3:])
