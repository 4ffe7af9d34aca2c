"""Formulas: LaTeX set as MathML."""

from __future__ import annotations

from functools import lru_cache

import latex2mathml.converter

from clinic.pages.text.markup import escaped


class FormulaError(ValueError):
    """A formula that cannot be set: what was found, expected, and the repair."""

    def __init__(self, source: str, reason: str) -> None:
        self.found, self.expected = f"${source}$: {reason}", "a LaTeX formula"
        self.repair = "correct it; in text write \\lt for < and a formula's braces in pairs"
        super().__init__(source, reason)

    def __str__(self) -> str:
        return self.found


@lru_cache(4096)
def mathml(source: str, display: str) -> str:
    """One formula, as a `block` or `inline`, with nothing in it that Markdown would take for its own.

    Raises:
        FormulaError: If it is no LaTeX.
    """
    source = " ".join(source.split())
    try:
        made: str = latex2mathml.converter.convert(source, display=display)
    except Exception as error:  # the converter raises many kinds
        raise FormulaError(source, str(error) or type(error).__name__) from None
    return escaped(made)
