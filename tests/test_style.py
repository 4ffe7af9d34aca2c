"""Prose that readers see: no word that fills a line, belittles a trouble or praises."""

from __future__ import annotations

import re
from pathlib import Path

PLACES = (
    "*.md",
    "docs/**/*.md",
    "cases/*/case.yaml",
    "scripts/clinic/pages/templates/*.j2",
    "scripts/clinic/pages/*.yaml",
)
RULES = "scripts/clinic/diagnosis/rules/*/*.py"  # whose docstrings are pages
IDLE = re.compile(
    r"\b(simply|obviously|of course|utili[sz]e[sd]?|leverag(e|es|ed|ing)|note that|basically|in order to|"
    r"seamless(ly)?|powerful|robustly|delve|state[- ]of[- ]the[- ]art|e\.g\.|i\.e\.|etc\.)(?!\w)|—",
    re.IGNORECASE,
)


def idle(text: str) -> list[str]:
    """The lines with such a word, by number."""
    lines = enumerate(text.splitlines(), start=1)
    return [
        f"{number}: {found[0]!r} says nothing: {line.strip()}" for number, line in lines if (found := IDLE.search(line))
    ]


def test_no_idle_word(root: Path) -> None:
    files = sorted(path for place in (*PLACES, RULES) for path in root.glob(place) if path.name != "LICENSE")
    assert len(files) > 50
    wrong = [f"{path.relative_to(root)}:{line}" for path in files for line in idle(path.read_text(encoding="utf-8"))]
    assert not wrong, "\n".join(wrong)


def test_an_idle_word_is_found() -> None:
    assert idle("The fix:\nYou simply raise it.") == ["2: 'simply' says nothing: You simply raise it."]
    assert not idle("The simplest repair.")
