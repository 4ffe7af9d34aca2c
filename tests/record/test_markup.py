"""Text that is shown and does nothing else."""

from __future__ import annotations

import pytest
from clinic.record.markup import code, fence, harmless, line, strange_links


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        pytest.param("a b", "`a b`", id="plain"),
        pytest.param("qpos[3]", "`qpos[3]`", id="index"),
        pytest.param("two\nlines", "`two lines`", id="lines"),
        pytest.param("<b>", "<code>&lt;b></code>", id="tag"),
        pytest.param("a|b", "<code>a&#124;b</code>", id="bar"),
        pytest.param("a`b", "<code>a&#96;b</code>", id="tick"),
        pytest.param("[a](b)", "<code>&#91;a&#93;(b)</code>", id="link"),
    ],
)
def test_code(text: str, shown: str) -> None:
    assert code(text) == shown


def test_a_fence_is_longer_than_those_inside() -> None:
    assert fence("a\n```\nb\n", "diff") == "````diff\na\n```\nb\n````"


def test_a_line_keeps_code_and_hides_the_rest() -> None:
    assert line("a [b] {c} | `d[0]`\n e\u00a0f") == "a &#91;b&#93; &#123;c&#125; &#124; `d[0]` e\u00a0f"


def test_plain_links_are_left() -> None:
    text = "See [a](https://b.org/c) and [d](../e/index.md#f)."
    assert harmless(text) == text
    assert list(strange_links(text)) == []


def test_other_links_are_text() -> None:
    assert harmless("[a](javascript:b) [c]: d") == "[a]&#40;javascript:b) [c]&#58; d"
    assert list(strange_links("`[a](b:c)` [a](javascript:b)")) == ["[a](javascript:b)"]
