"""The rules, a module each, in folders by what they are about. A rule exists because its module does.

A rule's name is its module's, with hyphens. The module has

TITLE      the fault, in a few words
FAMILIES   the symptoms that it explains, by their names in `families.toml`; the first is the likeliest
SINCE      the release of the clinic that brought it, where that is not the first
LEVEL      "hint", where it finds less than four in five of the faults that the bench plants for it
UNPLANTED  why the bench plants none for it, where it plants none: then all it tells is a hint, but for LEVEL = "cause"
MINOR      whether what it tells moves nothing by itself, so that it is told after all else
AFLOAT     whether a URDF is looked at with its root free to move, where it is not the world
CASE       the case that shows it, where there is one
suspects   a function that takes a `ReaderModel` and gives `Suspect`s; for a model that does not compile, with FAMILIES
           `will-not-compile`, it reads `model.error`

and a docstring that is its page: what it is, why it matters, `Bad:` with an example of a few lines of which it is told
first, `Good:` with the diff that makes one of it of which nothing is told, or with another example, the number and its
source, and when it is wrong.
"""

from __future__ import annotations

import importlib
import pkgutil
import tomllib
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from clinic.diagnosis.reader_model import ReaderModel
    from clinic.diagnosis.suspect import Level, Suspect

COMPILES_NOT = "will-not-compile"
FIRST = "0.1"
USUAL = 0.3  # the share of right ones among a rule's, where nothing is known


@dataclass(frozen=True)
class Rule:
    """A rule's module, read."""

    id: str
    area: str  # the folder of its module: `contact`
    title: str
    families: tuple[str, ...]
    since: str
    case: str | None
    level: Level
    unplanted: str
    minor: bool
    odds: float
    text: str
    afloat: bool
    suspects: Callable[[ReaderModel], Iterable[Suspect]]

    def example(self, which: str) -> str:
        """The model that the docstring shows under `Bad:` or `Good:`.

        Raises:
            ValueError: If what `Good:` takes out does not stand once in the bad one.
        """
        shown = self.shown(which)
        return shown if which == "Bad" or shown.startswith("<") else _changed(self.example("Bad"), shown)

    def shown(self, which: str) -> str:
        """The text under `Bad:` or `Good:`: a model, or the diff that makes the good one of the bad one."""
        lines = iter(self.text.partition(f"\n{which}:\n")[2].splitlines())
        shown: list[str] = []
        for line in lines:
            if line.strip() and not line.startswith("    "):
                break
            shown.append(line[4:])
        return "\n".join(shown).strip("\n") + "\n"

    @property
    def of_errors(self) -> bool:
        """Whether it is about models that do not compile."""
        return COMPILES_NOT in self.families


def _changed(text: str, diff: str) -> str:
    """A text with the parts of a diff, which blank lines part, put in place of what they take out."""
    lines = text.splitlines()
    for part in diff.strip("\n").split("\n\n"):
        marked = [(line[:1], line[2:]) for line in part.splitlines()]
        before, after = ([line for mark, line in marked if mark in (" ", sign)] for sign in "-+")
        places = [at for at in range(len(lines)) if lines[at : at + len(before)] == before]
        if len(places) != 1:
            raise ValueError(f"stands {len(places)} times in the bad example, expected once: {before}")
        lines[places[0] : places[0] + len(before)] = after
    return "\n".join(lines) + "\n"


@cache
def _odds() -> dict[str, float]:
    """How likely what a rule tells is the fault, by its id: as in `odds.toml`, with two more models that are usual."""
    read: dict[str, list[int]] = tomllib.loads(Path(__file__).with_name("odds.toml").read_text(encoding="utf-8"))
    return {name: (right + 2 * USUAL) / (told + 2) for name, (right, told) in read.items()}


@cache
def rules() -> dict[str, Rule]:
    """All rules by id, in alphabetical order."""
    made = {}
    for found in pkgutil.walk_packages(__path__, f"{__name__}."):
        if found.ispkg or found.name.rpartition(".")[2].startswith("_"):
            continue
        module = importlib.import_module(found.name)
        *_, area, name = found.name.replace("_", "-").split(".")
        unplanted = getattr(module, "UNPLANTED", "")
        made[name] = Rule(
            id=name,
            area=area,
            title=module.TITLE,
            families=module.FAMILIES,
            since=getattr(module, "SINCE", FIRST),
            case=getattr(module, "CASE", None),
            level=getattr(module, "LEVEL", "hint" if unplanted else "cause"),
            unplanted=unplanted,
            minor=getattr(module, "MINOR", False),
            odds=_odds().get(name, USUAL),
            text=(module.__doc__ or "").strip(),
            afloat=getattr(module, "AFLOAT", False),
            suspects=module.suspects,
        )
    return dict(sorted(made.items()))
