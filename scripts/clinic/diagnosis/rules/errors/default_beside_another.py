"""A named default class at the top, beside the main one.

The top of `<default>` is the class `main`, and may not be called otherwise. Every other class belongs inside of it.

Bad:

    <mujoco>
      <default>
        <joint damping="1"/>
      </default>
      <default class="kettle">
        <geom density="500"/>
      </default>
      <worldbody>
        <body pos="0 0 1">
          <joint axis="0 1 0"/>
          <geom class="kettle" type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -   </default>
    -   <default class="kettle">
    +     <default class="kettle">
    -     <geom density="500"/>
    +       <geom density="500"/>
    +     </default>

The number: none; the text compiles with the edit, which puts the class inside.

When it is wrong: what stood apart inherits from the main class now.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, delete, insert, replace
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._message import meant, mends, sentence
from clinic.diagnosis.suspect import Suspect

TITLE = "A default class beside the main one"
FAMILIES = ("will-not-compile",)
LEVEL = "cause"
UNPLANTED = "healthy models have one default at the top, and what is inside of it is used by name"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The named default, put into the one without a name, or into one that is made."""
    said = sentence(model)
    if model.source is None or not said.startswith("top-level default class"):
        return
    tops = [each for each in model.source.root.children if each.tag == "default"]
    for element in meant(model, "default"):
        xml = model.text_of(element)
        home = next((each for each in tops if each.get("class") in ("", "main") and each is not element), None)
        edits: tuple[Edit, ...] = (replace(element, f"<default>{xml}</default>"),)
        edits = (delete(element), insert(home, xml)) if home else edits
        named = [each for each in tops if each.get("class") not in ("", "main") and each.file == element.file]
        if home is None and len(named) > 1:
            inner = "".join(model.text_of(each) for each in named)
            edits = (replace(named[0], f"<default>{inner}</default>"), *(delete(each) for each in named[1:]))
        name = element.get("class")
        yield mends(
            element,
            edits,
            f"{said}. It belongs inside of a <default> without a name.",
            attribute="class",
            now=name,
            value=f"{name}, inside of the main one",
        )
