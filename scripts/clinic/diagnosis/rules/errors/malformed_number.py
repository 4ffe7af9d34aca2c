"""A number is not one, or there are too many or too few of them.

MuJoCo wants numbers with spaces between them. `bad format` is a comma, a unit, a missing space (`0.1-0.2`) or a second
point; `has too much data` and `does not have enough data` count the numbers.

Bad:

    <mujoco>
      <worldbody>
        <geom name="box" type="box" size="0.1, 0.1, 0.1"/>
      </worldbody>
    </mujoco>

Good:

    -     <geom name="box" type="box" size="0.1, 0.1, 0.1"/>
    +     <geom name="box" type="box" size="0.1 0.1 0.1"/>

The number: none; the text compiles with the edit.

When it is wrong: where a number is missing, zero is tried in its place, which is seldom what was meant.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, remove_attribute, set_attribute
from clinic.diagnosis.engine import CompileError
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._message import meant, mends, sentence
from clinic.diagnosis.suspect import Suspect

TITLE = "A malformed number"
FAMILIES = ("will-not-compile",)

MESSAGE = re.compile(
    r"(bad format in|problem reading|number is too large in|(?!required|at most).*) ?attribute '(\w+)'(.*)"
)
SPACED = "MuJoCo reads numbers with spaces between them"
LARGE = "The largest number is 1.8e308, and that of a whole number 2147483647"
DECIMAL = re.compile(r"-?\d+(?:[.,]\d+)?")
AXES = {"x": "1 0 0", "y": "0 1 0", "z": "0 0 1"}
UNITS = {"mm": 1e-3, "cm": 1e-2, "g": 1e-3, "ms": 1e-3}
WORD = re.compile(
    r"([-+]?)((?:\d+\.?\d*|\.\d+)?(?:[eE][-+]?\d+)?)\*?(pi)?(?:/(\d+\.?\d*))?(mm|cm|m|kg|g|ms|s|deg|rad)?"
)
ANGLES = ("euler", "axisangle", "range", "ref", "springref", "rpy", "lower", "upper")
NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The attribute that MuJoCo cannot read, with what it may have meant, or else without it."""
    found = MESSAGE.match(sentence(model))
    if not found or "optional suffix" in found.string:
        return
    attribute = found.group(2)
    for element in meant(model):
        now = element.get(attribute)
        if attribute not in element.attributes or "${" in now:
            continue
        says = f'{LARGE if "too large" in found.string else SPACED}: "{sentence(model)}".'
        for value in dict.fromkeys(_guesses(attribute, now, "enough" in found.string, model.angle_unit)):
            edits = (set_attribute(element, attribute, value),)
            if value != now and not _refused(model, edits, attribute):
                yield mends(element, edits, says, attribute=attribute, now=now, value=value)
                break
        else:
            without = (remove_attribute(element, attribute),)
            if not _refused(model, without, attribute):
                yield mends(element, without, says, attribute=attribute, now=now, value="left out")


def _guesses(attribute: str, now: str, short: bool, unit: float) -> Iterator[str]:
    """What may have been meant: the likeliest first; `unit` is as in `_read`."""
    plain = now.replace("\u2212", "-").replace("\u2013", "-")
    words = plain.replace(";", " ").split()
    read = [_read(word, unit if attribute in ANGLES else 0.0) for word in words]
    if None not in read and not all(map(NUMBER.fullmatch, words)):
        yield " ".join(f"{number:.6g}" for number in read)
    if len(words) == 1 and (letter := words[0].lower().lstrip("+-")) in AXES:
        yield AXES[letter].replace("1", "-1" if words[0][0] == "-" else "1")
    if re.fullmatch(r"0x[0-9a-fA-F]+", plain):
        yield str(int(plain, 16))
    numbers = NUMBER.findall(plain)
    if not numbers:
        return
    yield from _in_place(attribute, words)
    if short:
        yield from _filled(attribute, numbers)
    if all(DECIMAL.fullmatch(word) for word in words) and any(word.lstrip("-").startswith("0,") for word in words):
        yield plain.replace(",", ".")
    yield " ".join(numbers)
    yield re.sub(r"(?<=\d),(?=\d)", ".", plain)
    if all(math.isfinite(float(number)) for number in numbers):
        yield " ".join(str(round(float(number))) for number in numbers)
    yield from (" ".join(numbers[:count]) for count in range(len(numbers) - 1, 0, -1))
    yield from (" ".join([*numbers, *["0"] * more]) for more in (1, 2, 3))


def _in_place(attribute: str, words: list[str]) -> Iterator[str]:
    """Words without a digit among numbers: zero in their place, or one where an axis has no other length."""
    plain = [word for word in words if re.search(r"\d", word)]
    if len(plain) < len(words):
        zero = "1" if attribute in ("axis", "xyz", "zaxis") and not any(map(_size, plain)) else "0"
        yield " ".join(word if word in plain else zero for word in words)


def _size(word: str) -> float:
    return float(word) if NUMBER.fullmatch(word) else 0.0


def _read(word: str, unit: float) -> float | None:
    """A number, one with a unit or a divisor, or a part of pi: `10cm`, `0.13/2`, `-pi/2`.

    `unit` is that of the text's angles in rad, 0 where the number is no angle.
    """
    found = WORD.fullmatch(word)
    if not found or not (found[2] or found[3]):
        return None
    value = float(found[2] or 1) * (math.pi if found[3] else 1.0) / float(found[4] or 1)
    if 0 < unit < 1 and (found[3] or found[5] == "rad"):
        value /= unit
    elif unit == 1 and found[5] == "deg":
        value *= math.pi / 180
    return (-value if found[1] == "-" else value) * UNITS.get(found[5] or "", 1.0)


def _filled(attribute: str, numbers: list[str]) -> Iterator[str]:
    """Too few numbers, with those that are mostly meant besides."""
    last, count = numbers[-1], len(numbers)
    if attribute == "scale" and count == 1:
        yield f"{last} {last} {last}"
    elif attribute.endswith("range") and count == 1:
        size = last.lstrip("+-")
        yield f"-{size} {size}"
    elif attribute in ("gravity", "wind") and count == 1:
        yield f"0 0 {last}"
    elif attribute in ("rgba", "rgb1", "rgb2") and count == 3:
        yield " ".join([*numbers, "1"])
    elif attribute == "fromto" and count == 3:
        yield " ".join(["0 0 0", *numbers])
    elif attribute == "relpose" and count == 3:
        yield " ".join([*numbers, "1 0 0 0"])
    elif attribute in ("size", "scale", "springdamper", "diaginertia"):
        yield from (" ".join([*numbers, *[last] * more]) for more in (1, 2, 3))


def _refused(model: ReaderModel, edits: tuple[Edit, ...], attribute: str) -> bool:
    """Whether MuJoCo still says something about this attribute in the same place."""
    made = model.with_edits(edits)
    place = model.error.strip().rpartition("\n")[2]
    return isinstance(made, CompileError) and f"'{attribute}'" in str(made) and place in str(made)
