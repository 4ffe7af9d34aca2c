"""The first page: the symptoms as tiles, messages that are pasted often, and a card for every case."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import mujoco

from clinic.pages.cases import CasePage
from clinic.pages.messages import load_messages
from clinic.pages.text.template import render
from clinic.record.families import Family, families

PASTED = ("bad-qacc", "massless", "unrecognized-attribute", "file-not-found", "constraint-full")


class Tile(NamedTuple):
    """A symptom that has a case.

    Attributes:
        name: The family's name; with spaces, what the tile says.
        family: The family.
        picture: The slug of the case whose picture the tile shows; empty if none has a picture.
        film: The slug of the case whose two seconds of film it shows; empty if none has a film.
    """

    name: str
    family: Family
    picture: str
    film: str


def home(shown: Sequence[CasePage]) -> str:
    """The Markdown of the page. Cards stand in the order of the symptoms; those without one come last."""
    order = {name: k for k, name in enumerate(families())}
    cards = sorted(shown, key=lambda one: (order.get(one.case.record.family or "", len(order)), _number(one)))
    messages = {message.id: message for message in load_messages()}
    return render(
        "home",
        cards=cards,
        tiles=tiles(cards),
        pasted=[messages[key] for key in PASTED],
        families=families(),
        engine=mujoco.__version__,
    )


def tiles(cards: Sequence[CasePage]) -> list[Tile]:
    """A tile for each symptom that has a case; a case that is filmed lends its picture before one that is not."""
    made = []
    for name, family in families().items():
        own = [one for one in cards if one.case.record.family == name]
        filmed = next((one.case.slug for one in own if "clip.mp4" in one.files), "")
        picture = filmed or next((one.case.slug for one in own if "thumb.webp" in one.files), "")
        if own:
            made.append(Tile(name, family, picture, filmed))
    return made


def _number(one: CasePage) -> float:
    return one.case.record.number or float("inf")
