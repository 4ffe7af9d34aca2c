"""An inertia that no body can have.

The three principal moments of a real body satisfy A + B >= C; a full inertia is positive definite; and an inertia is
given once, by `diaginertia` or by `fullinertia`. Values that were rounded, typed or exported wrongly break this, and so
do six of `fullinertia` in the order of URDF: MJCF has the diagonal first, xx yy zz xy xz yz.

Bad:

    <mujoco>
      <worldbody>
        <body name="arm" pos="0 0 1">
          <joint name="elbow" axis="0 1 0" damping="1"/>
          <inertial pos="0.1 0 0" mass="1" diaginertia="0.01 0.01 0.1"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <inertial pos="0.1 0 0" mass="1" diaginertia="0.01 0.01 0.1"/>
    +       <inertial pos="0.1 0 0" mass="1" diaginertia="0.01 0.01 0.01"/>

The number: A + B >= C is checked by MuJoCo. The edit turns the signs of a URDF's products if that alone fits, or takes
off a sign, fills in a zero, or shortens the largest moment until it fits.

When it is wrong: this is a stopgap; the right numbers stand in the CAD model.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import remove_attribute, set_attribute
from clinic.diagnosis.probes.inertia import DIAGONAL, PRODUCTS, fit, possible
from clinic.diagnosis.probes.sides import right_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._message import meant, mends, sentence
from clinic.diagnosis.source import ORIENTATIONS, Element
from clinic.diagnosis.suspect import Suspect

TITLE = "An impossible inertia"
FAMILIES = ("will-not-compile",)

NO_BODY = "Of any body each principal moment is positive, and at most the sum of the other two."
TURNED = "With the other sign of the products they fit: CAD programs differ in it."
ONCE = "fullinertia says how the body is turned, so that nothing else can."
ALIKE = 0.05


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Moments that a body can have, or one of two inertias that is taken off."""
    said = sentence(model)
    if model.source is None or not re.search("A \\+ B|inertia|eigenvalue", said):
        return
    for element in meant(model):
        inertial = element if element.tag == "inertial" else element.first("inertial") or element
        if "mjMINVAL" in said and "-" not in inertial.get("diaginertia").replace("e-", ""):
            continue  # too little of it, which another rule tells
        if model.urdf:
            yield from _in_urdf(inertial, said)
        elif "fullinertia" in inertial.attributes:
            for attribute in ("diaginertia", *ORIENTATIONS):
                if attribute in inertial.attributes:
                    taken = (remove_attribute(inertial, attribute),)
                    now = inertial.get(attribute)
                    yield mends(inertial, taken, f"{said}. {ONCE}", attribute=attribute, now=now, value="left out")
            yield from _put(inertial, "fullinertia", said)
        elif "diaginertia" in inertial.attributes:
            yield from _put(inertial, "diaginertia", said)
        elif "A + B" in said:
            balanced = model.option("balanceinertia", "true", "compiler")
            yield mends(inertial, balanced, f"{said}. {NO_BODY}", attribute="balanceinertia", now="false", value="true")


def _put(inertial: Element, attribute: str, said: str) -> Iterator[Suspect]:
    now = inertial.get(attribute)
    numbers = [float(number) for number in now.split()]
    if len(numbers) == 6:
        xx, xy, xz, yy, yz, zz = numbers
        rows = (xx, yy, zz), (xy, xz, yz)
        if min(rows[0]) > 3 * max(map(abs, rows[1])) and 2 * max(rows[0]) < 1.001 * sum(rows[0]):
            value = " ".join(f"{number:g}" for row in rows for number in row)
            edits = (set_attribute(inertial, attribute, value),)
            says = f"{said}. These six are in the order of URDF: ixx ixy ixz iyy iyz izz."
            yield mends(inertial, edits, says, attribute=attribute, now=now, value=value)
    value = " ".join(f"{number:.4g}" for number in [*possible(numbers[:3]), *[0.0] * (len(numbers) - 3)])
    edits = (set_attribute(inertial, attribute, value),)
    says = f"{said}. {NO_BODY}"
    yield mends(inertial, edits, says, attribute=attribute, now=now, value=value)


def _in_urdf(link: Element, said: str) -> Iterator[Suspect]:
    for inertia in (each for each in link.walk() if each.tag == "inertia"):
        before = [float(inertia.get(name, "0")) for name in DIAGONAL]
        if (odd := _unlike_twin(inertia, before)) is not None:
            name, value, twin = odd
            says = f"{said}. That of its twin, link {twin!r}, has {name} {value}, and the same moments else."
            now, edit = inertia.get(name), set_attribute(inertia, name, value)
            yield mends(inertia, (edit,), says, attribute=name, now=now, value=value)
            continue
        products = [float(inertia.get(name, "0")) for name in PRODUCTS]
        if fit(before, [-each for each in products]) and not fit(before, products):
            turned = [set_attribute(inertia, name, f"{-p:g}") for name, p in zip(PRODUCTS, products, strict=True) if p]
            says = f"{said}. {TURNED}"
            now, value = inertia.get(str(turned[0].attribute)), turned[0].value
            yield mends(inertia, turned, says, attribute=turned[0].attribute, now=now, value=value)
            continue
        edits = [set_attribute(inertia, name, f"{v:.4g}") for name, v in zip(DIAGONAL, possible(before), strict=True)]
        edits += [set_attribute(inertia, name, "0") for name in PRODUCTS if float(inertia.get(name, "0"))]
        wrong = max(range(3), key=lambda k: abs(float(edits[k].value) - before[k]))
        told, now, value = DIAGONAL[wrong], inertia.get(DIAGONAL[wrong]), edits[wrong].value
        if all(abs(float(edits[k].value) - before[k]) <= 1e-3 * before[k] for k in range(3)) and len(edits) > 3:
            told, now, value = edits[3].attribute, inertia.get(edits[3].attribute), "0"
        link_name = (
            f'link "{inertia.parent.parent.get("name")}"' if inertia.parent and inertia.parent.parent else "link"
        )
        says = f"{link_name}: {said}."
        yield mends(inertia, edits, says, attribute=told, now=now, value=value)


def _unlike_twin(inertia: Element, moments: list[float]) -> tuple[str, str, str] | None:
    """The one moment of a link that is unlike that of the link on the other side, with that and its link's name."""
    link = inertia.parent.parent if inertia.parent else None
    if link is None or link.parent is None:
        return None
    for other in link.parent.children:
        name, twin = link.get("name"), other.get("name")
        theirs = next((each for each in other.walk() if each.tag == "inertia"), None)
        if theirs is None or other.tag != "link" or not (twin in right_of(name) or name in right_of(twin)):
            continue
        right = [float(theirs.get(each, "0")) for each in DIAGONAL]
        odd = [k for k in range(3) if abs(moments[k] - right[k]) > ALIKE * abs(right[k])]
        if len(odd) == 1:
            return DIAGONAL[odd[0]], theirs.get(DIAGONAL[odd[0]]), twin
    return None
