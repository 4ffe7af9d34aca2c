"""A value that MuJoCo does not take: a `limited` range reversed, a size or an axis of zero, a word it does not know.

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

    -       <joint name="elbow" type="revolute" axis="0 1 0" damping="1"/>
    +       <joint name="elbow" type="hinge" axis="0 1 0" damping="1"/>

The number: none; the text compiles with the edit.

When it is wrong: in the place of a size of zero a small one is put, in that of an axis of zero 0 0 1: a guess.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, delete, remove_attribute, set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._message import meant, mends, nearest, sentence
from clinic.diagnosis.rules.errors._remedy import remedied
from clinic.diagnosis.rules.errors._scale import scaled_back
from clinic.diagnosis.rules.errors._values import VALUES
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.source import ORIENTATIONS, Element
from clinic.diagnosis.suspect import Suspect

TITLE = "A value that MuJoCo does not take"
FAMILIES = ("will-not-compile",)

WORDS = {"revolute": "hinge", "continuous": "hinge", "rotational": "hinge", "prismatic": "slide", "floating": "free"}
WORDS |= {"cube": "box", "rectangle": "box", "ball": "sphere", "rod": "capsule", "cuboid": "box"}
WORDS |= {"yes": "true", "no": "false", "1": "true", "0": "false", "True": "true", "False": "false", "deg": "degree"}
WORDS |= {"degrees": "degree", "radians": "radian", "rad": "radian", "euler": "Euler", "rk4": "RK4", "newton": "Newton"}
KNOWN = (
    "free ball slide hinge plane hfield sphere capsule ellipsoid cylinder box mesh sdf true false auto degree radian"
)
KNOWN += " gradient checker flat cube skybox 2d spot directional point image affine muscle user none integrator filter"
KNOWN += (
    " filterexact targetbody targetbodycom trackcom narrow bvh sap ellipsoid body xbody site camera edge cross random"
)
KNOWN += " convex exact legacy shell mindist maxforce netforce linear sRGB grid circle square disc direct gmsh cell"
KNOWN += " enable disable Euler RK4 implicit implicitfast discrete pyramidal elliptic PGS CG Newton local fixed track"
URDF_TYPES = "revolute continuous prismatic fixed floating planar"
URDF = {"hinge": ["revolute", "continuous"], "slide": ["prismatic"], "free": ["floating"], "ball": ["floating"]}
SIZES = {  # how many numbers a geom takes
    "sphere": "A sphere has a radius, in m.",
    "capsule": "A capsule has a radius and half a length, or its ends in fromto, in m.",
    "cylinder": "A cylinder has a radius and half a length, or its ends in fromto, in m.",
    "box": "A box has three half-lengths, in m.",
    "ellipsoid": "An ellipsoid has three radii, in m.",
}
ADVICE = {
    r"should be smaller|invalid .*range": "The smaller number comes first.",
    "should be 0": "A ball's range is from 0 to the largest angle.",
    "axis too small": "An axis needs a length; 0 0 1 of its body is put in.",
    "plane size": "size is half the length, half the width (0 for no end) and the distance of the grid's lines, not 0.",
    "fromto": "Both ends are the same point; the second is moved by 0.1 m.",
    "zero quaternion": "1 0 0 0 does not turn.",
    "multiple orientation|at most one of": "One of them can be given; the last is taken off.",
    "both": "One of them is enough.",
    "inheritrange": "It takes the range of the joint or tendon that is driven, for position, intvelocity and pid.",
    "volume is|too small|coplanar|orientation": "A shell has the mass in its surface.",
    "mocap": "A mocap body is a child of the world and has no joint.",
    "global coordinates": "Without it positions are taken as local, which they are not in a model written so.",
    "optional suffix": "Memory is a whole number of bytes with K, M, G: 10M.",
    "data attributes": "The words stand in this order.",
    "negative|positive|must be|should be": "The sign is taken off.",
}
CONTACT = ("found", "force", "torque", "dist", "pos", "normal", "tangent", "linvel", "angvel")
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
            yield mends(element, taken, said, attribute="autolimits", now="false", value="left out")
    if "flex elasticity is no longer integrated" in said:
        edits = model.option("integrator", "discrete")
        for element in model.source.elements("option") if edits else ():
            now = element.get("integrator")
            yield mends(element, edits, f"{said}.", attribute="integrator", now=now, value="discrete")
            return
    if model.urdf and "must be positive" in said and (small := _not_positive(model)):
        element, attribute, now = small[0]
        edits = tuple(set_attribute(each, name, _positive(value)) for each, name, value in small)
        says = f"{said}: <{element.tag}> has {attribute} {now}. Lengths of a URDF are in m; 1 mm stands for zero."
        yield mends(element, edits, says, attribute=attribute, now=now, value=_positive(now))
    if model.urdf and "axis too small" in said:
        for axis in [
            each for each in model.source.elements("axis") if not any(map(float, each.get("xyz", "1").split()))
        ]:
            taken = (set_attribute(axis, "xyz", "1 0 0"),)
            says = f"{said}: an axis needs a length, and 1 0 0 is URDF's default."
            yield mends(axis, taken, says, attribute="xyz", now=axis.get("xyz"), value="1 0 0")
    yield from _of_its_joint(model, said)
    yield from remedied(model, VALUES)
    for element in meant(model):
        by_class = {name: model.source.value(element, name) or "" for name in ("type", "size", "range")}
        for edit, now in _edits(said, element, by_class):
            value = {"set": edit.value, "delete": f"<{element.tag}> removed"}.get(edit.action, "left out")
            says = f"{said.rstrip('.')}. {_advice(said, element, edit, by_class['type'])}".strip()
            yield mends(element, (edit,), says, attribute=edit.attribute, now=now, value=value)


def _of_its_joint(model: ReaderModel, said: str) -> Iterator[Suspect]:
    """The range of the joint that a position servo without a control range drives."""
    assert model.source is not None
    written = [each for each in model.source.section("actuator") if each.attributes]
    lacking = [each for each in written if each.tag == "position" and not each.get("ctrlrange")]
    if "invalid control range" not in said or not lacking:
        return
    compiled = model.with_edits([set_attribute(each, "ctrlrange", "-1 1") for each in lacking])
    for element in [each for each in meant(model) if each in lacking]:
        joint = compiled.driven_joint(written.index(element)) if isinstance(compiled, Simulation) else None
        if joint is not None and isinstance(compiled, Simulation) and joint in compiled.ranges:
            value = " ".join(f"{each:.4g}" for each in compiled.ranges[joint])
            says = f"{said.rstrip('.')}. The range of {compiled.name('joint', joint)}, in rad or m, is put in."
            yield mends(
                element,
                (set_attribute(element, "ctrlrange", value),),
                says,
                attribute="ctrlrange",
                now="left out",
                value=value,
            )


def _advice(said: str, element: Element, edit: Edit, kind: str) -> str:
    """What MuJoCo wants in the place of the value, in a sentence."""
    if edit.action == "delete":
        return "A body without a joint is fixed to its parent; one that moves freely has a <freejoint/>."
    if "keyword" in said and edit.action == "set":
        return f"{edit.attribute} of <{element.tag}> takes {edit.value!r} among others."
    if "keyword" in said:
        return f"{edit.attribute} of <{element.tag}> takes none that is like it; without it the default holds."
    if re.search(r"size \d+ must be positive", said):
        return SIZES.get(kind or "sphere", "")
    if "range" in said and edit.attribute == "limited":
        return "What is limited needs a range."
    return next((says for part, says in ADVICE.items() if re.search(part, said)), "")


def _not_positive(model: ReaderModel) -> list[tuple[Element, str, str]]:
    """The shapes of a URDF with a length of zero or below, of which MuJoCo's message does not say where they are."""
    assert model.source is not None
    shapes = [
        (each, name, value)
        for each in model.source.elements("sphere", "cylinder", "capsule", "box")
        for name, value in each.attributes.items()
    ]
    return [(each, name, value) for each, name, value in shapes if min(map(float, value.split()), default=1) <= 0]


