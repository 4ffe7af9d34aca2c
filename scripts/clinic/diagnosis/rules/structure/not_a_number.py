"""A number in the text is `nan`, and MuJoCo takes it.

Exporters write `nan` where they divided by zero. The compiler refuses it in the `size` of a geom. In `pos`, `quat`,
`euler`, `rgba`, `damping` and others it compiles, with a warning, `XML contains a 'NaN'`, that does not say where.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1" quat="1 nan 0 0">
          <freejoint/>
          <geom type="box" size="0.1 0.1 0.1" mass="2"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -     <body pos="0 0 1" quat="1 nan 0 0">
    +     <body pos="0 0 1" quat="1 0 0 0">

The number: how many attributes have `nan` among their numbers. `<custom>` and names are not looked at.

When it is wrong: a number that your own code looks for.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "A number that is none"
FAMILIES = ("wrong-numbers", "explodes", "camera")
UNPLANTED = "the compiler refuses most of what one would plant"

NONE = re.compile(r"[-+]?nan", re.IGNORECASE)
NUMBER = re.compile(r"[-+]?(nan|inf|\d*\.?\d+\.?([eE][-+]?\d+)?)", re.IGNORECASE)
NAMES = {
    "name",
    "class",
    "childclass",
    "joint",
    "body",
    "link",
    "material",
    "mesh",
    "texture",
    "site",
    "geom",
    "tendon",
}
NOT_ZERO = {"xyaxes", "axis", "zaxis", "mass", "size", "fovy"}


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The attributes that have `nan` among their numbers."""
    if model.source is None:
        return
    for element in model.source.root.walk():
        for attribute, value in element.attributes.items():
            words = value.split()
            wrong = [word for word in words if NONE.fullmatch(word)]
            of_model = attribute not in NAMES and element.parent is not None and element.parent.tag != "custom"
            if not wrong or not of_model or not all(NUMBER.fullmatch(word) for word in words):
                continue
            mended = " ".join("0" if NONE.fullmatch(word) else word for word in words)
            name = element.get("name")
            told = f'{element.tag} "{name}"' if name else f"a <{element.tag}>"
            says = f"{wrong[0]} is no number, and MuJoCo compiles it with a warning that does not say where it stands."
            zero = not any(float(word) for word in mended.split())
            edits = () if zero or attribute in NOT_ZERO else (set_attribute(element, attribute, mended),)
            probe = counted("attributes with nan among their numbers", 1)
            yield Suspect((told,), attribute, value, mended, edits, probe, 0, says, "numbers alone", level="hint")
