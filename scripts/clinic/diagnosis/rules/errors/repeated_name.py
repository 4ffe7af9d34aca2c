"""Two elements of a kind have the same name.

Names are unique among all bodies, all geoms, all joints, also of included files. A part that is included or copied
twice brings its names twice.

Bad:

    <mujoco>
      <worldbody>
        <geom name="box" type="box" size="0.1 0.1 0.1"/>
        <geom name="box" type="box" size="0.1 0.1 0.1" pos="1 0 0"/>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <geom name="box" type="box" size="0.1 0.1 0.1"/>
        <geom name="box_2" type="box" size="0.1 0.1 0.1" pos="1 0 0"/>
      </worldbody>
    </mujoco>

The number: none; the text compiles with the edit.

When it is wrong: what refers to the name now means the first of both.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._message import mends, sentence
from clinic.diagnosis.suspect import Suspect

TITLE = "A name that is used twice"
FAMILIES = ("will-not-compile",)
SINCE = "0.1"

MESSAGE = re.compile(r".*repeated (?:default )?(?:name|class name)(?: '([^']+)')?(?: in (\w+))?")
KINDS = {"joint": ("joint", "freejoint"), "key": ("key",)}


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Every second use of a name, with a number behind it."""
    found = MESSAGE.match(sentence(model))
    if not found or model.source is None:
        return
    kind = found.group(2) or ""
    tags = KINDS.get(kind, (kind,))
    every = list(model.source.elements(*tags)) if kind else []
    if not any(each.get("name") == found.group(1) for each in every):
        every = [each for each in model.source.root.walk() if each.get("name") == found.group(1)]
    used, edits, first = Counter[str](), [], None
    taken = {each.get("name") for each in every}
    for element in every:
        name = element.get("name")
        if name and used[name]:
            number = next(n for n in range(used[name] + 1, 10_000) if f"{name}_{n}" not in taken)
            edits.append(set_attribute(element, "name", f"{name}_{number}"))
            first = first or element
        used[name] += 1
    if first:
        says = f"{used[first.get('name')]} elements are called {first.get('name')!r}."
        yield mends(first, edits, says, attribute="name", now=first.get("name"), value=edits[0].value)
