"""What MuJoCo says: warnings and errors, each provoked while the site is built, so that the text is its own.

What other releases say instead was provoked too, by `make releases`, and stands in LOCK.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterable, Mapping
from itertools import groupby
from pathlib import Path

import mujoco
import yaml
from pydantic import Field, TypeAdapter, ValidationError, model_validator

from clinic.engine.provoke import provoke
from clinic.pages.text.template import render
from clinic.record.case import Case
from clinic.record.parts import Identifier, Strict, Text
from clinic.record.problem import CaseError, Problem
from clinic.work.cache import Cache, key_of

FILE = Path(__file__).with_name("messages.yaml")
SAID = "messages.json"
LOCK = "messages.lock.json"


class Message(Strict):
    """One warning or error: how to provoke it, what it means and what to look at; the fields stand in FILE's head."""

    id: str = ""
    chapter: str = ""
    title: Text
    warning: str | None = None
    xml: str | None = None
    python: str | None = None
    says: Text | None = None
    meaning: Text
    look_at: Text
    case: Identifier | None = None
    older: list[Text] = Field(default=[])

    @model_validator(mode="after")
    def _one_way(self) -> Message:
        given = [name for name in ("xml", "python", "says") if getattr(self, name) is not None]
        if len(given) != 1:
            raise ValueError(f"{' and '.join(given) or 'nothing'} instead of exactly one of xml, python, says")
        return self

    @property
    def code(self) -> str | None:
        """The Python that provokes it; None where no build can."""
        return f"load({self.xml.strip()!r})" if self.xml is not None else self.python


class Heard(Strict):
    """What other releases of MuJoCo say, where the first line differs in more than its numbers.

    Attributes:
        codes: A digest of what provoked it.
        said: The first lines by message and release, oldest first.
    """

    codes: str = ""
    said: dict[Identifier, dict[str, str]] = Field(default={})


CHAPTERS = TypeAdapter(dict[str, dict[Identifier, Message]])


def load_messages(file: Path = FILE) -> list[Message]:
    """The messages in the order of the file.

    Raises:
        CaseError: With all that is not as it should be.
    """
    try:
        chapters = CHAPTERS.validate_python(yaml.load(file.read_text(encoding="utf-8"), yaml.CSafeLoader))
    except (yaml.YAMLError, ValidationError) as error:
        expected = "entries as the head of the file describes them"
        raise CaseError([Problem(file.name, 1, "", str(error), expected, "correct it")]) from None
    return [
        message.model_copy(update={"id": key, "chapter": chapter})
        for chapter, messages in chapters.items()
        for key, message in messages.items()
    ]


def provoke_messages(messages: Iterable[Message], cache: Cache) -> dict[str, str]:
    """What the installed engine says, by the messages' ids; those that no build can provoke are left out."""
    codes = codes_of(messages)
    key = key_of("messages", codes, of="engine")
    files = cache.remember(key, lambda: {SAID: json.dumps(provoke(codes)).encode()})
    made: dict[str, str] = json.loads(files[SAID])
    return made


def codes_of(messages: Iterable[Message]) -> dict[str, str]:
    """The Python that provokes each message, by id; those that no build can provoke are left out."""
    return {message.id: message.code for message in messages if message.code is not None}


def listen(messages: Iterable[Message], releases: Mapping[str, Mapping[str, str]]) -> Heard:
    """What differs from the last release in all that each of them said, oldest first, by the messages' ids."""
    codes, made = codes_of(messages), dict[str, dict[str, str]]()
    for release, texts in releases.items():
        for key in codes:
            first, newest = (next(iter(text.splitlines()), "") for text in (texts[key], [*releases.values()][-1][key]))
            if _words(first) != _words(newest):
                made.setdefault(key, {})[release] = first
    return Heard(codes=_digest(codes), said=made)


def read_heard(root: Path, messages: Iterable[Message]) -> Heard:
    """The lock file of a checkout; empty where there is none, or what provokes the messages has changed since."""
    path = root / LOCK
    heard = Heard.model_validate_json(path.read_bytes()) if path.is_file() else Heard()
    return heard if heard.codes == _digest(codes_of(messages)) else Heard()


def messages_page(messages: list[Message], said: Mapping[str, str], cases: Mapping[str, Case], heard: Heard) -> str:
    """The Markdown of the page; `said` is what `provoke_messages` gave."""
    chapters = {name: list(part) for name, part in groupby(messages, lambda message: message.chapter)}
    others = {key: _spans(texts) for key, texts in heard.said.items()}
    return render("messages", chapters=chapters, said=said, others=others, cases=cases, engine=mujoco.__version__)


def _spans(texts: Mapping[str, str]) -> list[tuple[str, str]]:
    """Each text once, after the releases that say it, with numbers of the first: `3.3.7 to 3.11.0`."""
    spans = [list(part) for _, part in groupby(texts.items(), lambda each: _words(each[1]))]
    return [(" to ".join(dict.fromkeys([span[0][0], span[-1][0]])), span[0][1]) for span in spans]


def _words(text: str) -> str:
    return re.sub(r"\d+", "", text)


def _digest(codes: Mapping[str, str]) -> str:
    return hashlib.sha256(json.dumps(codes, sort_keys=True).encode()).hexdigest()[:16]