def _positive(value: str) -> str:
    """Lengths without sign, and 1 mm for zero."""
    return " ".join(each.lstrip("-") if float(each) else "0.001" for each in value.split())


def _edits(said: str, element: Element, by_class: dict[str, str]) -> Iterator[tuple[Edit, str]]:
    if "keyword" in said or "data attributes must be in order" in said or "joint type in URDF" in said:
        yield from _words(said, element)
    else:
        yield from _numbers(said, element, by_class)


def _words(said: str, element: Element) -> Iterator[tuple[Edit, str]]:
    """The word that may have been meant, or none."""

    def put(attribute: str, value: str) -> tuple[Edit, str]:
        return set_attribute(element, attribute, value), element.get(attribute, "nothing")

    if found := re.match(r"invalid keyword: '([^']*)'", said):
        wrong = found.group(1)
        if wrong == "fixed" and element.tag == "joint":
            yield delete(element), wrong
            return
        values = [WORDS[wrong]] if wrong in WORDS else nearest(wrong, KNOWN.split())
        if element.tag == "flag":
            off = wrong.lower() in ("false", "0", "off", "no", "none") or wrong.startswith("dis")
            values = ["disable" if off else "enable"]
        for attribute in [name for name, value in element.attributes.items() if value == wrong]:
            yield from (put(attribute, value) for value in values)
            yield remove_attribute(element, attribute), wrong
        if wrong == "(null)":
            words = [word for word in element.get("data").split() if word in CONTACT]
            yield put("data", " ".join(words) or "found")
    elif "data attributes must be in order" in said:
        yield put("data", " ".join(word for word in CONTACT if word in element.get("data").split()))
    elif "joint type in URDF" in said:
        wrong = element.get("type")
        yield from (put("type", value) for value in URDF.get(wrong) or nearest(wrong, URDF_TYPES.split()) or ["fixed"])


