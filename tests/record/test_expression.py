"""Arithmetic as data."""

from __future__ import annotations

import math

import numpy as np
import pytest
from clinic.record.expression import ExpressionError, evaluate, names, parse

VALUES = {"a": 3.0, "b": 4.0, "trace": np.array([1.0, -2.0, 4.0])}


@pytest.mark.parametrize(
    ("text", "value"),
    [
        pytest.param("1 + 2 * 3", 7, id="precedence"),
        pytest.param("(1 + 2) * 3", 9, id="parentheses"),
        pytest.param("2 ** 3 ** 2", 512, id="powers-bind-to-the-right"),
        pytest.param("-2 ** 2", -4, id="minus-after-power"),
        pytest.param("7 / 2", 3.5, id="division"),
        pytest.param("1 - 2 - 3", -4, id="minus-binds-to-the-left"),
        pytest.param("  a\n ", 3, id="name-and-spaces"),
        pytest.param("sqrt(a ** 2 + b ** 2)", 5, id="names-and-function"),
        pytest.param("2 * pi", math.tau, id="pi"),
        pytest.param("minimum(a, b) + 10 * maximum(a, b)", 43, id="two-arguments"),
        pytest.param("abs(-a)", 3, id="abs"),
        pytest.param("exp(log(a))", 3, id="exp-log"),
        pytest.param("sin(1) ** 2 + cos(1) ** 2", 1, id="sin-cos"),
        pytest.param("tan(pi / 4)", 1, id="tan"),
        pytest.param("arccos(-1)", math.pi, id="arccos"),
        pytest.param("floor(-0.5)", -1, id="floor"),
        pytest.param("1.5e-3", 0.0015, id="number"),
    ],
)
def test_value(text: str, value: float) -> None:
    assert evaluate(parse(text), VALUES) == pytest.approx(value)


def test_arrays_are_combined_element_by_element() -> None:
    assert evaluate(parse("a * abs(trace) - 1"), VALUES) == pytest.approx(np.array([2.0, 5.0, 11.0]))


def test_what_is_read_is_left_as_it_is() -> None:
    before = VALUES["trace"].copy()
    evaluate(parse("-abs(trace) + trace ** 2"), VALUES)
    assert VALUES["trace"] == pytest.approx(before, abs=0)


@pytest.mark.parametrize(
    ("text", "read"),
    [
        pytest.param("2 * 3", set(), id="none"),
        pytest.param("a + b * a", {"a", "b"}, id="each-once"),
        pytest.param("sqrt(a) + pi", {"a"}, id="neither-functions-nor-pi"),
    ],
)
def test_names(text: str, read: set[str]) -> None:
    assert names(parse(text)) == read


LANGUAGE = "numbers, names, + - * / **, parentheses and functions"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        pytest.param("", "arithmetic that can be parsed", id="empty"),
        pytest.param("1 +", "arithmetic that can be parsed", id="unfinished"),
        pytest.param("a = 1", "arithmetic that can be parsed", id="assignment"),
        pytest.param("a if b else 0", LANGUAGE, id="condition"),
        pytest.param("a < b", LANGUAGE, id="comparison"),
        pytest.param("a and b", LANGUAGE, id="logic"),
        pytest.param("not a", LANGUAGE, id="not"),
        pytest.param("a // b", LANGUAGE, id="whole-division"),
        pytest.param("a @ b", LANGUAGE, id="matrix-product"),
        pytest.param("a.real", LANGUAGE, id="attribute"),
        pytest.param("trace[0]", LANGUAGE, id="index"),
        pytest.param("[a]", LANGUAGE, id="list"),
        pytest.param("lambda: a", LANGUAGE, id="lambda"),
        pytest.param("(a := 1)", LANGUAGE, id="walrus"),
        pytest.param("'a'", LANGUAGE, id="text"),
        pytest.param("True", LANGUAGE, id="truth-value"),
        pytest.param("1j", LANGUAGE, id="complex-number"),
        pytest.param("sqrt(*a)", LANGUAGE, id="star"),
    ],
)
def test_refused(text: str, expected: str) -> None:
    with pytest.raises(ExpressionError) as caught:
        parse(text)
    assert str(caught.value) == expected


@pytest.mark.parametrize(
    "text", ["servo_sag(0, 0)", "bits(1 / 0, 2)", "bits(trace, 2)", "upright_time(1,1,1,1,0,1,1,1)"]
)
def test_function_that_cannot_take_its_numbers(text: str) -> None:
    told = pytest.raises(ExpressionError, match=r"^numbers that (servo_sag|bits|upright_time) can take: ")
    with np.errstate(all="ignore"), told:
        evaluate(parse(text), {"trace": np.array([1.0, 2.0])})


@pytest.mark.parametrize("text", ["__import__('os')", "eval(a)", "square(a)", "sqrt(a)(b)"])
def test_unknown_function(text: str) -> None:
    with pytest.raises(ExpressionError, match=r"^one of the functions abs, sqrt, "):
        parse(text)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        pytest.param("sqrt(a, b)", "sqrt with 1 argument", id="one-too-many"),
        pytest.param("sqrt()", "sqrt with 1 argument", id="none"),
        pytest.param("sqrt(a, x=b)", "sqrt with 1 argument", id="named-argument"),
        pytest.param("minimum(a)", "minimum with 2 arguments", id="one-too-few"),
        pytest.param("minimum(a, b, trace)", "minimum with 2 arguments", id="three"),
    ],
)
def test_number_of_arguments(text: str, expected: str) -> None:
    with pytest.raises(ExpressionError) as caught:
        parse(text)
    assert str(caught.value) == expected


def test_function_without_a_call_is_a_name_like_any_other() -> None:
    assert names(parse("abs(sqrt) + sqrt(1)")) == {"sqrt"}
