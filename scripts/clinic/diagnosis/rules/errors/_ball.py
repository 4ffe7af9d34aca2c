"""What is left out of a link's inertia, as a ball of 50 mm radius has it."""

from __future__ import annotations

from clinic.diagnosis.edit import insert, set_attribute
from clinic.diagnosis.rules.errors._message import mends
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect, rounded

BALL = 0.4 * 0.05**2  # m2: inertia for each kg of a ball of 50 mm radius
MOMENTS = {"ixx": 1, "iyy": 1, "izz": 1, "ixy": 0, "ixz": 0, "iyz": 0}


def mass_of_a_ball(inertial: Element | None) -> str:
    """The mass of a ball of 50 mm radius that has the inertia which is written, in kg."""
    inertia = inertial.first("inertia") if inertial else None
    written = [inertia.get(name) for name in ("ixx", "iyy", "izz")] if inertia else []
    if inertial and not written:
        written = (inertial.get("diaginertia") or inertial.get("fullinertia")).split()[:3]
    mean = sum(float(each or "0") for each in written) / 3
    return rounded(mean / BALL) if mean > 0 else "0.01"


def mass_of_its_shape(inertial: Element) -> tuple[str, str]:
    """The mass that a URDF's link has as the first of its shapes, by the inertia which is written, and the kind."""
    inertia = inertial.first("inertia")
    link = inertial.parent.children if inertial.parent else []
    drawn = [each.first("geometry") for tag in ("collision", "visual") for each in link if each.tag == tag]
    shapes = [shape for geometry in drawn[:1] if geometry for shape in geometry.children]
    try:
        mean = sum(float(inertia.get(name)) for name in ("ixx", "iyy", "izz")) / 3 if inertia else 0.0
        each = _mean_of(shapes[0]) if shapes else 0.0
    except ValueError:
        return "", ""
    return (rounded(mean / each), shapes[0].tag) if mean > 0 and each > 0 else ("", "")


def _mean_of(shape: Element) -> float:
    """The mean of the three moments of inertia of a shape for each kg, in m2; 0 for a mesh."""
    if shape.tag == "box":
        return sum(float(each) ** 2 for each in shape.get("size").split()) / 18
    radius = float(shape.get("radius") or "0")
    if shape.tag == "cylinder":
        return (radius**2 + float(shape.get("length")) ** 2 / 6) / 3
    return 0.4 * radius**2 if shape.tag == "sphere" else 0.0


def moments_of_a_ball(inertia: Element) -> Suspect:
    """All moments that an inertia of URDF lacks: those off the diagonal are zero."""
    mass = inertia.parent.first("mass") if inertia.parent else None
    own = [float(inertia.get(name)) for name in ("ixx", "iyy", "izz") if inertia.get(name)]
    ball = max(own) if own else float(mass.get("value", "0.01") if mass else "0.01") * BALL
    lacking = [name for name in MOMENTS if name not in inertia.attributes]
    edits = [set_attribute(inertia, name, f"{ball * MOMENTS[name]:.2g}") for name in lacking]
    says = f"An <inertia> of URDF has six numbers, and this one lacks {', '.join(lacking)}."
    return mends(inertia, edits, says, attribute=lacking[0], now="nothing", value=edits[0].value)


def ball_in(inertial: Element, tag: str, says: str) -> Suspect:
    """The `<mass>` or the `<inertia>` that an `<inertial>` of a URDF lacks; `says` is that it needs one."""
    if tag == "mass":
        value = mass_of_a_ball(inertial)
        extra = "" if inertial.first("inertia") else _inertia(float(value))
        edits = (insert(inertial, f'<mass value="{value}"/>{extra}'),)
        says += f": {value} kg is that of a ball of 50 mm radius with this inertia."
        return mends(inertial, edits, says, attribute="mass", now="nothing", value=value)
    mass = inertial.first("mass")
    kg = float(mass.get("value", "0.01")) if mass else 0.01
    says += ": that of a ball of 50 mm radius."
    edits = (insert(inertial, _inertia(kg)),)
    return mends(inertial, edits, says, attribute="inertia", now="nothing", value=f"{kg * BALL:.2g}")


def _inertia(mass: float) -> str:
    own = f"{mass * BALL:.2g}"
    return f'<inertia ixx="{own}" iyy="{own}" izz="{own}" ixy="0" ixz="0" iyz="0"/>'
