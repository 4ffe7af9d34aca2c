"""What the page says to a text that was judged: what a check guards, and why a remedy does not help."""

from __future__ import annotations

import re
from typing import Any

from clinic.pages.text.prose import fill
from clinic.proof.evidence import Evidence
from clinic.record.case import Case
from clinic.record.fields import Refuted

QUOTED_FORMULA = re.compile(r"\$\{\{\s*formula\.(?P<name>\w+)\.(?P<side>left|right)\s*\}\}\$")


def guards(case: Case, evidence: Evidence) -> list[dict[str, Any]]:
    """Of every check of a repair, whether the broken model fails it, and which remedies that do not help fail it."""
    failing = {
        name: [not result.holds for result in variant.checks["fixed"]] for name, variant in evidence.variants.items()
    }
    return [
        {
            "symptom": failing["broken"][k],
            "against": [remedy.title for remedy in case.record.refuted if failing[remedy.id][k]],
        }
        for k in range(len(case.record.checks.fixed))
    ]


def why(case: Case, remedy: Refuted, evidence: Evidence) -> str:
    """Why a remedy does not help: text with code between backticks; a formula is written as in the record."""

    def written(match: re.Match[str]) -> str:
        sides = re.split(r"[=~<>]", case.record.formulas[match["name"]].says)
        return f"`{sides[match['side'] == 'right'].strip()}`"

    text = fill(QUOTED_FORMULA.sub(written, remedy.why), evidence, case)
    return " ".join(re.sub(r"\$([^$]+)\$|\*([^*]+)\*|\[([^\]]+)\]\([^)]*\)", r"\1\2\3", text).split())
