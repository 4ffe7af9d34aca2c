"""YAML with the line of every field."""

from __future__ import annotations

import pytest
from clinic.record.yaml_lines import Where, YamlError, dotted, read_yaml

TEXT = """\
number: 1
run:
  duration: 2
fixes:
  - id: a
    edits:
      - {find: x, replace: y}
  - id: b
prose: |
  two
  lines
last: 1
"""


def test_data_is_what_the_text_says() -> None:
    data, _ = read_yaml(TEXT)
    assert data["fixes"][0] == {"id": "a", "edits": [{"find": "x", "replace": "y"}]}
    assert data["prose"] == "two\nlines\n"


@pytest.mark.parametrize("key", ["on", "no", "1", "2.0", "null", "~", "2024-01-02"])
def test_keys_are_the_text_that_stands_there(key: str) -> None:
    data, lines = read_yaml(f"a: 1\nb: {{{key}: 2}}\n")
    assert data == {"a": 1, "b": {key: 2}}
    assert lines.at(("b", key)) == 2


@pytest.mark.parametrize(
    ("where", "line"),
    [
        pytest.param(("number",), 1, id="top"),
        pytest.param(("run", "duration"), 3, id="nested"),
        pytest.param(("fixes", 0), 5, id="item"),
        pytest.param(("fixes", 0, "edits", 0, "replace"), 7, id="flow-style"),
        pytest.param(("fixes", 1, "id"), 8, id="second-item"),
        pytest.param(("last",), 12, id="after-a-block-of-text"),
        pytest.param(("run", "keyframe"), 2, id="absent-field-has-its-parents-line"),
        pytest.param(("fixes", 7, "id"), 4, id="absent-item-has-the-lists-line"),
        pytest.param(("title",), 1, id="absent-at-the-top"),
        pytest.param((), 1, id="the-document"),
    ],
)
def test_line_of_a_field(where: Where, line: int) -> None:
    assert read_yaml(TEXT)[1].at(where) == line


def test_a_document_that_starts_late_has_its_own_line() -> None:
    _, lines = read_yaml("# a comment\n\n---\nnumber: 1\n")
    assert lines.at(("number",)) == 4


@pytest.mark.parametrize(
    ("where", "text"),
    [
        pytest.param((), "", id="document"),
        pytest.param(("run",), "run", id="field"),
        pytest.param(("fixes", 0, "edits", 2, "find"), "fixes[0].edits[2].find", id="nested"),
    ],
)
def test_dotted(where: Where, text: str) -> None:
    assert dotted(where) == text


@pytest.mark.parametrize(
    ("text", "line", "found"),
    [
        pytest.param("a: 1\nb: {c: 1,\n    c: 2}\n", 3, "the key c twice", id="key-twice"),
        pytest.param("a: &x 1\nb: *x\n", 2, "a value that stands elsewhere", id="alias"),
        pytest.param("a: &x [*x]\n", 1, "a value that stands elsewhere", id="alias-of-itself"),
        pytest.param("b: 0\na:\n  - [b]\n   - c\n", 4, "did not find expected", id="list-out-of-line"),
        pytest.param("a: b: c\n", 1, "mapping values are not allowed", id="colon-in-plain-text"),
        pytest.param("a: 1\n\tb: 2\n", 2, "a tab", id="tab"),
        pytest.param("a: 1\n? [b, c]\n: 2\n", 2, "a key that is no text", id="list-as-a-key"),
        pytest.param("# nothing\n", 1, "no mapping", id="only-a-comment"),
        pytest.param("- a\n- b\n", 1, "no mapping", id="list"),
        pytest.param("a: 1\nb: \x07\n", 2, "text that YAML cannot hold: control characters", id="bell"),
        pytest.param("a: !!python/name:os.system\n", 1, "could not determine a constructor", id="python-object"),
    ],
)
def test_refused(text: str, line: int, found: str) -> None:
    with pytest.raises(YamlError) as caught:
        read_yaml(text)
    assert caught.value.line == line
    assert caught.value.found.startswith(found)


@pytest.mark.parametrize("number", ["0", "-0", "+1", "10", "1.", "-0.5", "1e3", "1.0e-3", "2.5E+7", ".5"])
def test_a_number(number: str) -> None:
    assert read_yaml(f"a: {number}")[0] == {"a": float(number)}


@pytest.mark.parametrize("text", ["012", "0x1F", "1_000", "1:30", "2024-01-02", "2024-13-45", "yes", "off", "1e"])
def test_text_that_looks_like_something_else(text: str) -> None:
    assert read_yaml(f"a: {text}")[0] == {"a": text}


@pytest.mark.parametrize(("text", "value"), [("true", True), ("false", False), ("null", None), ("~", None), ("", None)])
def test_a_word_of_yaml(text: str, value: bool | None) -> None:
    assert read_yaml(f"a: {text}")[0] == {"a": value}
