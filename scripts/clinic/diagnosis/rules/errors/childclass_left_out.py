"""A body is without the `childclass` that its parts were written for.

The defaults of a class reach what stands in a body with `childclass`. Without it a `fromto` is of a sphere, or a
geom has no size, and MuJoCo speaks of the geom.

Bad:

    <mujoco>
      <default>
        <default class="arm">
          <geom type="capsule" size="0.03"/>
        </default>
      </default>
      <worldbody>
        <body name="base" pos="0 0 1">
          <joint axis="0 0 1"/>
          <geom fromto="0 0 0 0 0 0.2"/>
          <body name="upper" pos="0 0 0.2">
            <joint axis="0 1 0"/>
            <geom fromto="0 0 0 0 0 0.3"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -     <body name="base" pos="0 0 1">
    +     <body name="base" childclass="arm" pos="0 0 1">

The number: none; the text compiles with the edit. The class is one that no body uses, or that a body beside it has.

When it is wrong: a class that is left over from another part.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._message import meant, mends, sentence
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect

TITLE = "A childclass that is left out"
FAMILIES = ("will-not-compile",)
LEVEL = "cause"
UNPLANTED = "few healthy models have parts that do not compile without their class"

SAID = re.compile(r"fromto requires|size \d+ must be positive")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The bodies around what the message is about, the outermost first, with each class that may have been lost."""
    if model.source is None or not SAID.search(said := sentence(model)):
        return
    for element in meant(model)[:1]:
        bodies = [each for each in element.around() if each.tag == "body"]
        if element.get("class"):
            continue
        parts = [each for body in model.source.elements("worldbody") for each in body.walk()]
        used = {each.get(name) for each in parts for name in ("class", "childclass")}
        reached = any(each.get("childclass") for each in bodies)
        unused = [name for each in model.source.elements("default") if (name := each.get("class")) not in used]
        for body in bodies[::-1]:
            beside = [] if body.get("childclass") else [each.get("childclass") for each in _siblings(body)]
            for name in dict.fromkeys([*filter(None, beside), *([] if reached else filter(None, unused))]):
                says = f"{said}. Its class does not reach it; {name!r} is "
                says += "that of the body beside." if name in beside else "used by no other body."
                edits = (set_attribute(body, "childclass", name),)
                yield mends(body, edits, says, attribute="childclass", now="left out", value=name)


def _siblings(body: Element) -> list[Element]:
    return [each for each in body.parent.children if each.tag == "body" and each is not body] if body.parent else []
