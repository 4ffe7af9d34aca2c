"""YAML with the line of every field. Numbers, `true`, `false` and `null` are those of YAML 1.2; all else is text."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import yaml

Where = tuple[str | int, ...]
CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u2028-\u202e\u2066-\u2069\ud800-\udfff\ufffe\uffff]")
"""Characters that no text needs: controls but for tab and line feed, and those that turn the reading direction."""


@dataclass
class YamlError(Exception):
    """YAML that is refused: `line` counts from 1."""

    line: int
    found: str
    expected: str
    repair: str


@dataclass(frozen=True)
class Lines:
    """The line, counted from 1, of every field by its path; `text` is the file's."""

    by_path: dict[Where, int]
    text: str = ""

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


def named(character: str) -> str:
    """A character that cannot be shown: `the character U+0007`."""
    return f"the character U+{ord(character):04X}"


@lru_cache(64)
def read_yaml(text: str) -> tuple[Any, Lines]:
    """The document's data and the line of each of its fields.

    Raises:
        YamlError: For a syntax error, an alias, a key given twice, or a document that is no mapping.
    """
    lines: dict[Where, int] = {}
    try:
        node = yaml.compose(text, Loader=_Loader)
        if not isinstance(node, yaml.MappingNode):
            raise YamlError(1, "no mapping", "`field: value` lines", "start with `number:` and `title:`")
        return _value(node, (), lines, set(), yaml.SafeLoader("")), Lines(lines, text)
    except yaml.MarkedYAMLError as error:
        line, began = _line(error.problem_mark or error.context_mark), _line(error.context_mark)
        tab = "\t" in "".join(text.split("\n")[line - 1 : line])
        inside = f", in what began in line {began}" if began < line else ""
        found = "a tab" if tab else f"{error.problem or error.context}{inside}"
        repair = "indent by two spaces; quote text that holds `: `, `#`, `{` or `[`; close what is opened"
        raise YamlError(line, found, "valid YAML", repair) from None
    except yaml.reader.ReaderError as error:
        line = text.encode()[: error.position].count(b"\n") + 1
        raise YamlError(line, f"text that YAML cannot hold: {error.reason}", "plain text", "delete it") from None


def _value(
    node: yaml.Node, where: Where, lines: dict[Where, int], seen: set[yaml.Node], loader: yaml.SafeLoader
) -> Any:
    """The node as data; the lines of all that is in it are added to `lines`."""
    line = lines.setdefault(where, _line(node.start_mark))
    if node in seen:
        raise YamlError(line, "a value that stands elsewhere", "no aliases", "write the value out")
    seen.add(node)
    if isinstance(node, yaml.SequenceNode):
        return [_value(item, (*where, index), lines, seen, loader) for index, item in enumerate(node.value)]
    if not isinstance(node, yaml.MappingNode):
        return loader.construct_object(node)
    data = {}
    for key, value in node.value:
        line, name = _line(key.start_mark), key.value
        if not isinstance(name, str):
            raise YamlError(line, "a key that is no text", "`field: value` lines", "write one word")
        if name in data:
            raise YamlError(line, f"the key {name} twice", "each key once", "remove or rename one")
        lines[*where, name] = line
        data[name] = _value(value, (*where, name), lines, seen, loader)
    return data


def _line(mark: Any) -> int:
    return mark.line + 1 if mark else 1
