"""YAML read safely, with the line of every field."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import yaml

Where = tuple[str | int, ...]


@dataclass
class YamlError(Exception):
    """YAML that is refused: `line` counts from 1."""

    line: int
    found: str
    expected: str
    repair: str


@dataclass(frozen=True)
class Lines:
    """The line, counted from 1, of every field by its path."""

    by_path: dict[Where, int]

    def at(self, where: Where) -> int:
        """The line of the field, or of its nearest ancestor that stands in the file."""
        while where and where not in self.by_path:
            where = where[:-1]
        return self.by_path.get(where, 1)


class TextKeys(yaml.SafeLoader):
    """Reads every key as the text that stands there: `on` is not True."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
        """The mapping, its keys being text."""
        for key, _ in node.value:
            key.tag = "tag:yaml.org,2002:str"
        return super().construct_mapping(node, deep)


def dotted(where: Where) -> str:
    """`("fixes", 0, "id")` as `fixes[0].id`."""
    text = ""
    for part in where:
        text += f"[{part}]" if isinstance(part, int) else f".{part}" if text else part
    return text


def read_yaml(text: str) -> tuple[Any, Lines]:
    """The document's data and the line of each of its fields.

    Raises:
        YamlError: For a syntax error, an alias, a key given twice, or a document that is no mapping.
    """
    try:
        for event in yaml.parse(text, Loader=yaml.SafeLoader):
            if isinstance(event, yaml.AliasEvent):
                raise YamlError(
                    _line(event.start_mark), f"the alias *{event.anchor}", "no aliases", "write the value out"
                )
        node = yaml.compose(text, Loader=yaml.SafeLoader)
        if not isinstance(node, yaml.MappingNode):
            raise YamlError(1, "no mapping", "`field: value` lines", "start with `number:` and `title:`")
        by_path: dict[Where, int] = {}
        _walk(node, (), by_path)
        return yaml.load(text, Loader=TextKeys), Lines(by_path)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        raise YamlError(
            _line(mark),
            str(error.problem or error.context),
            "valid YAML",
            "quote text that holds `: `, `#`, `{` or `[`; indent by two spaces",
        ) from None
    except yaml.YAMLError as error:
        raise YamlError(1, str(error).splitlines()[0], "valid YAML", "remove the characters named") from None
    except (ValueError, TypeError, RecursionError) as error:
        raise YamlError(1, str(error).splitlines()[0], "plain values", "quote text that looks like a date") from None


def _walk(node: yaml.Node, where: Where, by_path: dict[Where, int]) -> None:
    by_path.setdefault(where, _line(node.start_mark))
    if isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            if not isinstance(key, yaml.ScalarNode):
                raise YamlError(
                    _line(key.start_mark), "a key that is no text", "`field: value` lines", "write one word"
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


def _line(mark: Any) -> int:
    return mark.line + 1 if mark else 1
