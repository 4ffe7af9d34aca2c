"""What is planted. A kind of fault is a function, with `@kind` before it, in a module of this folder.

It gets a healthy model and a seeded generator, and gives what to change, or None where the model has no place for it.
Strengths are drawn over a wide range: whether one does harm is measured afterwards.
"""

from __future__ import annotations

import importlib
import math
import pkgutil
import re
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from random import Random
from typing import TypeVar

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.reader_model import ReaderModel

T = TypeVar("T")
DOES_NOT_COMPILE = ("compiles",)  # the harm of a fault for which the model is refused


@dataclass(frozen=True)
class Fault:
    """What one plant changes.

    Attributes:
        edits: The change of the healthy text.
        elements: Named as findings name them; a finding about any of these is in the right place. Empty: the model.
        attribute: The attribute that is wrong now.
        strength: How much, as the kind counts it.
    """

    edits: tuple[Edit, ...]
    elements: tuple[str, ...] = ()
    attribute: str = ""
    strength: float = 1.0


class NoPlaceError(LookupError):
    """A model without a place for a fault."""


Planter = Callable[[ReaderModel, Random], Fault | None]


@dataclass(frozen=True)
class Kind:
    """A kind of fault.

    Attributes:
        name: Its function's, with hyphens.
        text: What is planted.
        rules: Those that should name it; the first is measured by it, and names no rule where none tells such a fault.
        harms: What counts as harm by it, by names in `harm`; DOES_NOT_COMPILE for a text that is refused.
        servos: Whether motors are made to position servos first, where the model has none.
        plant: Makes it.
    """

    name: str
    text: str
    rules: tuple[str, ...]
    harms: tuple[str, ...]
    servos: bool
    plant: Planter


_KINDS: dict[str, Kind] = {}


def kind(*rules: str, harms: Sequence[str], servos: bool = False) -> Callable[[Planter], Planter]:
    """Makes a function a kind of fault."""

    def register(plant: Planter) -> Planter:
        def made(model: ReaderModel, random: Random) -> Fault | None:
            with suppress(NoPlaceError):
                return plant(model, random)
            return None

        name = plant.__name__.replace("_", "-")
        _KINDS[name] = Kind(name, (plant.__doc__ or "").strip(), rules, tuple(harms), servos, made)
        return plant

    return register


@cache
def kinds() -> dict[str, Kind]:
    """All kinds by name."""
    for found in pkgutil.iter_modules(__path__, f"{__name__}."):
        importlib.import_module(found.name)
    return dict(sorted(_KINDS.items()))


def pick(random: Random, found: Sequence[T]) -> T:
    """One of several.

    Raises:
        NoPlaceError: If there is none.
    """
    if not found:
        raise NoPlaceError
    return random.choice(found)


def between(random: Random, low: float, high: float) -> float:
    """A number, as likely in each decade between the two."""
    return math.exp(random.uniform(math.log(low), math.log(high)))


def text_of(*values: float) -> str:
    """Numbers as an attribute has them."""
    return " ".join(f"{value:.6g}" for value in values)


def numbers(text: str | None) -> list[float]:
    """The numbers of an attribute."""
    return [float(word) for word in re.split(r"[\s,]+", (text or "").strip()) if word]


def written(model: ReaderModel, of: str, attribute: str = "") -> list[int]:
    """The elements of a kind that have a place in the text, and a value for the attribute."""
    all_ = range(model.simulation.count(of))
    return [
        i
        for i in all_
        if model.element(of, i) is not None and (not attribute or model.value(of, i, attribute) is not None)
    ]
