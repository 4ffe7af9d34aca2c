"""A drawer, or another slide that nothing drives, leaves what carries it.

Its range is longer than its guide, is in millimetres, or is missing: pulled out, it hangs in the air.

Bad:

    <mujoco>
      <worldbody>
        <body name="cabinet" pos="0 0 0.5">
          <geom type="box" size="0.2 0.2 0.01" pos="0 0 -0.1"/>
          <body name="drawer">
            <joint type="slide" axis="1 0 0" range="0 35" damping="5"/>
            <geom type="box" size="0.18 0.18 0.05" mass="1"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -         <joint type="slide" axis="1 0 0" range="0 35" damping="5"/>
    +         <joint type="slide" axis="1 0 0" range="0 0.3" damping="5"/>

The number: the gap, along the slide, between what moves and the body that carries it where the range ends, in lengths
of what moves, told from 0 on; for a slide without a range, and for every one of a URDF below 50 lengths, whether it or
its body is called a drawer, a tray, a shelf, a door or a lid. A slide with a spring is left alone. And, driven or not,
a slide on a straight rail of what carries it, where the range is 20 times as long as the rail and more, and in cm or mm
fits on it.

When it is wrong: a carriage on a rail that is not drawn.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.engine import HFIELD, PLANE, SLIDE
from clinic.diagnosis.probes.shape import boxes
from clinic.diagnosis.probes.vector import dot, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A slide that leaves its guide"
FAMILIES = ("passes-limit", "drifts", "falls-through")
UNPLANTED = "few healthy models have drawers"

MILLIMETRES = 50.0  # of its own length, which no guide has
UNITS, FITS = (("cm", 100), ("mm", 1000)), (0.3, 1.05)  # of the rail's length
BEYOND, SLENDER, ALONG = 20.0, 5.0, 0.01  # times the rail; length over thickness; of an axis
FINGER = re.compile(r"(?i)finger|grip|jaw|claw|hand(?!le)")
GUIDED = re.compile(r"drawer|tray|(?<![a-z])door|shelf|lid(?![a-z])", re.IGNORECASE)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The slides that leave the body which carries them, each, and those that leave their rails."""
    told = list(_from_carrier(model))
    yield from told
    names = {name for each in told for name in each.elements}
    yield from (each for each in _off_its_rail(model) if each.elements[0] not in names)


def _from_carrier(model: ReaderModel) -> Iterator[Suspect]:
    """The slides that nothing drives whose range ends beyond the body which carries them, or has no end."""
    of = model.simulation
    names = of.names("body")
    urdf = model.urdf  # which does not say what drives a joint
    for joint in range(of.count("joint")):
        body = of.body_of("joint", joint)
        if of.joint_type(joint) != SLIDE or not of.parent(body) or joint in of.drivers or len(of.joints_of(body)) > 1:
            continue
        if of.model("jnt_stiffness")[joint] > 0:
            continue
        if of.count("tendon") or _gap(of, joint, at_start=True) > 0:
            continue
        called = f"{names[body]} {of.names('joint')[joint]}"
        if FINGER.search(called):
            continue
        named = bool(GUIDED.search(called))
        if urdf and not named and _gap(of, joint) < MILLIMETRES:
            continue
        if joint not in of.ranges:
            if named:
                says = "It has no range: nothing stops it at either end."
                probe = Probe("1 where no range stops it", "", _unlimited, (joint,), dynamic=False)
                told = (of.name("joint", joint), of.name("body", body))
                yield Suspect(told, "range", "left out", "", (), probe, 0.5, says, "a range within its guide")
        elif (gap := _gap(of, joint)) > 0:
            low, high = of.ranges[joint]
            guide = of.name("body", of.parent(body))
            says = f"Where its range ends it is {gap:.3g} times its own length out of {guide}."
            probe = Probe("gap to what carries it at the end of its range", "lengths", _gap, (joint,), dynamic=False)
            told = (of.name("joint", joint), of.name("body", body))
            value = written([low / 1000, high / 1000]) if gap > MILLIMETRES else ""
            edits = model.set("joint", [joint], "range", value) if value else ()
            healthy = "a range within its guide"
            yield Suspect(told, "range", f"{low:.3g} {high:.3g}", value, edits, probe, 0.0, says, healthy)