def _numbers(said: str, element: Element, by_class: dict[str, str]) -> Iterator[tuple[Edit, str]]:
    """The number that may have been meant, or none; `by_class` has what a default class says, too."""

    def put(attribute: str, value: str) -> tuple[Edit, str]:
        return set_attribute(element, attribute, value), element.get(attribute, "nothing")

    if "plane size" in said:
        given = [*element.get("size").split(), "0", "0"][:2]
        yield put("size", f"{given[0]} {given[1]} 0.1")
    elif "fromto points too close" in said:
        points = [float(number) for number in element.get("fromto").split()]
        yield put("fromto", " ".join(f"{number:g}" for number in [*points[:5], points[2] + 0.1]))
    elif "range[1] in joint" in said and "range" not in element.attributes:
        if "limited" in element.attributes:
            yield remove_attribute(element, "limited"), element.get("limited")
        yield put("limited", "false")  # where a default class says otherwise
    elif "optional suffix" in said:
        yield put("memory", "".join(re.findall(r"^\d+|(?<=\d)[KMGTPE]", element.get("memory").upper())[:2]) or "10M")
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
        yield put("range", f"0 {(by_class['range'] or '0').rsplit(maxsplit=1)[-1]}")
    elif "axis too small" in said:
        yield put("axis", "0 0 1")
    elif re.search(r"size \d+ must be positive", said):
        sizes = [abs(float(number)) or 0.01 for number in (by_class["size"] or "0.01").split()]
        count = int(re.findall(r"size (\d+)", said)[0])
        for length in (max(len(sizes), count + 1), 3):
            yield put("size", " ".join(f"{number:g}" for number in (sizes + sizes[-1:] * 3)[:length]))
    elif "zero quaternion" in said:
        yield put("quat", "1 0 0 0")
    elif "multiple orientation" in said or "at most one of" in said:
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
