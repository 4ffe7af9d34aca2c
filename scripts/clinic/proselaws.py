"""Law 5: what prose says is measured. Numbers come from the runs, quotations from the files."""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.case import Case
from clinic.evidence import Evidence
from clinic.formula import FORMULA
from clinic.inert import CODE
from clinic.prose import FIELD
from clinic.variant import variants

PROSE = ("symptom", "diagnosis", "cause", "fix", "lesson")
SPAN = re.compile(r"`([^`]+)`")
ATTRIBUTE = re.compile(r'[a-z_]+="[^"]*"')
UNIT = (
    r"(?:°|%|[km]?m|cm|k?g|[mµ]?s|[mk]?N|rad|deg|Hz|J|W|degrees?|radians?|seconds?|milliseconds?|metres?|millimetres?)"
)
TYPED = re.compile(rf"(?<![\w.])\d+(?:\.\d+)?[\s\u00a0]?{UNIT}(?!\w)")


def quoted(case: Case, evidence: Evidence) -> Iterator[str]:
    """Law 5, first half. Each attribute quoted in prose stands in the text of some variant."""
    texts = [variant.text for variant in variants(case)] + list(case.texts.values())
    for where, text in prose_of(case):
        for attribute in (found for span in SPAN.findall(text) for found in ATTRIBUTE.findall(span)):
            if not any(attribute in known for known in texts):
                yield f"{where}: quotes {attribute}, which no variant has; correct the quotation"


def typed(case: Case, evidence: Evidence) -> Iterator[str]:
    """Law 5, second half. No number with a unit is typed by hand; a run could have given it."""
    for where, text in prose_of(case):
        for found in TYPED.findall(FORMULA.sub("", FIELD.sub("", CODE.sub("", text)))):
            yield f"{where}: {found.strip()!r} is typed by hand; write a field such as {{{{ broken.signal.final }}}}"


def prose_of(case: Case) -> Iterator[tuple[str, str]]:
    """Every prose field of the record with its place."""
    for name in PROSE:
        yield name, getattr(case.record, name)
    for remedy in case.record.refuted:
        yield f"refuted {remedy.id}", remedy.why
    for name, sweep in case.record.sweep.items():
        yield f"sweep {name}", sweep.text