def _off_its_rail(model: ReaderModel) -> Iterator[Suspect]:
    """The slides whose ranges are those of their rails in cm or mm."""
    of = model.simulation
    for joint, (low, high) in of.ranges.items():
        if of.joint_type(joint) != SLIDE or (rail := _rail(of, joint)) is None:
            continue
        geom, length = rail
        unit, by = next((each for each in UNITS if FITS[0] < (high - low) / each[1] / length < FITS[1]), ("", 0))
        if high - low > BEYOND * length and by:
            value, now = written([low / by, high / by]), f"{low:g} {high:g}"
            names, edits = (of.name("joint", joint), of.name("geom", geom)), model.set("joint", [joint], "range", value)
            says = f"{names[1]}, on which it slides, is {length:.3g} m long; in {unit} its range fits on it."
            probe = Probe("length of the range over that of the rail", "", _longer, (joint,), dynamic=False)
            yield Suspect(names, "range", now, value, edits, probe, BEYOND, says, "as long as its rail, or less")


def _longer(of: Simulation, joint: int) -> float:
    rail, (low, high) = _rail(of, joint), of.ranges.get(joint, (0.0, 0.0))
    return (high - low) / rail[1] if rail else 0.0


def _rail(of: Simulation, joint: int) -> tuple[int, float] | None:
    """The longest straight geom of what carries a slide, along its axis and through what slides, and its length."""
    of.begin()
    body, axis = of.body_of("joint", joint), of.axis(joint)
    mine, found = boxes(of, of.geoms_of(body)).values(), list[tuple[float, int]]()
    rails = [geom for geom in of.geoms_of(of.parent(body)) if int(of.model("geom_type")[geom]) not in (PLANE, HFIELD)]
    for geom, (middle, half) in boxes(of, rails).items():
        along = dot([abs(x) for x in axis], half)
        thick = max((each for each, x in zip(half, axis, strict=True) if abs(x) < ALONG), default=along)
        through = any(all(abs(at[i] - middle[i]) <= half[i] + size[i] for i in (0, 1, 2)) for at, size in mine)
        if max(map(abs, axis)) > 1 - ALONG and along > SLENDER * thick and through:
            found.append((2 * along, geom))
    return (max(found)[1], max(found)[0]) if found else None


def _unlimited(of: Simulation, joint: int) -> float:
    return float(joint not in of.ranges)


def _gap(of: Simulation, joint: int, *, at_start: bool = False) -> float:
    """How far what slides is from the body that carries it at the worse end of its range, in its own lengths."""
    of.begin()
    body = of.body_of("joint", joint)
    parent = of.parent(body)
    axis, now = of.axis(joint), of.position(joint)
    mine, guide = _extent(of, of.below(body), axis), _extent(of, [parent], axis)
    if mine is None or guide is None:
        return -1.0
    gaps = []
    for end in (now, now) if at_start else of.row("jnt_range", joint, 2):
        low, high = (each + end - now for each in mine)
        gaps.append(max(low - guide[1], guide[0] - high) / max(mine[1] - mine[0], 1e-9))
    return max(gaps)


def _extent(of: Simulation, bodies: list[int], axis: tuple[float, ...]) -> tuple[float, float] | None:
    """From where to where the geoms of bodies reach along a direction."""
    kinds, ends = of.model("geom_type"), list[float]()
    geoms = (geom for body in bodies for geom in of.geoms_of(body) if int(kinds[geom]) not in (PLANE, HFIELD))
    for place, half in boxes(of, geoms).values():
        middle, reach = dot(place, axis), dot([abs(x) for x in axis], half)
        ends += [middle - reach, middle + reach]
    return (min(ends), max(ends)) if ends else None
