"""An element that this release does not have, or not in this place.

MuJoCo says `Schema violation: unrecognized element`. The name is misspelt, or the element belongs into another section:
sensors below `<sensor>`, actuators below `<actuator>`, joints, geoms and sites into a `<body>`. `<composite>` and the
cable's plugin went with MuJoCo 4.0; a `<flexcomp>` of dimension 1 is a rope.

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

    -       <hinge name="elbow"/>
    +       <joint name="elbow"/>

The number: none; the text compiles with the edit.

When it is wrong: an element that is like no other is taken out, and what it was meant to do is lost. Of a cable only
the length, the count and the place are kept; its bodies have other names.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, delete, insert, replace
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._message import meant, mends, nearest, newer, sentence
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect

TITLE = "An unknown or misplaced element"
FAMILIES = ("will-not-compile",)

RENAMED = {
    "hinge": "joint",
    "slide": "joint",
    "free": "freejoint",
    "collision": "geom",
    "visual": "geom",
    "link": "body",
}
GONE = {"composite": "MuJoCo 4.0 has no <composite>: a <flexcomp> takes its place, a grid of dim 1 to 3."}
HOME = {  # where an element belongs
    "actuator": "motor position velocity intvelocity damper cylinder muscle general adhesion dcmotor",
    "sensor": """touch accelerometer velocimeter gyro force torque magnetometer rangefinder jointpos jointvel framepos
        framequat framelinvel frameangvel framelinacc subtreecom actuatorfrc actuatorpos jointlimitpos clock""",
    "equality": "connect weld",
    "contact": "exclude pair",
    "asset": "mesh texture material hfield",
    "keyframe": "key",
    "tendon": "fixed spatial",
    "visual": "global map quality headlight scale",
    "option": "flag",
    "worldbody": "body geom site camera light",
}
SECTIONS = (
    "option compiler size visual statistic default asset worldbody contact equality tendon actuator sensor keyframe"
)
KNOWN = "body joint freejoint geom site camera light inertial frame include flag global map quality headlight plugin"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The element under another name, in its own section, or gone."""
    if not re.match(r"(?:Schema violation: )?unrecognized element", sentence(model)):
        return
    for element in meant(model):
        if (hint := newer(model, element)) is not None:
            yield hint
            return
        *tries, gone = _tries(model, element)
        for edits, value in [*tries, *_together(model, element), gone]:
            if not _refused(model, edits, element, value):
                says = (
                    f"This MuJoCo knows no <{element.tag}> inside of <{element.parent.tag if element.parent else ''}>."
                )
                says = GONE.get(element.tag, says)
                yield mends(element, edits, says, value=value)
                return


def _refused(model: ReaderModel, edits: tuple[Edit, ...], element: Element, value: str) -> bool:
    """Whether MuJoCo still does not know the element, or what has taken its place."""
    found = re.search(r"unrecognized element\s+Element '(\w+)'", str(model.with_edits(edits)))
    return found is not None and found[1] in (element.tag, value.strip("<>"))


def _together(model: ReaderModel, element: Element) -> Iterator[tuple[tuple[Edit, ...], str]]:
    """The elements of a kind that stand beside each other, moved into their section."""
    alike = [each for each in element.parent.children if each.tag == element.tag] if element.parent else []
    if len(alike) > 1:
        yield from _moved(model, alike)


def _moved(model: ReaderModel, elements: list[Element]) -> Iterator[tuple[tuple[Edit, ...], str]]:
    root, gone = model.source.root if model.source else None, [delete(each) for each in elements]
    text = "\n    ".join(model.text_of(each) for each in elements)
    for section, words in HOME.items():
        if root is not None and elements[0].tag in words.split():
            there = root.first(section)
            added = insert(there, text) if there else insert(root, f"<{section}>{text}</{section}>")
            yield (*gone, added), f"moved into <{section}>"


def _tries(model: ReaderModel, element: Element) -> Iterator[tuple[tuple[Edit, ...], str]]:
    if element.tag == "composite":
        yield from _flexcomp(element)
        return
    text = model.text_of(element)
    known = [*SECTIONS.split(), *KNOWN.split(), *(word for words in HOME.values() for word in words.split())]
    names = [RENAMED[element.tag]] if element.tag in RENAMED else nearest(element.tag, known)
    for name in names:
        renamed = re.sub(rf"^<{element.tag}\b", f"<{name}", text)
        renamed = re.sub(rf"</{element.tag}(\s*)>$", rf"</{name}\1>", renamed)
        yield (replace(element, renamed),), f"<{name}>"
    root = model.source.root if model.source else None
    yield from _moved(model, [element])
    if element.tag in SECTIONS.split() and root is not None and element.parent is not root:
        yield (delete(element), insert(root, text)), "moved below <mujoco>"
    yield (delete(element),), "removed"


def _flexcomp(composite: Element) -> Iterator[tuple[tuple[Edit, ...], str]]:
    """The flexcomp that took the place of composites in MuJoCo 4.0: a rope, a cloth or a solid of as many points."""
    counts = [max(1, int(float(each))) for each in [*composite.get("count", "10").split(), "1", "1"][:3]]
    dim = max(1, sum(count > 1 for count in counts))
    lengths = [float(each) for each in composite.get("size", "0").split()]
    gap = float(composite.get("spacing") or 0) or max(lengths) / max(1, max(counts) - 1) or 0.1
    name = composite.get("prefix").rstrip("_") or composite.get("name") or "rope"
    place = "".join(f' {key}="{composite.get(key)}"' for key in ("pos", "quat") if composite.get(key))
    place = place or (f' pos="{composite.get("offset")}"' if composite.get("offset") else "")
    spaces, numbers = " ".join([f"{gap:g}"] * 3), " ".join(map(str, counts))
    xml = f'<flexcomp name="{name}" type="grid" dim="{dim}" count="{numbers}" spacing="{spaces}"'
    xml += f' radius="{gap / 5:g}"{place}>'
    xml += '<edge equality="true"/></flexcomp>'
    yield (replace(composite, xml),), f'<flexcomp dim="{dim}">'
    yield (delete(composite),), "removed"
