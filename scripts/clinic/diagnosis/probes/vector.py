"""Vectors and 3x3 matrices as tuples, row by row: what numpy would do, for rules that run without it."""

from __future__ import annotations

import math
from collections.abc import Sequence

Vector = tuple[float, ...]
IDENTITY = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)


def add(a: Sequence[float], b: Sequence[float], scale: float = 1.0) -> Vector:
    """`a + scale * b`."""
    return tuple(x + scale * y for x, y in zip(a, b, strict=True))


def flipped(one: Sequence[float], axis: int) -> Vector:
    """A vector with another sign of one coordinate."""
    return tuple(-x if at == axis else x for at, x in enumerate(one))


def slips(one: Sequence[float]) -> list[Vector]:
    """A vector with two of its numbers exchanged, or with another sign of one."""
    x, y, z = one
    swapped = [each for each in ((y, x, z), (z, y, x), (x, z, y)) if each != (x, y, z)]
    return [*swapped, *(flipped(one, axis) for axis in range(3) if one[axis])]


def sub(a: Sequence[float], b: Sequence[float]) -> Vector:
    """`a - b`."""
    return tuple(x - y for x, y in zip(a, b, strict=True))


def dot(a: Sequence[float], b: Sequence[float]) -> float:
    """The scalar product."""
    return sum(x * y for x, y in zip(a, b, strict=True))


def cross(a: Sequence[float], b: Sequence[float]) -> Vector:
    """The vector product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def across(a: Sequence[float], axis: Sequence[float]) -> Vector:
    """A vector without its part along an axis of length 1."""
    return add(a, axis, -dot(a, axis))


def at(flat: Sequence[float], index: int) -> Vector:
    """Row `index` of a flat array of three columns."""
    return tuple(flat[3 * index : 3 * index + 3])


def norm(a: Sequence[float]) -> float:
    """The length."""
    return math.sqrt(dot(a, a))


def unit(a: Sequence[float]) -> Vector:
    """The direction; zeros for a vector of no length."""
    length = norm(a)
    return tuple(x / length for x in a) if length > 1e-12 else tuple(0.0 for _ in a)


def around(axis: Sequence[float], count: int) -> list[Vector]:
    """So many directions at right angles to an axis of length 1, evenly over a turn."""
    first = unit(cross(axis, (1.0, 0.0, 0.0) if abs(axis[0]) < 0.9 else (0.0, 1.0, 0.0)))
    second = cross(axis, first)
    angles = (2 * math.pi * turn / count for turn in range(count))
    return [add(tuple(math.cos(angle) * x for x in first), second, math.sin(angle)) for angle in angles]


def transpose(m: Sequence[float]) -> Vector:
    """Rows for columns; the inverse of a rotation."""
    return tuple(m[3 * column + row] for row in range(3) for column in range(3))


def times(m: Sequence[float], v: Sequence[float]) -> Vector:
    """A matrix times a vector, or times a matrix."""
    if len(v) == 3:
        return tuple(dot(m[3 * row : 3 * row + 3], v) for row in range(3))
    columns = [times(m, (v[i], v[i + 3], v[i + 6])) for i in range(3)]
    return tuple(columns[column][row] for row in range(3) for column in range(3))


def turned(m: Sequence[float], tensor: Sequence[float]) -> Vector:
    """A tensor in other axes: `m tensor m^T`."""
    return times(times(m, tensor), transpose(m))


def diagonal(a: Sequence[float]) -> Vector:
    """The matrix with these numbers on its diagonal."""
    return (a[0], 0.0, 0.0, 0.0, a[1], 0.0, 0.0, 0.0, a[2])


def of_quaternion(q: Sequence[float]) -> Vector:
    """The rotation matrix of a unit quaternion (w, x, y, z)."""
    w, x, y, z = q
    return (
        *(1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        *(2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        *(2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
    )


def apart(a: float, b: float) -> float:
    """How unlike two numbers are, in % of the larger; 200 for opposite ones."""
    largest = max(abs(a), abs(b))
    return 100 * abs(a - b) / largest if largest > 1e-9 else 0.0


def numbers(text: str | None) -> list[float]:
    """The row of numbers that a text holds; none where it is no such row."""
    try:
        return [float(each) for each in (text or "").split()]
    except ValueError:
        return []


def written(values: Sequence[float]) -> str:
    """Numbers as XML has them."""
    return " ".join(f"{0.0 if abs(value) < 1e-12 else value:.6g}" for value in values)
