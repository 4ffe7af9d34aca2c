"""What prose may hold: code, formulas, and fields that become numbers with their units, as people read them."""

from __future__ import annotations

import math
import re

CODE = re.compile(
    r"(?P<code>^ *(?P<fence>```+|~~~+)[^\n`]*\n.*?^ *(?P=fence) *$|"
    r"(?P<tick>`+)(?!`)(?:(?!\n *\n).)+?(?<!`)(?P=tick)(?!`))",
    re.DOTALL | re.MULTILINE,
)
FORMULA = re.compile(r"\$\$(?P<block>.+?)\$\$|(?<![\\$\w])\$(?P<inline>[^\s$](?:[^$]*[^\s$\\])?)\$(?![\d$])", re.DOTALL)
FIELD = re.compile(r"\{\{(.*?)\}\}", re.DOTALL)
CONVERSIONS = {
    "mm": ("m", 1e3, "mm"),
    "cm": ("m", 1e2, "cm"),
    "um": ("m", 1e6, "µm"),
    "kN": ("N", 1e-3, "kN"),
    "ms": ("s", 1e3, "ms"),
    "deg": ("rad", 180 / math.pi, "°"),
    "percent": ("", 100.0, "%"),
}
SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def bare(text: str) -> str:
    """Prose without its code, with an `x` for each of its fields."""
    return FIELD.sub("x", CODE.sub("", text))


def quantity(value: float, unit: str, digits: int = 3) -> str:
    """The number with significant digits and its unit: `49.9 mm`, `3.0 × 10⁻² m`."""
    space = "" if unit in ("", "°") else "\u00a0"
    return number(value, digits) + space + unit.replace(" ", "\u00a0")


def rounded_up(value: float, digits: int) -> float:
    """A bound with so many significant digits, never below it."""
    if value <= 0 or not math.isfinite(value):
        return value
    step = 10.0 ** (math.floor(math.log10(value)) - digits + 1)
    return math.ceil(value / step - 1e-6) * step  # what is short of a number by no more is that number


def plain(value: float) -> str:
    """The number as it was written in a record, with a real minus and powers of ten: `8 × 10⁻⁶`."""
    mantissa, _, exponent = f"{value:g}".partition("e")
    power = f"\u00a0×\u00a010{str(int(exponent)).translate(SUPERSCRIPT)}" if exponent else ""
    return mantissa.replace("-", "\u2212") + power


def number(value: float, digits: int = 3) -> str:
    """The number with significant digits; whole numbers below 100,000 as they are."""
    if value == int(value) and abs(value) < 1e5:
        text = str(int(value))
    elif 1e-3 <= abs(value) < 1e5:
        places = max(0, digits - 1 - math.floor(math.log10(abs(float(f"{value:.{digits - 1}e}")))))
        text = f"{value:.{places}f}"
    else:
        mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
        text = f"{mantissa}\u00a0×\u00a010{str(int(exponent)).translate(SUPERSCRIPT)}"
    return text.replace("-", "\u2212")
