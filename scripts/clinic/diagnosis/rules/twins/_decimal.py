"""A number of one of a pair that is ten, a hundred or a thousand times that of the other, to the digit."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator

from clinic.diagnosis.probes.sides import by_name
from clinic.diagnosis.probes.vector import numbers, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

PLACES = {"body": ("pos",), "geom": ("pos", "size", "fromto"), "site": ("pos",)}
POWERS = (1.0, 2.0, 3.0)
APART, SMALL = 2.0, 1e-6  # times; m


def decimals(model: ReaderModel) -> Iterator[Suspect]:
    """The one of a pair whose number is a power of ten away from its twin's, where it stands alone in the model."""
    of, counts = model.simulation, _counts(model)
    for kind, attributes in PLACES.items() if not model.urdf else ():
        for pair in by_name(of, kind):
            for attribute in attributes:
                values = [numbers(model.value(kind, each, attribute)) for each in pair]
                if (at := _slip(*values)) is None:
                    continue
                often = [counts[abs(value[at])] for value in values]
                odd = min((0, 1), key=lambda i: (often[i], -abs(values[i][at])))
                wrong, right = values[odd], values[1 - odd]
                mended = list(wrong)
                mended[at] = math.copysign(right[at], wrong[at])
                value, other = written(mended), of.name(kind, pair[1 - odd])
                edits = model.set(kind, [pair[odd]], attribute, value)
                says = f"Its {written([wrong[at]])} is {written([right[at]])} in its twin, {other}, to the digit."
                field, name = f"{kind}_{'pos' if attribute == 'pos' else 'size'}", of.name(kind, pair[odd])
                probe = Probe("a number, unlike its twin's by", "times", _times, (field, *pair), dynamic=False)
                yield Suspect((name,), attribute, written(wrong), value, edits, probe, APART, says, "that of its twin")


def _times(of: Simulation, field: str, *pair: int) -> float:
    """How many times one number of two elements is the other's, the most of three."""
    both = zip(*(map(abs, of.row(field, each, 3)) for each in pair), strict=True)
    return max((max(a / b, b / a) for a, b in both if min(a, b) > SMALL), default=1.0)


def _slip(one: list[float], other: list[float]) -> int | None:
    """Which number is a power of ten away, with two digits and more, where all others are the same but for signs."""
    apart = [i for i, (a, b) in enumerate(zip(one, other, strict=False)) if abs(abs(a) - abs(b)) > 1e-9]
    if len(one) != len(other) or len(apart) != 1 or not one[apart[0]] or not other[apart[0]]:
        return None
    a, b = abs(one[apart[0]]), abs(other[apart[0]])
    power = abs(math.log10(a / b))
    digits = f"{a:.9e}".partition("e")[0].replace(".", "").rstrip("0")
    return apart[0] if len(digits) > 1 and any(abs(power - each) < 1e-9 for each in POWERS) else None


def _counts(model: ReaderModel) -> Counter[float]:
    """How often each number is written in the places and sizes of the model."""
    made = Counter[float]()
    for kind, attributes in PLACES.items():
        for index in range(model.simulation.count(kind)):
            for attribute in attributes:
                made.update({abs(each) for each in numbers(model.value(kind, index, attribute))})
    return made
