"""The rules for a record's words, so that a page shows them and does nothing else.

A title, a label, a unit, a legend or a phrase is one line without `<`. Prose is Markdown: its `<` and `{` are shown as
they are, so that HTML and attribute lists do nothing; its links lead to pages of this site or of the web, its images
to files of this site; its formulas are LaTeX that makes a formula and nothing else.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from clinic.record.fields import Record
from clinic.record.formula import formula_errors
from clinic.record.markup import strange_links
from clinic.record.prose import CODE, FIELD, FORMULA
from clinic.record.yaml_lines import Where

LINES = ("title", "label", "unit", "phrases", "says", "yes", "no")
PROSE = ("symptom", "diagnosis", "cause", "fix", "lesson", "why", "text", "exempt")
LONGEST_LINE, LONGEST_PROSE, MOST_BRACKETS = 300, 5000, 200
MARKS = 10
ROW = re.compile(rf"[][*_!(]{{{MARKS}}}|^ *(?:(?:\d+[.)]|[-*+>]) *){{{MARKS}}}", re.MULTILINE)
TICKS = re.compile(rf"([`~])\1{{{MARKS - 1}}}")
FENCE = re.compile(r" *(`{3,}|~{3,})[^`]*")


def word_problems(record: Record) -> Iterator[tuple[Where, str, str, str]]:
    """Every text of the record that breaks a rule: where, what was found, what was expected, the repair."""
    for where, text in _texts(record.model_dump(mode="json"), ()):
        names = {part for part in where[-2:] if isinstance(part, str)}
        if names & set(LINES):
            if len(text) > LONGEST_LINE:
                yield where, f"{len(text)} characters", f"{LONGEST_LINE} at most", "say it in fewer words"
            elif found := re.search("[<\n]", text.rstrip("\n")):
                shown = "a line break" if found[0] == "\n" else found[0]
                yield (
                    where,
                    f"{shown} in {text.strip()[:40]!r}",
                    "one line of plain text, without <",
                    "write it in words",
                )
        elif names & set(PROSE):
            yield from _prose_problems(where, text)


def _prose_problems(where: Where, text: str) -> Iterator[tuple[Where, str, str, str]]:
    if told := _endless(text):
        yield where, *told
        return
    for error in formula_errors(FIELD.sub("1", text)):
        yield where, error.found, error.expected, error.repair
    for link in strange_links(FORMULA.sub("", text)):
        expected = "an address of the web, https://..., or of a page here; an image from here"
        yield where, link, f"[text](address): {expected}", "correct the address; write code between backticks"


def _endless(text: str) -> tuple[str, str, str] | None:
    """What is found, expected and to do, where reading the text as Markdown would take too long or too deep."""
    if len(text) > LONGEST_PROSE:
        return f"{len(text)} characters", f"{LONGEST_PROSE} at most", "say it in fewer words"
    if (begun := text.rfind("{{")) > text.rfind("}}"):
        return text[begun:].partition("\n")[0][:40], "a field that is closed: {{ ... }}", "close it with }}"
    if ticks := TICKS.search(text):
        return f"{MARKS} times {ticks[1]} in a row", "fewer", "write fewer"
    fence = ""
    for line in text.split("\n"):
        if not fence and (opened := FENCE.fullmatch(line)):
            fence = opened[1]
        elif fence and line.strip(" ") == fence:
            fence = ""
    if fence:
        return f"{fence} that nothing ends", "a block of code that is closed", f"write {fence} on a line after it"
    rest = FORMULA.sub("", CODE.sub("", text))
    if row := ROW.search(rest):
        return f"{row[0]} in a row", "text", "write code between backticks"
    if (count := rest.count("[")) > MOST_BRACKETS:
        return f"{count} times [ outside code", f"{MOST_BRACKETS} at most", "write code between backticks"
    return None


def _texts(value: Any, where: Where) -> Iterator[tuple[Where, str]]:
    if isinstance(value, str):
        yield where, value
    for key, part in value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ():
        yield from _texts(part, (*where, key))
