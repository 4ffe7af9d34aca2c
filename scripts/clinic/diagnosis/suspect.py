"""What a rule says: a suspect, the edit that would mend it, and the number that must become well by it."""

from __future__ import annotations

import re
from collections.abc import Callable, Sized
from dataclasses import dataclass
from typing import Literal, TypeVarTuple

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.source import Element

Level = Literal["cause", "hint"]
Of = TypeVarTuple("Of")
EXPONENT = re.compile(r"(?<![\"'\w.])(\d(?:\.\d+)?)e([+-]\d\d+)\b")  # no part of a name or of what is quoted


def rounded(number: float) -> str:
    """A number of two digits, as one writes it into a model: `250`."""
    return f"{float(f'{number:.2g}'):g}"


def spoken(text: str) -> str:
    """A sentence whose numbers have no exponents as Python writes them: `819,000`, `0.00002`, `3 x 10^-9`."""
    return EXPONENT.sub(_written_out, text)


def _written_out(found: re.Match[str]) -> str:
    digits, power = found[1], int(found[2])
    if not -6 <= power < 12:
        return f"{digits} x 10^{power}"
    text = f"{float(found[0]):,.{max(0, len(digits.partition('.')[2]) - power)}f}"
    return text if power > 3 else text.replace(",", "")


@dataclass(frozen=True)
class Probe:
    """A measurement of a compiled model: one number, small where the model is well.

    Probes that are equal are run once for each text; so the arguments of `measure` stand in `of`, hashable.
    """

    title: str  # "fastest joint in 2 s after letting go"
    unit: str
    measure: Callable[..., float]
    of: tuple[object, ...] = ()
    dynamic: bool = True  # needs steps, so that a run that explodes spoils it

    def run(self, simulation: Simulation) -> float:
        """The number; infinity where it is not finite."""
        value = self.measure(simulation, *self.of)
        return value if abs(value) < float("inf") else float("inf")


def probe(
    title: str, unit: str = "", *, dynamic: bool = True
) -> Callable[[Callable[[Simulation, *Of], float]], Callable[[*Of], Probe]]:
    """Makes of a measurement the function that gives its probe, for the arguments that follow the simulation."""

    def made(measure: Callable[[Simulation, *Of], float]) -> Callable[[*Of], Probe]:
        return lambda *of: Probe(
            title, unit, measure, tuple(tuple(a) if isinstance(a, list) else a for a in of), dynamic
        )

    return made


def counted(title: str, count: int) -> Probe:
    """What was counted in the text, which no simulation measures."""
    return Probe(title, "", _counted, (count,), dynamic=False)


def _counted(_: Simulation, count: int) -> float:
    return float(count)


def how_many(title: str, find: Callable[..., Sized], *of: object) -> Probe:
    """The number of what a function of a module finds in a compiled model, with the arguments `of`."""
    return Probe(title, "", _found, (find, *of), dynamic=False)


def _found(simulation: Simulation, find: Callable[..., Sized], *of: object) -> float:
    return float(len(find(simulation, *of)))


@dataclass(frozen=True)
class Suspect:
    """Something in the model that may be the cause of a symptom.

    Attributes:
        elements: What it is about: `joint "wrist"`, ...
        attribute: The XML attribute, as it is written.
        now: Its value in the model.
        value: The value that the edit gives it.
        edits: The change of the text; empty where it has no place, or only intent knows it: then it is a hint.
        probe: What measures the symptom.
        limit: The probe's number above which the model is ill.
        says: One sentence with the numbers that made it a suspect.
        healthy: The range that is well, with its source.
        share: An edit helps when the number falls below `limit` and below this share of what it was.
        excess: How many times the static limit is exceeded; decides between rivals that help equally.
        level: `hint` where intent decides.
        at: Where it stands, for one without edits.
    """

    elements: tuple[str, ...]
    attribute: str
    now: str
    value: str
    edits: tuple[Edit, ...]
    probe: Probe
    limit: float
    says: str
    healthy: str = ""
    share: float = 0.6
    excess: float = 1.0
    level: Level = "cause"
    at: Element | None = None
