"""Lines that were copied and half adapted: two name one thing, and the one is called after another that none names."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Line:
    """What a line names, and by what else in it one tells it from its siblings."""

    target: str
    names: tuple[str, ...]


def misled(lines: Mapping[int, Line], free: Sequence[str]) -> dict[int, str]:
    """By line that shares its target with a sibling: the free target of its own names, where there is one alone.

    `knee_R` reads the joint `L_shank`, as `knee_L` does: the names differ in `R` for `L`, so `R_shank` is meant.
    """
    unused = {name.lower(): name for name in free if name}
    made = {}
    for each, line in lines.items():
        siblings = [other for one, other in lines.items() if one != each and other.target == line.target]
        pairs = {pair for other in siblings for pair in zip(other.names, line.names, strict=True)}
        found = {name for pair in pairs for name in _exchanged(line.target.lower(), *pair) if name in unused}
        if len(found) == 1:
            made[each] = unused[found.pop()]
    return made


def _exchanged(target: str, other: str, own: str) -> Iterator[str]:
    """A name with what sets the one apart in place of what sets the other apart, wherever it has that."""
    old, new = _apart(other.lower(), own.lower())
    place = target.find(old) if old and new else -1
    while place >= 0:
        yield target[:place] + new + target[place + len(old) :]
        place = target.find(old, place + 1)


def _apart(one: str, other: str) -> tuple[str, str]:
    """Two names without what both begin and end with."""
    while one and other and one[0] == other[0]:
        one, other = one[1:], other[1:]
    while one and other and one[-1] == other[-1]:
        one, other = one[:-1], other[:-1]
    return one, other
