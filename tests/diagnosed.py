"""What the rules find in a model's text, and whether their edits mend it."""

from __future__ import annotations

from typing import Any

from clinic.diagnosis.diagnose import examine
from clinic.diagnosis.edit import apply
from clinic.diagnosis.finding import Diagnosis, Finding
from clinic.diagnosis.native import NativeEngine

FILE = "model.xml"


def diagnosed(text: str, *rules: str, **options: Any) -> Diagnosis:
    """The diagnosis of a text, by these rules or by all."""
    return examine(NativeEngine(), {FILE: text}, select=rules, **options)


def findings(text: str, *rules: str, **options: Any) -> list[Finding]:
    """Causes, then hints. The edit of each takes it away, and brings no other of its rule."""
    found = diagnosed(text, *rules, **options)
    told = [*found.causes, *found.hints]
    for each in told:
        if each.edit:
            again = diagnosed(with_edits(text, each), each.rule, **options)
            left = [(one.rule, one.elements) for one in (*again.causes, *again.hints)]
            others = [(one.rule, one.elements) for one in told if one is not each]
            assert all(one in others for one in left), again.text()
    return told


def causes(text: str, *rules: str, **options: Any) -> list[Finding]:
    """The causes among the findings."""
    return [each for each in findings(text, *rules, **options) if each.level == "cause"]


def hints(text: str, *rules: str, **options: Any) -> list[Finding]:
    """The hints among the findings."""
    return [each for each in findings(text, *rules, **options) if each.level == "hint"]


def with_edits(text: str, *found: Finding) -> str:
    """The text after the edits of findings."""
    return apply({FILE: text}, [edit for each in found for edit in each.edit])[FILE]


def mended(text: str) -> Diagnosis:
    """The diagnosis of a text that compiles after its edits."""
    found = diagnosed(text)
    assert not diagnosed(found.fixed[FILE]).error
    return found
