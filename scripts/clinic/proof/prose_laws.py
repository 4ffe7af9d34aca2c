"""Law 5: what prose says is measured. Numbers come from the runs, quotations from the files."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from clinic.engine.variant import variants
from clinic.record.case import Case
from clinic.record.problem import Problem
from clinic.record.prose import CODE, FIELD, FORMULA
from clinic.record.yaml_lines import Where

if TYPE_CHECKING:
    from clinic.proof.evidence import Evidence

PROSE = ("symptom", "diagnosis", "cause", "fix", "lesson")
SPAN = re.compile(r"`([^`]+)`")
ATTRIBUTE = re.compile(r'[a-z_]+="[^"]*"')
UNIT = (
    r"(?:°|%|[km]?m|cm|k?g|[mµ]?s|[mk]?N|rad|deg|Hz|J|W|degrees?|radians?|seconds?|milliseconds?|metres?|millimetres?)"
)
TYPED = re.compile(rf"(?<![\w.])\d+(?:\.\d+)?[\s\u00a0]?{UNIT}(?!\w)")


def quoted(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, first half. Each attribute quoted in prose stands in the text of some variant."""
    texts = [variant.text for variant in variants(case)] + list(case.texts.values())
    for where, attribute in quotations(case):
        if not any(attribute in known for known in texts):
            wanted, repair = "an attribute that some variant has", "correct the quotation"
            yield case.problem(where, attribute, wanted, repair, quoted=attribute)


def typed(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, second half. No number with a unit is typed by hand; a run could have given it."""
    for where, text in prose_of(case):
        for found in TYPED.findall(FORMULA.sub("", FIELD.sub("", CODE.sub("", text)))):
            repair = "write a field such as {{ broken.signal.final }}"
            number = found.strip()
            yield case.problem(where, f"{number!r}, typed by hand", "what a run gave", repair, quoted=number)


def quotations(case: Case) -> Iterator[tuple[Where, str]]:
    """Every attribute quoted in prose with the field's place."""
    for where, text in prose_of(case):
        yield from ((where, found) for span in SPAN.findall(text) for found in ATTRIBUTE.findall(span))


def prose_of(case: Case) -> Iterator[tuple[Where, str]]:
    """Every prose field of the record with its place."""
    for name in PROSE:
        yield (name,), getattr(case.record, name)
    for index, remedy in enumerate(case.record.refuted):
        yield ("refuted", index, "why"), remedy.why
    for name, sweep in case.record.sweep.items():
        yield ("sweep", name, "text"), sweep.text
