"""Which elements are called alike but for their side: `left_knee`, `knee_L`, `FL_hip`, `foot_left` beside `foot`."""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.simulation import Simulation, kept

SIDES = {"l": "r", "fl": "fr", "hl": "hr", "bl": "br", "ml": "mr", "rl": "rr"} | {
    "lf": "rf", "lh": "rh", "lr": "rr", "lb": "rb", "lm": "rm"
}  # fmt: skip
WORDS = (("left", "right"), ("Left", "Right"), ("LEFT", "RIGHT"))
EXCHANGED = {"l": "r", "r": "l", "L": "R", "R": "L"}
TOKEN = re.compile(r"[A-Z](?=[A-Z][a-z])|[A-Z]+(?![a-z])|[A-Z]?[a-z]+")
FIRST_LETTER = re.compile(r"(?<![A-Za-z])[lL](?=[a-z]{3})")  # lfemur beside rfemur
FIRST_FINGER, LITTLE_FINGER, RING_FINGER = (  # beside the first one lf and rf are the little and ring finger
    re.compile(rf"(?<![A-Za-z])(?:{name}|{name.upper()})(?![a-z])") for name in ("ff", "lf", "rf")
)


def right_of(name: str) -> Iterator[str]:
    """What the right twin of a left element may be called; in what is attached, the prefix alone says the side."""
    prefix, slash, rest = name.partition("/")
    if slash:
        yield from (right + slash + rest for right in right_of(prefix))
    for left, right in WORDS:
        if left in name and right in name:  # the left geom of the right foot
            yield right.join(part.replace(right, left) for part in name.split(left))
        if left in name:
            yield name.replace(left, right)
    both = [found for found in TOKEN.finditer(name) if found.group() in EXCHANGED]
    if len({found.group().lower() for found in both}) > 1:  # the right finger of the left hand
        yield "".join(EXCHANGED.get(part, part) for part in re.split(f"({TOKEN.pattern})", name))
    tokens = [found for found in TOKEN.finditer(name) if found.group().lower() in SIDES]
    for found in tokens:
        side = found.group()
        other = SIDES[side.lower()]
        other = other.upper() if side.isupper() else other.title() if side[0].isupper() else other
        yield name[: found.start()] + other + name[found.end() :]
    if (letter := FIRST_LETTER.sub(lambda found: EXCHANGED[found.group()], name)) != name:
        yield letter
    if (bare := re.sub(r"_left(?![a-z])|(?<![a-z])left_", "", name)) != name:
        yield bare


@kept
def sided(simulation: Simulation, kind: str) -> dict[int, tuple[str, int]]:
    """By element of a pair, by their names: its side, and its twin."""
    pairs = by_name(simulation, kind)
    return {left: ("left", right) for left, right in pairs} | {right: ("right", left) for left, right in pairs}


def by_name(simulation: Simulation, kind: str) -> list[tuple[int, int]]:
    """The pairs of a kind, left and right, by their names."""
    names = simulation.names(kind)
    places = {name: index for index, name in enumerate(names) if name}
    made: list[tuple[int, int]] = []
    used: set[int] = set()
    hand = any(FIRST_FINGER.search(name) for name in names)
    for index, name in enumerate(names):
        right = next((places[other] for other in right_of(name) if other in places), None) if name else None
        if FIRST_LETTER.sub("m", name) != name and FIRST_LETTER.sub("m", name) in places:  # lf, rf and mf are fingers
            continue
        if right is not None and hand and RING_FINGER.search(names[right]) and LITTLE_FINGER.search(name):
            continue
        if right is not None and not used & {index, right}:
            made.append((index, right))
            used |= {index, right}
    return made
