"""What MuJoCo says: warnings and errors, each provoked while the site is built, so that the text is its own."""

from __future__ import annotations

import json
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


class Message(Strict):
    """One warning or error: how to provoke it, what it means and what to look at; the fields stand in FILE's head."""

    id: str = ""
    chapter: str = ""
    title: Text
    warning: str | None = None
    xml: str | None = None
    python: str | None = None
    unprovoked: str | None = None
    says: Text | None = None
    meaning: Text
    look_at: Text
    case: Identifier | None = None
    older: list[Text] = Field(default=[])

    @model_validator(mode="after")
    def _one_way(self) -> Message:
        given = [name for name in ("xml", "python", "unprovoked") if getattr(self, name) is not None]
        if len(given) != 1:
            raise ValueError(f"{' and '.join(given) or 'nothing'} instead of exactly one of xml, python, unprovoked")
        if (self.says is None) != (self.unprovoked is None):
            raise ValueError("`says` stands beside `unprovoked`, and nowhere else")
        return self

    @property
    def code(self) -> str | None:
        """The Python that provokes it; None where no build can."""
        return f"load({self.xml.strip()!r})" if self.xml is not None else self.python


CHAPTERS = TypeAdapter(dict[str, dict[Identifier, Message]])


def load_messages(file: Path = FILE) -> list[Message]:
    """The messages in the order of the file.

    Raises:
        CaseError: With all that is not as it should be.
    """
    try:
        chapters = CHAPTERS.validate_python(yaml.safe_load(file.read_text(encoding="utf-8")))
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
    codes = {message.id: message.code for message in messages if message.code is not None}
    key = key_of("messages", codes, of="engine")
    files = cache.remember(key, lambda: {SAID: json.dumps(provoke(codes)).encode()})
    made: dict[str, str] = json.loads(files[SAID])
    return made


def messages_page(messages: list[Message], said: Mapping[str, str], cases: Mapping[str, Case]) -> str:
    """The Markdown of the page; `said` is what `provoke_messages` gave."""
    chapters = {name: list(part) for name, part in groupby(messages, lambda message: message.chapter)}
    return render("messages", chapters=chapters, said=said, cases=cases, engine=mujoco.__version__)
