"""A value that MuJoCo does not take: a reversed range, a size of zero, an axis of zero, a word it does not know.

Bad:

    <mujoco>
      <worldbody>
        <body name="arm" pos="0 0 1">
          <joint name="elbow" type="revolute" axis="0 1 0" damping="1"/>
          <geom name="link" type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <body name="arm" pos="0 0 1">
          <joint name="elbow" type="hinge" axis="0 1 0" damping="1"/>
          <geom name="link" type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
        </body>
      </worldbody>
    </mujoco>

The number: none; the text compiles with the edit.

When it is wrong: a size or axis of zero is replaced by a small one or by the vertical, which is a guess.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, remove_attribute, set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._message import meant, mends, nearest, sentence
from clinic.diagnosis.rules.errors._scale import scaled_back
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect

TITLE = "A value that MuJoCo does not take"
FAMILIES = ("will-not-compile",)
SINCE = "0.1"

WORDS = {"revolute": "hinge", "continuous": "hinge", "rotational": "hinge", "prismatic": "slide", "floating": "free"}
WORDS |= {"cube": "box", "rectangle": "box", "ball": "sphere", "rod": "capsule", "cuboid": "box", "fixed": "hinge"}
WORDS |= {"yes": "true", "no": "false", "1": "true", "0": "false", "True": "true", "False": "false", "deg": "degree"}
WORDS |= {"degrees": "degree", "radians": "radian", "rad": "radian", "euler": "Euler", "rk4": "RK4", "newton": "Newton"}
KNOWN = (
    "free ball slide hinge plane hfield sphere capsule ellipsoid cylinder box mesh sdf true false auto degree radian"
)
KNOWN += " enable disable Euler RK4 implicit implicitfast discrete pyramidal elliptic PGS CG Newton local fixed track"
URDF_TYPES = "revolute continuous prismatic fixed floating planar"
URDF = {"hinge": ["revolute", "continuous"], "slide": ["prismatic"], "free": ["floating"], "ball": ["floating"]}
ORIENTATIONS = ("quat", "axisangle", "xyaxes", "zaxis", "euler")
MINUS = re.compile(r"(?<!\w)-")
RANGE = re.compile(r"(?:\w*range)\[0\] should be smaller than \w+\[1\]|invalid (?:\w+ )?range")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """What the message is about, with the value that was most likely meant."""
    said = sentence(model)
    if "mesh volume is too small" in said and (back := scaled_back(model))[0]:
        for element in meant(model, "mesh")[:1]:
            says = f"{said}. Meshes that are in metres need no scale."
            yield mends(element, back[0], says, attribute="scale", now=back[1], value=back[2])
    if model.source is None:
        return
    for element in model.source.elements("compiler") if "but not `" in said else ():
        if element.get("autolimits") == "false":
            taken = (remove_attribute(element, "autolimits"),)
            yield mends(element, taken, f"{said}.", attribute="autolimits", now="false", value="none")
    if "flex elasticity is no longer integrated" in said:
        edits = model.option("integrator", "discrete")
        for element in model.source.elements("option") if edits else ():
            now = element.get("integrator")
            yield mends(element, edits, f"{said}.", attribute="integrator", now=now, value="discrete")
            return
    if model.source.urdf and "must be positive" in said and (negative := _negative(model)):
        element, attribute, now = negative[0]
        edits = tuple(set_attribute(each, name, MINUS.sub("", value)) for each, name, value in negative)
        yield mends(element, edits, f"{said}.", attribute=attribute, now=now, value=MINUS.sub("", now))
    for element in meant(model):
        for edit, now in _edits(said, element):
            says = f"{said}."
            value = edit.value if edit.action == "set" else "none"
            yield mends(element, (edit,), says, attribute=edit.attribute, now=now, value=value)


def _negative(model: ReaderModel) -> list[tuple[Element, str, str]]:
    """The shapes of a URDF with a negative length, of which MuJoCo's message does not say where they are."""
    assert model.source is not None
    shapes = model.source.elements("sphere", "cylinder", "box")
    return [(each, name, value) for each in shapes for name, value in each.attributes.items() if MINUS.search(value)]


def _edits(said: str, element: Element) -> Iterator[tuple[Edit, str]]:
    def put(attribute: str, value: str) -> tuple[Edit, str]:
        return set_attribute(element, attribute, value), element.get(attribute, "nothing")

    if found := re.match(r"invalid keyword: '([^']*)'", said):
        wrong = found.group(1)
        values = [WORDS[wrong]] if wrong in WORDS else nearest(wrong, KNOWN.split())
        for attribute in [name for name, value in element.attributes.items() if value == wrong]:
            yield from (put(attribute, value) for value in values)
    elif "joint type in URDF" in said:
        wrong = element.get("type")
        yield from (put("type", value) for value in (*URDF.get(wrong, nearest(wrong, URDF_TYPES.split())), "fixed"))
    elif RANGE.search(said):
        for attribute in [name for name in element.attributes if name.endswith("range")]:
            numbers = element.get(attribute).split()
            if len(numbers) == 2 and float(numbers[0]) > float(numbers[1]):
                yield put(attribute, f"{numbers[1]} {numbers[0]}")
            elif len(numbers) == 2 and float(numbers[0]) == float(numbers[1]) != 0:  # a minus was lost
                yield put(attribute, f"-{numbers[0].lstrip('-')} {numbers[0].lstrip('-')}")
    elif "has `range` but not `limited`" in said or "but not `" in said:
        yield put(re.findall(r"but not `(\w+)`", said)[0], "true")
    elif "range[0] should be 0" in said:
        yield put("range", f"0 {element.get('range').split()[-1]}")
    elif "axis too small" in said:
        holder = next((each for each in element.walk() if each.tag == "axis"), None)
        if holder is not None:  # of URDF
            yield set_attribute(holder, "xyz", "0 0 1"), holder.get("xyz", "nothing")
        else:
            yield put("axis", "0 0 1")
    elif re.search(r"size \d+ must be positive", said):
        sizes = [abs(float(number)) or 0.01 for number in element.get("size", "0.01").split()]
        count = int(re.findall(r"size (\d+)", said)[0])
        for length in (max(len(sizes), count + 1), 3):
            yield put("size", " ".join(f"{number:g}" for number in (sizes + sizes[-1:] * 3)[:length]))
    elif "zero quaternion" in said:
        yield put("quat", "1 0 0 0")
    elif "orientation" in said or "at most one of" in said:
        given = [name for name in element.attributes if name in said or name in ORIENTATIONS]
        yield from ((remove_attribute(element, name), element.get(name)) for name in given[::-1])
    elif "both" in said and "defined" in said:
        given = [name for name in element.attributes if re.search(rf"\b{name}\b", said)]
        yield from ((remove_attribute(element, name), element.get(name)) for name in given[::-1])
    elif "inheritrange" in said:
        yield remove_attribute(element, "inheritrange"), element.get("inheritrange")
    elif "global coordinates" in said:
        yield remove_attribute(element, "coordinate"), element.get("coordinate")
    elif re.search(r"mesh volume is too small|orientation|volume is negative|coplanar", said):
        yield put("inertia", "shell")
    elif "not a fixed child of world" in said:
        yield remove_attribute(element, "mocap"), element.get("mocap")
    elif "must be" in said or "should be" in said or "negative" in said or "positive" in said:
        for attribute, now in element.attributes.items():
            if attribute in said and now.startswith("-"):
                yield put(attribute, now[1:])
