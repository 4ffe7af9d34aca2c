"""An element that MuJoCo refuses, and without which it compiles.

What no other rule knows is found by trying: the model without an attribute of which MuJoCo speaks, or without the
element.

Bad:

    <mujoco>
      <worldbody>
        <body name="shelf" sleep="init">
          <geom name="board" type="box" size="0.3 0.1 0.01"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -     <body name="shelf" sleep="init">
    +     <body name="shelf">

The number: none; the text compiles with the edit.

When it is wrong: it says where the fault is, and not what was meant there.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import delete, remove_attribute
from clinic.diagnosis.engine import CompileError
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._message import meant, mends, sentence, told
from clinic.diagnosis.rules.errors._remedy import advised
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect

TITLE = "An element that MuJoCo refuses"
FAMILIES = ("will-not-compile",)
LEVEL = "cause"
UNPLANTED = "what is planted has a rule of its own"

NEEDED = ("mujoco", "robot", "worldbody", "body", "link")  # too much would go with them
MOST = 3  # elements that are tried


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The elements that may be meant, without what the message names, and taken out."""
    said = sentence(model).rstrip(".")
    elements = meant(model)
    words = re.findall(r"\w+", said)
    for element in elements[:MOST]:
        for name in [each for each in element.attributes if each in words and each != "name"]:
            without = (remove_attribute(element, name),)
            says = f"{said}. Without {name} MuJoCo comes further."
            yield mends(element, without, says, attribute=name, now=element.get(name), value="left out")
        if element.tag not in NEEDED and (not element.children or _compiles(model, element)):
            says = f"{said}. Without this <{element.tag}> MuJoCo comes further."
            yield mends(element, (delete(element),), says, value="removed")
    if elements:
        yield advised(elements[0], f"{said}: this is about {told(elements[0])}.")
    elif model.source is not None:
        yield advised(None, f"{said}: MuJoCo does not say where.")


def _compiles(model: ReaderModel, element: Element) -> bool:
    """Whether the model does without an element: what has others inside is not given up for less."""
    return not isinstance(model.with_edits((delete(element),)), CompileError)
