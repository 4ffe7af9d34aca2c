"""A tendon starts outside of its range.

The limit of a tendon is a constraint: where it is longer than it may be at the start, the first step pulls its ends
together, or throws them apart, as hard as a stiff spring. `range="0 0.0001"` is taken for a rigid rod, and is one of
0.1 mm.

Bad:

    <mujoco>
      <worldbody>
        <site name="hook" pos="0 0 1.2"/>
        <body name="weight" pos="0 0 1">
          <freejoint/>
          <geom type="sphere" size="0.05"/>
          <site name="eye" pos="0 0 0.05"/>
        </body>
      </worldbody>
      <tendon>
        <spatial name="rope" limited="true" range="0 0.0001">
          <site site="hook"/>
          <site site="eye"/>
        </spatial>
      </tendon>
    </mujoco>

Good:

    -     <spatial name="rope" limited="true" range="0 0.0001">
    +     <spatial name="rope" limited="true" range="0 0.16">

The number: how far its length at the start lies outside of the range, as a share of that length or of the range, the
larger of the two; more than 80 %. Where the range begins at ten times the length, that beginning takes the place of
its width. In a model with keyframes it is so in the first of them as well.

When it is wrong: a rope that is to be pulled tight at the start.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.key import start_at
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, rounded

TITLE = "A tendon starts outside of its range"
FAMILIES = ("jumps-at-start", "explodes")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "the limited tendons of the healthy models are those of two hands"

OUTSIDE = 0.8


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each tendon whose start its limit does not allow."""
    of = model.simulation
    keys = range(min(1, of.count("key"))) if of.begin_with.key < 0 else ()  # a model that has keyframes begins with one
    for tendon in range(of.count("tendon")):
        if any(_outside_at(of, tendon, key) <= OUTSIDE for key in keys):
            continue
        if _outside(of, tendon) <= OUTSIDE:
            continue
        (low, high), length = of.row("tendon_range", tendon, 2), of.data("ten_length")[tendon]
        least, most = min(low, 0.98 * length), max(high, 1.02 * length)
        value = f"{rounded(least)} {rounded(1.01 * most)}"
        if low / 1000 <= length <= high / 1000:
            value = f"{low / 1000:g} {high / 1000:g}"  # in m
        probe = Probe(
            "how far a tendon starts outside of its range", "of its length", _outside, (tendon,), dynamic=False
        )
        says = f"It is {length:.3g} long at the start, and its range is {low:g} to {high:g}."
        edits = model.set("tendon", [tendon], "range", value)
        names, now = (of.name("tendon", tendon),), f"{low:g} {high:g}"
        yield Suspect(names, "range", now, value, edits, probe, OUTSIDE, says, "inside of the range")


def _outside(simulation: Simulation, tendon: int) -> float:
    simulation.begin()
    return _beyond(simulation, tendon)


def _outside_at(simulation: Simulation, tendon: int, key: int) -> float:
    start_at(simulation, key)
    return _beyond(simulation, tendon)


def _beyond(simulation: Simulation, tendon: int) -> float:
    """How far a tendon is outside of its range now."""
    if not simulation.model("tendon_limited")[tendon]:
        return 0.0
    (low, high), length = simulation.row("tendon_range", tendon, 2), simulation.data("ten_length")[tendon]
    wide = 0.0 if 0 < 10 * length < low else high - low
    return max(low - length, length - high) / max(abs(length), abs(low) if low > length else 0.0, wide, 1e-9)


def far_outside(simulation: Simulation) -> bool:
    """Whether some tendon begins where its limit does not allow."""
    return any(_outside(simulation, tendon) > OUTSIDE for tendon in range(simulation.count("tendon")))
