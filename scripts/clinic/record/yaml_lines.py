"""YAML with the line of every field. Numbers, `true`, `false` and `null` are those of YAML 1.2; all else is text."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

import yaml
from yaml.reader import ReaderError

from clinic.record.problem import Problem

Where = tuple[str | int, ...]


@dataclass(frozen=True)
class Lines:
    """The line, counted from 1, of every field by its path; `text` is the file's."""

    by_path: dict[Where, int]
    text: str

    def at(self, where: Where) -> int:
        """The line of the field, or of its nearest ancestor that stands in the file."""
        while where and where not in self.by_path:
            where = where[:-1]
        return self.by_path.get(where, 1)

    def holding(self, where: Where, words: str) -> int:
        """The first line from the field's on that holds the beginning of the words, else the field's."""
        line, beginning = self.at(where), words.partition("\n")[0][:20]
        rows = self.text.split("\n")[line - 1 :]
        return next((line + k for k, row in enumerate(rows) if beginning in row), line)


class _Loader(yaml.CSafeLoader):
    """Takes few kinds of text for something else."""


_Loader.yaml_implicit_resolvers = {}


for kind, pattern, first in (
    ("null", r"~|null|", ["~", "n", ""]),
    ("bool", r"true|false", ["t", "f"]),
    ("int", r"[-+]?(0|[1-9][0-9]*)", [*"-+0123456789"]),
    ("float", r"[-+]?(\.[0-9]+|(0|[1-9][0-9]*)(\.[0-9]*)?)([eE][-+]?[0-9]+)?", [*"-+.0123456789"]),
):
    _Loader.add_implicit_resolver(f"tag:yaml.org,2002:{kind}", re.compile(f"(?:{pattern})$"), first)


def dotted(where: Where) -> str:
    """`("fixes", 0, "id")` as `fixes[0].id`."""
    text = ""
    for part in where:
        text += f"[{part}]" if isinstance(part, int) else f".{part}" if text else part
    return text


def read_yaml(text: str) -> tuple[Any, Lines]:
    """The document's data and the line of each of its fields.

    Raises:
        yaml.MarkedYAMLError: For a syntax error, a key given twice, or a document that is no mapping.
        yaml.reader.ReaderError: For a character that YAML cannot hold.
    """
    lines: dict[Where, int] = {}
    node = yaml.compose(text, Loader=_Loader)
    if not isinstance(node, yaml.MappingNode):
        raise yaml.MarkedYAMLError(problem="no mapping", problem_mark=node.start_mark if node else None)
    return _value(node, (), lines, yaml.SafeLoader("")), Lines(lines, text)


def yaml_problem(file: str, text: str, error: yaml.MarkedYAMLError | ReaderError) -> Problem:
    """What is wrong with a text that `read_yaml` refused."""
    if isinstance(error, yaml.MarkedYAMLError):
        mark = error.problem_mark or error.context_mark
        line, began = _line(mark), _line(error.context_mark or mark)
        found = f"{error.problem or error.context}" + (f", in what began in line {began}" if began < line else "")
        repair = "give each field once; indent by two spaces; quote text that holds `: `, `#`, `{` or `[`"
        return Problem(file, line, "", found, "`field: value` lines of YAML", repair)
    line = text.encode()[: error.position].count(b"\n") + 1
    return Problem(file, line, "", f"text that YAML cannot hold: {error.reason}", "plain text", "delete it")


def _value(node: yaml.Node, where: Where, lines: dict[Where, int], loader: yaml.SafeLoader) -> Any:
    """The node as data; the lines of all that is in it are added to `lines`."""
    lines.setdefault(where, _line(node.start_mark))
    if isinstance(node, yaml.SequenceNode):
        return [_value(item, (*where, index), lines, loader) for index, item in enumerate(node.value)]
    if not isinstance(node, yaml.MappingNode):
        return loader.construct_object(node)
    data = {}
    for key, value in node.value:
        if not isinstance(key.value, str):
            raise yaml.MarkedYAMLError(problem="a key that is no text", problem_mark=key.start_mark)
        if key.value in data:
            raise yaml.MarkedYAMLError(problem=f"the key {key.value} twice", problem_mark=key.start_mark)
        lines[*where, key.value] = _line(key.start_mark)
        data[key.value] = _value(value, (*where, key.value), lines, loader)
    return data


def _line(mark: Any) -> int:
    return mark.line + 1 if mark else 1
