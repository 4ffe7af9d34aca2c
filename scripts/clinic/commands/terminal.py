"""What the commands print: tables of cases and judgements, and a case as a page to read."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

from rich.console import Console, Group, RenderableType
from rich.markdown import Markdown
from rich.padding import Padding
from rich.rule import Rule
from rich.syntax import Syntax
from rich.table import Table
from rich.text import Text

from clinic.engine.variant import diff, variants
from clinic.pages.text.claim import claim
from clinic.pages.text.prose import fill
from clinic.proof.evidence import Evidence, VariantEvidence
from clinic.record.case import Case
from clinic.record.fields import Check
from clinic.record.prose import quantity

if TYPE_CHECKING:
    from clinic.commands.judgement import Judgement

WIDTH = 120
KINDS = ("broken", "fixed")
MEANS = {"broken": "it is broken", "fixed": "it is well"}
WANTED = {
    "broken": {"broken": True, "fixed": False},
    "fix": {"broken": False, "fixed": True},
    "refuted": {"fixed": False},
}
FOLDS = ("diagnosis", "cause", "fix", "lesson")


def console(stderr: bool = False) -> Console:
    """The terminal, or WIDTH columns where there is none."""
    stream = sys.stderr if stderr else sys.stdout
    return Console(file=stream, width=None if stream.isatty() else WIDTH, highlight=False)


def cases_table(cases: Iterable[Case]) -> Table:
    """Every case in a row."""
    table = Table("number", "slug", "title", "tags")
    table.columns[0].justify = "right"
    for case in cases:
        table.add_row(str(case.record.number), case.slug, Text(case.record.title), ", ".join(case.record.tags))
    return table


def summary(judgements: Iterable[Judgement]) -> Table:
    """Every judgement in a row."""
    table = Table("number", "slug", "variants", "checks", "result")
    table.columns[0].justify = "right"
    for judgement in judgements:
        made = judgement.evidence.variants.values() if judgement.evidence else ()
        checks = sum(len(results) for variant in made for results in variant.checks.values())
        number = str(judgement.case.record.number) if judgement.case else ""
        table.add_row(number, judgement.slug, str(len(made) or ""), str(checks or ""), result(judgement))
    return table


def result(judgement: Judgement) -> Text:
    """The judgement in a word or two."""
    if judgement.sound:
        return Text("sound", "green")
    parts = [counted(len(judgement.problems), "mistake"), counted(len(judgement.breaches), "broken law")]
    return Text(", ".join(part for part in parts if part), "red")


def counted(count: int, noun: str) -> str:
    """`2 mistakes`; empty for none."""
    return f"{count} {noun}{'s' if count > 1 else ''}" if count else ""


def checks_table(case: Case, evidence: Evidence) -> Table:
    """Every check of every variant, with what was measured."""
    table = Table("variant", "asks whether", "check", "measured", "holds", title=heading(case), title_justify="left")
    for key, variant in evidence.variants.items():
        rows = list(_rows(case, variant))
        for k, (kind, check, measured, holds) in enumerate(rows):
            name = Text(key) if k == 0 else Text(f"  {variant.kind}" if k == 1 and variant.kind != key else "")
            asked = MEANS[kind] if k == 0 or rows[k - 1][0] != kind else ""
            wanted = WANTED[variant.kind].get(kind) is True
            word = (
                Text("yes", "green" if wanted else "")
                if holds
                else Text("no, must" if wanted else "no", "red" * wanted)
            )
            table.add_row(name, asked, Text(claim(case, check)), measured, word, end_section=k == len(rows) - 1)
    return table


def heading(case: Case) -> Text:
    """The case's number and title."""
    return Text(f"{case.record.number}. {case.record.title}", "bold")


def case_text(case: Case, evidence: Evidence, answer: bool) -> Group:
    """The case to read: the symptom, and the folds if `answer` is asked for.

    Raises:
        FieldError: If a field of the prose resolves to nothing.
    """
    record = case.record
    said = fill(record.symptom, evidence)
    tags = Text(f"{', '.join(record.tags)}   cases/{case.slug}/", "dim")
    parts: list[RenderableType] = [heading(case), tags, Text(), Markdown(said)]
    if not answer:
        closed = ", ".join(fold.capitalize() for fold in FOLDS)
        return Group(*parts, Text(), Text(f"Folded: {closed}. Open them with --answer.", "dim"))
    for fold in FOLDS:
        parts += [Text(), Rule(fold.capitalize(), align="left"), Markdown(fill(getattr(record, fold), evidence))]
        if fold == "diagnosis" and record.snippet:
            printed = Text(f"It prints:\n{(evidence.snippet or '').rstrip()}")
            parts += [
                Text(),
                Padding(Syntax(record.snippet.rstrip(), record.language, word_wrap=True), (0, 2)),
                Text(),
                printed,
            ]
        if fold == "cause":
            for sweep in record.sweep.values():
                parts += [Text(), Markdown(f"**{sweep.title}.** {fill(sweep.text, evidence)}")]
        if fold == "fix":
            parts += list(_remedies(case, evidence))
    return Group(*parts)


def case_data(case: Case, evidence: Evidence, answer: bool) -> dict[str, Any]:
    """The case as data: the public form of `clinic show --json`. Without `answer` the folds are left out.

    Raises:
        FieldError: If a field of the prose resolves to nothing.
    """
    record = case.record
    made: dict[str, Any] = {**row_data(case), "symptom": fill(record.symptom, evidence)}
    if not answer:
        return made
    made |= {fold: fill(getattr(record, fold), evidence) for fold in FOLDS}
    made |= {"snippet": record.snippet, "printed": evidence.snippet, "see": record.see}
    texts = {variant.id: variant.text for variant in variants(case)}
    for kind, remedies in (("fixes", record.fixes), ("refuted", record.refuted)):
        made[kind] = [
            {"id": remedy.id, "title": remedy.title, "diff": diff(case.text, texts[remedy.id], record.source)}
            | ({"why": fill(why, evidence)} if (why := getattr(remedy, "why", "")) else {})
            for remedy in remedies
        ]
    return made


def row_data(case: Case) -> dict[str, Any]:
    """What `clinic list --json` says of a case."""
    return {"number": case.record.number, "case": case.slug, "title": case.record.title, "tags": case.record.tags}


def _remedies(case: Case, evidence: Evidence) -> Iterator[RenderableType]:
    whys = {remedy.id: fill(remedy.why, evidence) for remedy in case.record.refuted}
    for variant in variants(case)[1:]:
        sign = "✓" if variant.kind == "fix" else "✗ does not work:"
        yield from (Text(), Text(f"{sign} {variant.title} ({variant.id})", "bold"))
        yield Padding(Syntax(diff(case.text, variant.text, case.record.source), "diff", word_wrap=True), (0, 2))
        if variant.id in whys:
            yield Markdown(whys[variant.id])


def _rows(case: Case, variant: VariantEvidence) -> Iterator[tuple[str, Check, str, bool]]:
    for kind in KINDS:
        checks: list[Check] = getattr(case.record.checks, kind)
        for check, found in zip(checks, variant.checks[kind], strict=True):  # type: ignore[index]
            unit = "s" if check.take == "onset" else variant.traces[check.signal].unit
            yield kind, check, "nothing" if found.measured is None else quantity(found.measured, unit, 4), found.holds
