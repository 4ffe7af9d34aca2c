"""An equality was copied and not adapted.

Two lines couple the same two joints, and the other hand's are free; or two hold one site, and the one that the second
is called after is held by none; or one end is on the left and the other on the right, where each other line keeps to
its side.

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

The number: couplings of the same two joints; the end that two equalities have in common, where none holds the part that
is called like it but for what sets the names of the two apart, or those of their other ends; and equalities of
different parts of two sides where the part of the same side is there and another equality of its kind keeps to one
side.

When it is wrong: a cross brace.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.copied import Line, misled
from clinic.diagnosis.probes.equalities import CONNECT, COUPLED, WELD, held, kind_of, sited
from clinic.diagnosis.probes.sides import sided
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe, Suspect, how_many

TITLE = "An equality copied and not adapted"
FAMILIES = ("stuck", "drifts", "jumps-at-start")
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
    for (each, end), right in copied_ends(of).items():
        taken, left = (of.name(_kind(of, each), part) for part in (held(of, each)[end], right))
        says = f"Another one holds {taken} as well, and none {left}."
        probe = how_many("ends of equalities that were copied", copied_ends)
        yield _elsewhere(model, each, end, right, probe, 0, says, "each part once")
    for each, (wrong, right) in _across(of).items():
        if not any(one == each for one, _ in copied_ends(of)):
            says = f"It holds parts of both sides together; {of.name(_kind(of, each), right)} is there as well."
            probe = Probe("equalities of parts of both sides", "", _over, (each,), dynamic=False)
            end = held(of, each).index(wrong)
            yield _elsewhere(model, each, end, right, probe, 0.5, says, "each on its side")


def _elsewhere(
    model: ReaderModel, each: int, end: int, right: int, probe: Probe, limit: float, says: str, healthy: str
) -> Suspect:
    """The suspect that gives an equality another part at one end."""
    of, kind = model.simulation, _kind(model.simulation, each)
    wrong = held(of, each)[end]
    now, value, attribute = of.names(kind)[wrong], of.names(kind)[right], f"{kind}{end + 1}"
    edits = model.set("equality", [each], attribute, value)
    names = (of.name("equality", each), of.name(kind, wrong))
    return Suspect(names, attribute, now, value, edits, probe, limit, says, healthy)


def _kind(of: Simulation, each: int) -> str:
    return "joint" if kind_of(of, each) == COUPLED else "site" if sited(of, each) else "body"


@kept
def copied_ends(of: Simulation) -> dict[tuple[int, int], int]:
    """By equality and end: the part that it is called after, where it has that of another equality in its place."""
    alike: dict[tuple[int, str], list[int]] = {}
    for each in range(of.count("equality")):
        if kind_of(of, each) in (CONNECT, WELD, COUPLED) and min(held(of, each)) >= 0:
            alike.setdefault((kind_of(of, each), _kind(of, each)), []).append(each)
    made: dict[tuple[int, int], int] = {}
    for (_, kind), some in alike.items():
        names, used = of.names(kind), {part for each in some for part in held(of, each)}
        free = [name for part, name in enumerate(names) if part not in used]
        for end in (0, 1):
            parts = {each: [names[part] for part in held(of, each)] for each in some}
            lines = {each: Line(part[end], (of.names("equality")[each], part[1 - end])) for each, part in parts.items()}
            found = misled(lines, free)
            if len(found) == 1:  # one driver leads several
                made |= {(each, end): names.index(name) for each, name in found.items()}
    return made


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
