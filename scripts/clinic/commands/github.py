"""Findings as the workflow commands by which GitHub marks lines of a change."""

from __future__ import annotations

from collections.abc import Iterator

from clinic.commands.sarif import message, path_of
from clinic.diagnosis.finding import Diagnosis

COMMANDS = {"cause": "error", "hint": "notice"}


def workflow_commands(folder: str, made: Diagnosis) -> Iterator[str]:
    """A line for each finding that nothing silences, of a model in a folder as seen from the current one."""
    for each in (*made.causes, *made.hints):
        yield workflow_command(
            COMMANDS[each.level], path_of(folder, each.file), each.line or 1, each.rule, message(each)
        )
    if made.error and not made.causes:
        yield workflow_command("error", path_of(folder, made.file), 1, "does not compile", made.error.strip())


def workflow_command(command: str, file: str, line: int, title: str, said: str) -> str:
    """`::error file=..,line=..,title=..::said`, escaped as the runner reads it."""
    return f"::{command} file={_property(file)},line={line},title={_property(title)}::{_data(said)}"


def _data(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
