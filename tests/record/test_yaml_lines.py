"""YAML with the line of every field."""

from __future__ import annotations

import pytest
from clinic.record.yaml_lines import Lines, Where, YamlError, dotted, read_yaml

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
        pytest.param("a: &x 1\nb: *x\n", 2, "the alias *x", id="alias"),
        pytest.param("a: 1\n- b\n", 2, "a line that does not go on with what began in line 1", id="syntax"),
        pytest.param("a: b: c\n", 1, "mapping values are not allowed here", id="colon-in-plain-text"),
        pytest.param("a: 1\n\tb: 2\n", 2, "a tab", id="tab"),
        pytest.param("a: 1\n? [b, c]\n: 2\n", 2, "a key that is no text", id="list-as-a-key"),
        pytest.param("a: [\n  1\n" + "b: {c: 2}\n - d\n", 3, None, id="list-not-closed"),
        pytest.param("a:\n  - [b]\n   - c\n", 3, "a line that does not go on with what began in line 2", id="three"),
        pytest.param('"a\\nb": 1\n', 1, "a key of several lines", id="key-of-two-lines"),
        pytest.param("", 1, "no mapping", id="empty"),
        pytest.param("# nothing\n", 1, "no mapping", id="only-a-comment"),
        pytest.param("- a\n- b\n", 1, "no mapping", id="list"),
        pytest.param("text\n", 1, "no mapping", id="scalar"),
        pytest.param("a: 2024-13-45\n", 1, None, id="impossible-date"),
        pytest.param("a: \x07\n", 1, "the character U+0007", id="bell"),
        pytest.param("a: 1\nb: [1:30]\n", 2, "1:30, read as 90", id="to-base-60"),
        pytest.param("a: 012\n", 1, "012, read as 10", id="to-base-8"),
        pytest.param("a: 0x1F\n", 1, "0x1F, read as 31", id="to-base-16"),
        pytest.param("a: 1_000.5\n", 1, "1_000.5, read as 1000.5", id="underscore"),
        pytest.param("a: !!python/name:os.system\n", 1, None, id="python-object"),
    ],
)
def test_refused(text: str, line: int, found: str | None) -> None:
    with pytest.raises(YamlError) as caught:
        read_yaml(text)
    assert caught.value.line == line
    if found is not None:
        assert caught.value.found == found


@pytest.mark.parametrize("number", ["0", "-0", "+1", "10", "1.", "-0.5", "1.0e-3", "2.5E+7", ".5"])
def test_a_decimal_number(number: str) -> None:
    assert read_yaml(f"a: {number}")[0] == {"a": float(number)}


def test_lines_of_nothing_are_the_first() -> None:
    assert Lines({}).at(("a", 0)) == 1
