"""A number is not one, or there are too many or too few of them.

MuJoCo wants numbers with spaces between them. `bad format` is a comma, a unit, a missing space (`0.1-0.2`) or a second
point; `too much data` and `not enough data` count the numbers.

Bad:

    <mujoco>
      <worldbody>
        <geom name="box" type="box" size="0.1, 0.1, 0.1"/>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <geom name="box" type="box" size="0.1 0.1 0.1"/>
      </worldbody>
    </mujoco>

The number: none; the text compiles with the edit.

When it is wrong: where a number is missing, zero is tried in its place, which is seldom what was meant.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._message import meant, mends, sentence
from clinic.diagnosis.suspect import Suspect

TITLE = "A malformed number"
FAMILIES = ("will-not-compile",)
SINCE = "0.1"

MESSAGE = re.compile(r"(bad format in|problem reading|.*) ?attribute '(\w+)'(.*)")
NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The attribute that MuJoCo cannot read, with what it may have meant."""
    found = MESSAGE.match(sentence(model))
    if not found:
        return
    attribute = found.group(2)
    for element in meant(model):
        now = element.get(attribute)
        numbers = NUMBER.findall(now)
        if not numbers:
            continue
        tries = [" ".join(numbers), re.sub(r"(?<=\d),(?=\d)", ".", now)]
        tries += [" ".join(numbers[:count]) for count in range(len(numbers) - 1, 0, -1)]
        tries += [" ".join([*numbers, *["0"] * more]) for more in (1, 2, 3)]
        for value in dict.fromkeys(tries):
            if value != now and not _refused(model, element, attribute, value):
                edits = (set_attribute(element, attribute, value),)
                says = f'MuJoCo reads numbers with spaces between them: "{sentence(model)}".'
                yield mends(element, edits, says, attribute=attribute, now=now, value=value)
                break


def _refused(model: ReaderModel, element: object, attribute: str, value: str) -> bool:
    """Whether MuJoCo still says something about this attribute."""
    from clinic.diagnosis.engine import CompileError

    made = model.with_edits((set_attribute(element, attribute, value),))  # type: ignore[arg-type]
    return isinstance(made, CompileError) and f"'{attribute}'" in str(made)
