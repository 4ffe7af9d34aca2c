"""YAML read safely, with the line of every field."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import yaml

Where = tuple[str | int, ...]


@dataclass(frozen=True)
class YamlProblem(Exception):
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


def read_yaml(text: str) -> tuple[Any, Lines]:
    """The document's data and the line of each of its fields.

    Raises:
        YamlProblem: For a syntax error, an alias, a key given twice, or a document that is no mapping.
    """
    try:
        for event in yaml.parse(text, Loader=yaml.SafeLoader):
            if isinstance(event, yaml.AliasEvent):
                raise YamlProblem(
                    event.start_mark.line + 1, f"the alias *{event.anchor}", "no aliases", "write the value out"
                )
        node = yaml.compose(text, Loader=yaml.SafeLoader)
        if not isinstance(node, yaml.MappingNode):
            raise YamlProblem(1, "no mapping", "`field: value` lines", "start with `number:` and `title:`")
        by_path: dict[Where, int] = {}
        _walk(node, (), by_path)
        return yaml.safe_load(text), Lines(by_path)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        raise YamlProblem(
            mark.line + 1 if mark else 1,
            str(error.problem or error.context),
            "valid YAML",
            "quote text that holds `: `, `#`, `{` or `[`; indent by two spaces",
        ) from None
    except yaml.YAMLError as error:
        raise YamlProblem(1, str(error).splitlines()[0], "valid YAML", "remove the characters named") from None
    except (ValueError, TypeError, RecursionError) as error:
        raise YamlProblem(1, str(error).splitlines()[0], "plain values", "quote text that looks like a date") from None


def _walk(node: yaml.Node, where: Where, by_path: dict[Where, int]) -> None:
    by_path.setdefault(where, node.start_mark.line + 1)
    if isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            path = (*where, key.value)
            if path in by_path:
                raise YamlProblem(
                    key.start_mark.line + 1, f"the key {key.value} twice", "each key once", "remove or rename one"
                )
            by_path[path] = key.start_mark.line + 1
            _walk(value, path, by_path)
    elif isinstance(node, yaml.SequenceNode):
        for index, value in enumerate(node.value):
            _walk(value, (*where, index), by_path)
