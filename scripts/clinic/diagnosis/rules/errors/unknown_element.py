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

    <mujoco>
      <worldbody>
        <body name="arm">
          <joint name="elbow"/>
          <geom name="link" size="0.1"/>
        </body>
      </worldbody>
    </mujoco>

The number: none; the text compiles with the edit.

When it is wrong: an element that is like no other is taken out, and what it was meant to do is lost. Of a cable only
the length, the count and the radius are kept; its bodies have other names.
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


PLUGIN = re.compile(r"plugin (\S+) not found")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The element under another name, in its own section, or gone."""
    if (plugin := PLUGIN.match(sentence(model))) and model.source is not None:
        uses = [each for each in model.source.elements("plugin") if each.get("plugin") == plugin.group(1)]
        if uses:
            gone = (
                "; the cable went with 4.0, and <flexcomp> of dimension 1 is a rope"
                if "cable" in plugin.group(1)
                else ""
            )
            says = f"This MuJoCo has no plugin {plugin.group(1)!r}{gone}."
            yield mends(uses[0], [delete(each) for each in uses], says, attribute="plugin", value="removed")
        return
    if not re.match(r"(?:Schema violation: )?(?:unrecognized|unknown) element(?! ')", sentence(model)):
        return
    for element in meant(model):
        if element.tag == "composite":
            says = "<composite> went with MuJoCo 4.0: <flexcomp> makes ropes (dim 1), cloth (2) and soft bodies (3)."
            yield mends(element, (replace(element, _flexcomp(element)),), says, value="<flexcomp>")
            return
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


def _flexcomp(old: Element) -> str:
    """The flexcomp that is as long, as fine and as thick as a composite."""
    counts = [int(word) for word in old.get("count", "2").split() if word.isdecimal()] or [2]
    geom = old.first("geom")
    length = float((old.get("size") or "1").split()[0])
    spacing = float(old.get("spacing") or length / max(1, counts[0] - 1))
    thick = geom.get("size", "0.005") if geom else "0.005"
    radius = min(float(thick.split()[0]), spacing / 3)
    dim = 1 + sum(count > 1 for count in counts[1:])
    counted = " ".join(map(str, (*counts, 1, 1)[:3]))
    return (
        f'<flexcomp name="{old.get("prefix") or "rope"}" type="grid" dim="{dim}" count="{counted}" '
        f'spacing="{spacing:g} {spacing:g} {spacing:g}" radius="{radius:g}" pos="{old.get("offset") or "0 0 0"}">'
        '<edge equality="true"/><contact selfcollide="none"/></flexcomp>'
    )


def _text(model: ReaderModel, element: Element) -> str:
    return model.texts[element.file].encode()[element.start : element.end].decode()
