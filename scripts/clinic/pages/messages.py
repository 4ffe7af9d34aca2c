"""What MuJoCo says: warnings and errors, each provoked while the site is built, so that the text is its own."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import mujoco
from pydantic import ConfigDict, Field, TypeAdapter, ValidationError, model_validator

from clinic.engine.provoke import provoke
from clinic.pages.case_page import TEMPLATES
from clinic.record.case import Case
from clinic.record.parts import WARNINGS, Identifier, Strict, Text
from clinic.record.problem import CaseError, Problem
from clinic.record.yaml_lines import YamlError, dotted, read_yaml
from clinic.work.cache import Cache, key_of

FILE = Path(__file__).with_name("messages.yaml")
SAID = "messages.json"


class Message(Strict):
    """One warning or error: how to provoke it, what it says, what it means and what to look at."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)

    id: str = ""
    group: Text
    title: Text
    warning: str | None = None
    xml: str | None = None
    python: str | None = None
    unprovoked: str | None = None
    says: Text
    meaning: Text
    look_at: Text
    case: Identifier | None = None
    older: list[Text] = Field(default=[])

    @model_validator(mode="after")
    def _one_way(self) -> Message:
        given = [name for name in ("xml", "python", "unprovoked") if getattr(self, name) is not None]
        if len(given) != 1:
            raise ValueError(f"{' and '.join(given) or 'nothing'} instead of exactly one of xml, python, unprovoked")
        if self.warning is not None and self.warning not in WARNINGS:
            raise ValueError(f"{self.warning} is no MuJoCo warning: {', '.join(WARNINGS)}")
        return self

    @property
    def code(self) -> str | None:
        """The Python that provokes it; None where no build can."""
        return f"load({self.xml.strip()!r})" if self.xml is not None else self.python


ENTRIES = TypeAdapter(dict[Identifier, Message])


def load_messages(file: Path = FILE) -> list[Message]:
    """The messages in the order of the file.

    Raises:
        CaseError: With every entry that is not as it should be.
    """
    try:
        data, lines = read_yaml(file.read_text(encoding="utf-8"))
    except YamlError as error:
        raise CaseError([Problem(file.name, error.line, "", error.found, error.expected, error.repair)]) from None
    try:
        made = ENTRIES.validate_json(json.dumps(data))
    except ValidationError as error:
        raise CaseError(
            Problem(file.name, lines.at(e["loc"]), dotted(e["loc"]), str(e["input"])[:60], e["msg"], "correct it")
            for e in error.errors()
        ) from None
    return [entry.model_copy(update={"id": key}) for key, entry in made.items()]


def heard(messages: Iterable[Message], cache: Cache) -> dict[str, str]:
    """What the installed engine says, by the messages' ids; those that no build can provoke are left out."""
    codes = {message.id: message.code for message in messages if message.code is not None}
    key = key_of("messages", codes, of="engine")
    files = cache.remember(key, lambda: {SAID: json.dumps(provoke(codes)).encode()})
    made: dict[str, str] = json.loads(files[SAID])
    return made


def messages_page(messages: list[Message], said: Mapping[str, str], cases: Mapping[str, Case]) -> str:
    """The Markdown of the page; `said` is what was heard."""
    groups: dict[str, list[dict[str, Any]]] = {}
    for message in messages:
        groups.setdefault(message.group, []).append(
            {
                "message": message,
                "says": said.get(message.id, message.says).strip(),
                "case": cases.get(message.case or ""),
            }
        )
    return TEMPLATES.get_template("messages.md.j2").render(
        groups=groups, engine=mujoco.__version__, provoked=sum(message.code is not None for message in messages)
    )
