"""An element that this release does not have, or not in this place.

MuJoCo says `Schema violation: unrecognized element`. The name is misspelt, or the element belongs into another section:
sensors below `<sensor>`, actuators below `<actuator>`, joints, geoms and sites into a `<body>`.

Bad:

    <mujoco>
      <worldbody>
        <body name="arm">
          <hinge name="elbow"/>
          <geom name="link" size="0.1"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <body name="arm">
          <joint name="elbow"/>
          <geom name="link" size="0.1"/>
        </body>
      </worldbody>
    </mujoco>

The number: none; the text compiles with the edit.

When it is wrong: an element that is like no other is taken out, and what it was meant to do is lost.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, delete, insert, replace
from clinic.diagnosis.engine import CompileError
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._message import meant, mends, nearest, sentence
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect

TITLE = "An unknown or misplaced element"
FAMILIES = ("will-not-compile",)
SINCE = "0.1"

RENAMED = {
    "hinge": "joint",
    "slide": "joint",
    "free": "freejoint",
    "collision": "geom",
    "visual": "geom",
    "link": "body",
}
HOME = {  # where an element belongs
    "actuator": "motor position velocity intvelocity damper cylinder muscle general adhesion dcmotor",
    "sensor": """touch accelerometer velocimeter gyro force torque magnetometer rangefinder jointpos jointvel framepos
        framequat framelinvel frameangvel framelinacc subtreecom actuatorfrc actuatorpos jointlimitpos clock""",
    "equality": "connect weld",
    "contact": "exclude pair",
    "asset": "mesh texture material hfield",
    "keyframe": "key",
    "tendon": "fixed spatial",
    "worldbody": "body geom site camera light",
}
SECTIONS = (
    "option compiler size visual statistic default asset worldbody contact equality tendon actuator sensor keyframe"
)
KNOWN = "body joint freejoint geom site camera light inertial frame include flag global map quality headlight plugin"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The element under another name, in its own section, or gone."""
    if not re.match(r"(?:Schema violation: )?(?:unrecognized|unknown) element", sentence(model)):
        return
    for element in meant(model):
        for edits, value in _tries(model, element):
            made = model.with_edits(edits)
            if not isinstance(made, CompileError) or "unrecognized element" not in str(made):
                says = (
                    f"This MuJoCo knows no <{element.tag}> inside of <{element.parent.tag if element.parent else ''}>."
                )
                yield mends(element, edits, says, value=value)
                return


def _tries(model: ReaderModel, element: Element) -> Iterator[tuple[tuple[Edit, ...], str]]:
    text = _text(model, element)
    known = [*SECTIONS.split(), *KNOWN.split(), *(word for words in HOME.values() for word in words.split())]
    names = [RENAMED[element.tag]] if element.tag in RENAMED else nearest(element.tag, known)
    for name in names:
        renamed = re.sub(rf"^<{element.tag}\b", f"<{name}", text)
        renamed = re.sub(rf"</{element.tag}(\s*)>$", rf"</{name}\1>", renamed)
        yield (replace(element, renamed),), f"<{name}>"
    root = model.source.root if model.source else None
    for section, words in HOME.items():
        if root is not None and element.tag in words.split():
            there = root.first(section)
            added = insert(there, text) if there else insert(root, f"<{section}>{text}</{section}>")
            yield (delete(element), added), f"moved into <{section}>"
    if element.tag in SECTIONS.split() and root is not None and element.parent is not root:
        yield (delete(element), insert(root, text)), "moved below <mujoco>"
    yield (delete(element),), "removed"


def _text(model: ReaderModel, element: Element) -> str:
    return model.texts[element.file].encode()[element.start : element.end].decode()
