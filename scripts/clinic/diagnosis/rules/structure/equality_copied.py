"""An equality was copied for the other side and not adapted.

Two lines couple the same two joints, and the other hand's are free; or one end is on the left and the other on the
right, where each other line keeps to its side.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0.2 1">
          <joint name="left_driver" axis="0 1 0" damping="0.1"/>
          <geom type="capsule" fromto="0 0 0 0.1 0 0" size="0.01"/>
          <body pos="0.11 0 0">
            <joint name="left_follower" axis="0 1 0" damping="0.1"/>
            <geom type="capsule" fromto="0.02 0 0 0.1 0 0" size="0.01"/>
          </body>
        </body>
        <body pos="0 -0.2 1">
          <joint name="right_driver" axis="0 1 0" damping="0.1"/>
          <geom type="capsule" fromto="0 0 0 0.1 0 0" size="0.01"/>
          <body pos="0.11 0 0">
            <joint name="right_follower" axis="0 1 0" damping="0.1"/>
            <geom type="capsule" fromto="0.02 0 0 0.1 0 0" size="0.01"/>
          </body>
        </body>
      </worldbody>
      <equality>
        <joint name="left" joint1="left_follower" joint2="left_driver"/>
        <joint name="right" joint1="right_follower" joint2="left_driver"/>
      </equality>
    </mujoco>

Good:

    -     <joint name="right" joint1="right_follower" joint2="left_driver"/>
    +     <joint name="right" joint1="right_follower" joint2="right_driver"/>

The number: couplings of the same two joints, and equalities of different parts of two sides where the part of the same
side is there and another equality of its kind keeps to one side.

When it is wrong: a cross brace.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.equalities import CONNECT, COUPLED, WELD, held, kind_of, sited
from clinic.diagnosis.probes.sides import sided
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "An equality copied for the other side"
FAMILIES = ("stuck", "drifts", "jumps-at-start")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "few healthy models have equalities on both sides"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Couplings that are there twice, and equalities across the middle."""
    of = model.simulation
    for each, other in _twice(of).items():
        names = (of.name("equality", each), of.name("equality", other))
        kind, (one, two) = "joint", held(of, each)
        says = f"It couples {of.name(kind, one)} and {of.name(kind, two)}, as {names[1]} does."
        probe = Probe("couplings of the same two joints", "", _again, (each,), dynamic=False)
        yield Suspect(names, "joint1", of.names(kind)[one], "another joint", (), probe, 0.5, says, "each once")
    for each, (wrong, right) in _across(of).items():
        kind = _kind(of, each)
        now, value = of.names(kind)[wrong], of.names(kind)[right]
        attribute = f"{kind}{1 if held(of, each)[0] == wrong else 2}"
        edits = model.set("equality", [each], attribute, value)
        says = f"It holds parts of both sides together; {of.name(kind, right)} is there as well."
        probe = Probe("equalities of parts of both sides", "", _over, (each,), dynamic=False)
        names = (of.name("equality", each), of.name(kind, wrong))
        yield Suspect(names, attribute, now, value, edits, probe, 0.5, says, "each on its side")


def _kind(of: Simulation, each: int) -> str:
    return "joint" if kind_of(of, each) == COUPLED else "site" if sited(of, each) else "body"


def _again(of: Simulation, each: int) -> float:
    return float(each in _twice(of))


def _over(of: Simulation, each: int) -> float:
    return float(each in _across(of))


def _twice(of: Simulation) -> dict[int, int]:
    """The couplings of two joints that another one couples as well, with that."""
    seen: dict[frozenset[int], int] = {}
    made = {}
    for each in range(of.count("equality")):
        pair = frozenset(held(of, each))
        if kind_of(of, each) == COUPLED and -1 not in pair and len(pair) > 1 and of.model("eq_active0")[each]:
            if pair in seen:
                made[each] = seen[pair]
            seen.setdefault(pair, each)
    return made


def _across(of: Simulation) -> dict[int, tuple[int, int]]:
    """By equality of different parts of both sides: the end that is on the other side, and the one of its own."""
    sides = {kind: sided(of, kind) for kind in ("body", "site", "joint")}
    kept, crossing = set(), {}
    for each in range(of.count("equality")):
        known = kind_of(of, each) in (CONNECT, WELD, COUPLED) and of.model("eq_active0")[each]
        if not known or min(held(of, each)) < 0:
            continue
        twin, (one, two) = sides[_kind(of, each)], held(of, each)
        if one not in twin or two not in twin or twin[one][1] == two:
            continue
        if twin[one][0] == twin[two][0]:
            kept.add(kind_of(of, each))
        else:
            crossing[each] = (two, twin[two][1])
    if len(crossing) > 1:  # one driver leads both sides
        return {}
    return {each: ends for each, ends in crossing.items() if kind_of(of, each) in kept}
