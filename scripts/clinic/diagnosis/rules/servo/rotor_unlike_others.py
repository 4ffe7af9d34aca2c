"""One rotor pushes where another one does, or another way than all others.

A line that was copied keeps the site of the rotor before it, a site keeps the sign of its neighbour, or a gear has its
1 in the place of another axis. The drone turns over as soon as it is to rise.

Bad:

    <mujoco>
      <worldbody>
        <body name="drone" pos="0 0 1">
          <freejoint/>
          <geom type="box" size="0.1 0.1 0.02" mass="0.5"/>
          <site name="rotor1" pos="-0.1 -0.1 0"/>
          <site name="rotor2" pos="-0.1 0.1 0"/>
          <site name="rotor3" pos="0.1 0.1 0"/>
          <site name="rotor4" pos="0.1 -0.1 0"/>
        </body>
      </worldbody>
      <actuator>
        <motor name="one" site="rotor1" gear="0 0 1 0 0 -0.02"/>
        <motor name="two" site="rotor2" gear="0 0 1 0 0 0.02"/>
        <motor name="three" site="rotor3" gear="0 0 1 0 0 -0.02"/>
        <motor name="four" site="rotor3" gear="0 0 1 0 0 0.02"/>
      </actuator>
    </mujoco>

Good:

    -     <motor name="four" site="rotor3" gear="0 0 1 0 0 0.02"/>
    +     <motor name="four" site="rotor4" gear="0 0 1 0 0 0.02"/>

The number: rotors of one drone: of three and more those that push from the place of another one in the same direction,
of four and more the one whose push is more than 45 degrees from that of all others.

When it is wrong: two rotors above each other, or a pusher behind.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.probes.rotors import Rotor, rotors
from clinic.diagnosis.probes.vector import dot, norm, sub, unit
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, how_many

TITLE = "A rotor unlike the others"
FAMILIES = ("drifts", "stuck")
UNPLANTED = "only one of the healthy models flies"

ENOUGH, SAME, ASIDE = 3, 1e-3, 0.7  # rotors, m, cosine


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Rotors in one place, and the one that pushes aside."""
    of = model.simulation
    for body in of.free_bodies:
        found = rotors(of, body)
        for one, other in _together(of, body):
            names, site = tuple(of.name("actuator", each.actuator) for each in (one, other)), _site(of, other)
            says = f"{names[1]} pushes where {names[0]} does."
            probe = how_many("rotors in the place of another one", _together, body)
            attribute = "site" if site == _site(of, one) else "pos"
            free = _unused(of, found) if attribute == "site" else ""
            edits: tuple[Edit, ...] = model.set("actuator", [other.actuator], "site", free) if free else ()
            sites = tuple(of.name("site", _site(of, each)) for each in (one, other))
            names = names if attribute == "site" else (*names, *sites)
            at = None if attribute == "site" else model.element("site", site)
            now = of.names("site")[site] if attribute == "site" else model.value("site", site, "pos") or ""
            yield Suspect(names, attribute, now, free or "a place of its own", edits, probe, 0, says, "none", at=at)
        if (odd := _aside(found)) is not None:
            name = of.name("actuator", odd.actuator)
            usual = next(each for each in found if each is not odd)
            gear = model.value("actuator", usual.actuator, "gear") or ""
            says = f"It pushes another way than the {len(found) - 1} others of the drone."
            probe = Probe("rotors that push another way", "", _count_aside, (body,), dynamic=False)
            now = model.value("actuator", odd.actuator, "gear") or ""
            at = model.element("actuator", odd.actuator)
            yield Suspect((name,), "gear", now, f"like {gear}", (), probe, 0, says, "none", at=at)


def _site(of: Simulation, rotor: Rotor) -> int:
    return int(of.model("actuator_trnid")[2 * rotor.actuator])


def _unused(of: Simulation, found: list[Rotor]) -> str:
    """The one site of the rotors' body that no rotor pushes from and that is called as theirs are; else empty."""
    owners, names = of.model("site_bodyid"), of.names("site")
    used = {_site(of, each) for each in found}
    bodies = {int(owners[site]) for site in used}
    alike = {names[site].rstrip("0123456789")[:2] for site in used}
    idle = (name for site, name in enumerate(names) if site not in used and int(owners[site]) in bodies)
    left = [name for name in idle if name.rstrip("0123456789")[:2] in alike]
    return left[0] if len(left) == 1 else ""


def _together(of: Simulation, body: int) -> list[tuple[Rotor, Rotor]]:
    found = rotors(of, body)
    pairs = combinations(found if len(found) >= ENOUGH else (), 2)
    return [(a, b) for a, b in pairs if norm(sub(a.place, b.place)) < SAME and dot(unit(a.push), unit(b.push)) > ASIDE]


def _aside(found: list[Rotor]) -> Rotor | None:
    """The one whose push is away from all others', which agree; None where there is none."""
    for odd in found if len(found) > ENOUGH else ():
        others = [unit(each.push) for each in found if each is not odd]
        if all(dot(others[0], each) > ASIDE for each in others) and dot(unit(odd.push), others[0]) < ASIDE:
            return odd
    return None


def _count_aside(of: Simulation, body: int) -> float:
    return float(_aside(rotors(of, body)) is not None)
