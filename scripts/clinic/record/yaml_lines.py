"""YAML read safely, with the line of every field."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import yaml

Where = tuple[str | int, ...]
MAX_DEPTH = 20
CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u2028-\u202e\u2066-\u2069\ud800-\udfff\ufffe\uffff]")
"""Characters that no text needs: controls but for tab and line feed, and those that turn the reading direction."""

DECIMAL = re.compile(r"[-+]?(?:(?:0|[1-9]\d*)(?:\.\d*)?|\.\d+)(?:[eE][-+]?\d+)?|[-+]?\.(?:inf|nan)", re.IGNORECASE)
FAST = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


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
        YamlError: For a syntax error, an alias, a tag, a key given twice, a character that cannot be
            shown, more than MAX_DEPTH levels, or a document that is no mapping.
    """
    try:
        return _read(text, FAST)
    except yaml.YAMLError:
        pass  # said again in the words of the loader that every machine has
    try:
        return _read(text, yaml.SafeLoader)
    except yaml.MarkedYAMLError as error:
        line = _line(error.problem_mark or error.context_mark)
        found, repair = (
            str(error.problem or error.context),
            "quote text that holds `: `, `#`, `{` or `[`; indent by two spaces",
        )
        if "\t" in text.split("\n")[line - 1]:
            found, repair = "a tab", "write spaces in its place"
        elif found.startswith("expected <block end>"):
            begun = f" in line {_line(error.context_mark)}" if error.context_mark else ""
            found, repair = f"a line that does not go on with what began{begun}", "indent it like those it belongs to"
        raise YamlError(line, found, "valid YAML", repair) from None
    except yaml.reader.ReaderError as error:
        line = text.count("\n", 0, error.position) + 1
        raise YamlError(line, named(chr(error.character)), "text that can be read", "delete it") from None


def _read(text: str, loader: Any) -> tuple[Any, Lines]:
    depth = 0
    for event in yaml.parse(text, Loader=loader):
        depth += _step(event)
        if depth > MAX_DEPTH:
            raise YamlError(_line(event.start_mark), "a list in a list in ...", f"{MAX_DEPTH} levels", "flatten it")
    node = yaml.compose(text, Loader=loader)
    if not isinstance(node, yaml.MappingNode):
        raise YamlError(1, "no mapping", "`field: value` lines", "start with `number:` and `title:`")
    by_path: dict[Where, int] = {}
    _walk(node, (), by_path)
    return _plain(node, yaml.SafeLoader("")), Lines(by_path, text)


def _step(event: yaml.Event) -> int:
    """How much deeper the event leads; refuses what makes a value of something else than what stands there."""
    line = _line(event.start_mark)
    if isinstance(event, yaml.AliasEvent):
        raise YamlError(line, f"the alias *{event.anchor}", "no aliases", "write the value out")
    if isinstance(event, yaml.ScalarEvent | yaml.CollectionStartEvent) and event.tag is not None:
        raise YamlError(line, f"the tag {event.tag}", "no tags", "remove it")
    return isinstance(event, yaml.CollectionStartEvent) - isinstance(event, yaml.CollectionEndEvent)


def _plain(node: yaml.Node, loader: yaml.SafeLoader) -> Any:
    """The node as data; a scalar that cannot be what it looks like is refused at its line."""
    if isinstance(node, yaml.MappingNode):
        return {key.value: _plain(value, loader) for key, value in node.value}
    if isinstance(node, yaml.SequenceNode):
        return [_plain(value, loader) for value in node.value]
    try:
        value = loader.construct_object(node)
        if type(value) in (int, float) and not DECIMAL.fullmatch(node.value):
            raise YamlError(
                _line(node.start_mark), f"{node.value}, read as {value}", "a decimal number", "write its digits plainly"
            )
        json.dumps(value, default=str)  # fails for a whole number of thousands of digits
        return value
    except (ValueError, TypeError, OverflowError) as error:
        found = f"{node.value[:40]}: {str(error).splitlines()[0]}"
        raise YamlError(_line(node.start_mark), found, "plain values", "quote text that looks like a date") from None


def _walk(node: yaml.Node, where: Where, by_path: dict[Where, int]) -> None:
    by_path.setdefault(where, _line(node.start_mark))
    if isinstance(node, yaml.ScalarNode):
        _shown(node)
    if isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            if not isinstance(key, yaml.ScalarNode):
                raise YamlError(
                    _line(key.start_mark), "a key that is no text", "`field: value` lines", "write one word"
                )
            _shown(key)
            if "\n" in key.value:
                raise YamlError(
                    _line(key.start_mark), "a key of several lines", "`field: value` lines", "write one word"
                )
            path = (*where, key.value)
            if path in by_path:
                raise YamlError(
                    _line(key.start_mark), f"the key {key.value} twice", "each key once", "remove or rename one"
                )
            by_path[path] = _line(key.start_mark)
            _walk(value, path, by_path)
    elif isinstance(node, yaml.SequenceNode):
        for index, value in enumerate(node.value):
            _walk(value, (*where, index), by_path)


def _shown(node: yaml.ScalarNode) -> None:
    if strange := CONTROL.search(node.value):
        raise YamlError(_line(node.start_mark), named(strange[0]), "text that can be read", "delete it")


def _line(mark: Any) -> int:
    return mark.line + 1 if mark else 1
