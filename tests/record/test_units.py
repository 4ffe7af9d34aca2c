"""Units as records write them, and those of arithmetic."""

from __future__ import annotations

import pytest
from clinic.record.expression import parse
from clinic.record.units import UnitError, powers_of, unit

LENGTH, TIME, FORCE = (0, 1, 0), (0, 0, 1), (1, 1, -2)


@pytest.mark.parametrize(
    ("text", "size", "powers"),
    [
        ("", 1, (0, 0, 0)),
        ("mm", 1e-3, LENGTH),
        ("N m/rad", 1, (1, 2, -2)),
        ("kg m²", 1, (1, 2, 0)),
        ("m/s²", 1, (0, 1, -2)),
    ],
)
def test_a_unit_is_read(text: str, size: float, powers: tuple[float, float, float]) -> None:
    found = unit(text)
    assert found is not None
    assert (found.size, found.powers) == (size, powers)


def test_what_is_no_unit() -> None:
    assert unit("furlong") is None


@pytest.mark.parametrize(
    ("expr", "powers"),
    [
        ("x / t", (0, 1, -1)),
        ("2 * x", LENGTH),
        ("x - 1", LENGTH),
        ("sqrt(x ** 2)", LENGTH),
        ("abs(f) * x", (1, 2, -2)),
        ("sin(x / x)", (0, 0, 0)),
    ],
)
def test_the_dimension_of_arithmetic(expr: str, powers: tuple[float, float, float]) -> None:
    assert powers_of(parse(expr), {"x": LENGTH, "t": TIME, "f": FORCE}) == powers


@pytest.mark.parametrize("expr", ["x + t", "exp(x)", "minimum(x, f)"])
def test_numbers_that_cannot_be_combined(expr: str) -> None:
    with pytest.raises(UnitError):
        powers_of(parse(expr), {"x": LENGTH, "t": TIME, "f": FORCE})


def test_a_name_without_a_unit_leaves_it_open() -> None:
    assert powers_of(parse("x * y"), {"x": LENGTH}) is None
