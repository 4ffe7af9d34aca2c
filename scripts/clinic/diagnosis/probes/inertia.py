"""Mass, centre of mass and inertia of a body, and the edit that gives it others."""

from __future__ import annotations

from clinic.diagnosis.edit import Edit, insert, replace
from clinic.diagnosis.probes.vector import Vector, diagonal, of_quaternion, turned, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.source import Element

DIAGONAL = ("ixx", "iyy", "izz")
PRODUCTS = ("ixy", "ixz", "iyz")
PART = 1e-7  # of the largest moment: a rod of 1 m and 0.2 mm
ZERO = 1e-15  # kg m2: below it is what was left of a subtraction


def tensor(simulation: Simulation, body: int) -> Vector:
    """The inertia about the centre of mass in the axes of the body's frame, in kg m2."""
    return turned(
        of_quaternion(simulation.row("body_iquat", body, 4)), diagonal(simulation.row("body_inertia", body, 3))
    )


def inertial(model: ReaderModel, body: int) -> Element | None:
    """The `<inertial>` of a body; None where its geoms make its inertia."""
    element = model.element("body", body)
    return element.first("inertial") if element is not None else None


def set_inertial(model: ReaderModel, body: int, mass: float, centre: Vector, about: Vector) -> tuple[Edit, ...]:
    """The edit that writes a body's inertial anew.

    Args:
        model: The reader's model.
        body: Its index.
        mass: In kg.
        centre: In the body's frame, in m.
        about: The tensor about the centre of mass in the axes of the body's frame, in kg m2, row by row.
    """
    element = model.element("body", body)
    if element is None or model.source is None:
        return ()
    xx, xy, xz, _, yy, yz, _, _, zz = about
    if model.urdf:
        moments = {"ixx": xx, "ixy": xy, "ixz": xz, "iyy": yy, "iyz": yz, "izz": zz}
        inner = f'<origin xyz="{written(centre)}" rpy="0 0 0"/><mass value="{mass:.6g}"/>'
        inner += "<inertia " + " ".join(f'{name}="{value:.6g}"' for name, value in moments.items()) + "/>"
        xml = f"<inertial>{inner}</inertial>"
    else:
        full = written((xx, yy, zz, xy, xz, yz))
        xml = f'<inertial pos="{written(centre)}" mass="{mass:.6g}" fullinertia="{full}"/>'
    there = element.first("inertial")
    return (replace(there, xml) if there else insert(element, xml),)


def fit(diagonal_: list[float], products: list[float]) -> bool:
    """Whether a body can have a tensor xx, yy, zz with xy, xz, yz: each principal moment is at most half of their sum.

    That is so where half of the trace on the diagonal, less the tensor, has no negative principal minor.
    """
    half = sum(diagonal_) / 2
    (a, b, c), (d, e, f) = (half - each for each in diagonal_), products
    pairs = (a * b - d * d, a * c - e * e, b * c - f * f)
    return min(a, b, c, *pairs, a * b * c - 2 * d * e * f - a * f * f - b * e * e - c * d * d) >= 0


def possible(moments: list[float]) -> list[float]:
    """Three moments that a body can have, with as few changed as may be.

    A negative one loses its sign, one of zero, or a negative one that does not fit so, is the mean of the others, and
    one above the sum of the others loses decimal places until it fits, or becomes that sum, or the larger of them where
    that is too little.
    """
    least = max(ZERO, PART * max(map(abs, moments)))
    made = [abs(each) if abs(each) > least else 0.0 for each in moments]
    if 2 * max(made) > sum(made) and sum(each > 0 for each in moments) == 2:
        made = [0.0 if each < 0 else size for each, size in zip(moments, made, strict=True)]
    for index, each in enumerate(made):
        rest = [other for k, other in enumerate(made) if k != index]
        if each == 0:
            made[index] = sum(rest) / 2 or 1e-6
    largest = max(range(3), key=lambda index: made[index])
    rest_sum = sum(made) - made[largest]
    while made[largest] > 3 * rest_sum:
        made[largest] /= 10
    others = [each for k, each in enumerate(made) if k != largest]
    made[largest] = min(made[largest], 0.999 * rest_sum)
    if made[largest] <= max(others) - min(others):
        made[largest] = max(others)
    return made
