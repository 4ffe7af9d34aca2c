"""Cards: what the pages about all cases say of one, and the home page, which shows a card for each."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from clinic.pages.text.markup import line
from clinic.pages.text.prose import fill
from clinic.pages.text.template import render
from clinic.proof.evidence import Evidence
from clinic.record.case import Case
from clinic.work.cache import Files

LONG_ENOUGH = 150  # characters


@dataclass(frozen=True)
class Card:
    """A case in a list: `picture` is a file beside its page."""

    slug: str
    number: int
    title: str
    symptom: str
    picture: str


def card(case: Case, evidence: Evidence, files: Files) -> Card:
    """The card of a case with these files."""
    picture = "broken.webp" if "broken.webp" in files else "plot.svg"
    return Card(case.slug, case.record.number, case.record.title, line(opening(case, evidence)), picture)


def home_page(cards: Iterable[Card], engine: str) -> str:
    """The Markdown of the home page; `engine` is the version of MuJoCo."""
    return render("home", cards=list(cards), engine=engine)


def opening(case: Case, evidence: Evidence) -> str:
    """The first sentences of the symptom, until they are long enough to say something."""
    words = " ".join(fill(case.record.symptom, evidence).replace("`", "").split())
    kept = ""
    for sentence in re.split(r"(?<=[.?!]) ", words):
        kept = f"{kept} {sentence}".strip()
        if len(kept) >= LONG_ENOUGH:
            break
    return kept
