"""What the commands print: tables of cases and of what was found about them, and a case as a page to read."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from rich.markdown import Markdown
from rich.table import Column, Table
from rich.text import Text

from clinic.engine.variant import diff, variants
from clinic.pages.text.claim import claim
from clinic.pages.text.markup import fence, line
from clinic.pages.text.prose import fill
from clinic.proof.evidence import Evidence
from clinic.record.case import Case
from clinic.record.prose import quantity

if TYPE_CHECKING:
    from clinic.commands.check import Report

MEANS = {"broken": "it is broken", "fixed": "it is well"}
WANTED = {"broken": "broken", "fix": "fixed", "refuted": ""}  # which checks must all hold, by kind of variant
FOLDS = ("diagnosis", "cause", "fix", "lesson")


def cases_table(cases: Iterable[Case]) -> Table:
    """Every case in a row."""
    table = Table(Column("number", justify="right"), "slug", "title", "tags")
    for case in cases:
        table.add_row(str(case.record.number or ""), case.slug, Text(case.record.title), ", ".join(case.record.tags))
    return table


def reports_table(reports: Iterable[Report]) -> Table:
    """Every report in a row."""
    table = Table(Column("number", justify="right"), "slug", "variants", "checks", "result")
    for report in reports:
        made = report.evidence.variants.values() if report.evidence else ()
        checks = sum(len(results) for variant in made for results in variant.checks.values())
        number = str(report.case.record.number or "") if report.case else ""
        counts = {"mistake": len(report.problems), "broken law": len(report.breaches)}
        wrong = ", ".join(f"{count} {noun}{'s' * (count > 1)}" for noun, count in counts.items() if count)
        lacking = f": no {' and no '.join(report.case.lacking)}" if report.grade == "B" and report.case else ""
        result = Text(wrong, "red") if wrong else Text(f"sound, grade {report.grade}{lacking}", "green")
        table.add_row(number, report.slug, str(len(made) or ""), str(checks or ""), result)
    return table


def checks_table(case: Case, evidence: Evidence) -> Table:
    """Every check of every variant, with what was measured."""
    title = Text(case.record.heading, "bold")
    table = Table("variant", "asks whether", "check", "measured", "holds", title=title, title_justify="left")
    for key, variant in evidence.variants.items():
        name = key if variant.kind == key else f"{key}, {variant.kind}"
        for kind, results in variant.checks.items():
            wanted = kind == WANTED[variant.kind]
            for check, found in zip(getattr(case.record.checks, kind), results, strict=True):
                unit = "s" if check.take == "onset" else variant.traces[check.signal].unit
                measured = "nothing" if found.measured is None else quantity(found.measured, unit, 4)
                if found.holds:
                    word = Text("yes", "green" if wanted else "")
                else:
                    word = Text("no, must", "red") if wanted else Text("no")
                table.add_row(name, MEANS[kind], Text(claim(case, check)), measured, word)
        table.add_section()
    return table


def case_text(case: Case, evidence: Evidence, answer: bool) -> Markdown:
    """The case to read: the symptom, and the folds if `answer` is asked for."""
    data = case_data(case, evidence, answer)
    parts = [f"## {line(case.record.heading)}"]
    parts += [f"*{', '.join(case.record.tags)}* cases/{case.slug}/", data["symptom"]]
    if not answer:
        parts += [f"*Folded: {', '.join(FOLDS)}. Open them with `--answer`.*"]
        return Markdown("\n\n".join(parts))
    for fold in FOLDS:
        parts += [f"### {fold.capitalize()}", data[fold]]
        if fold == "diagnosis" and data["snippet"]:
            parts += [fence(data["snippet"], case.record.language), "It prints:", fence(data["printed"])]
        if fold == "cause":
            parts += [
                f"**{line(sweep.title)}.** {fill(sweep.text, evidence, case)}" for sweep in case.record.sweep.values()
            ]
        if fold == "fix":
            for remedy in data["fixes"] + data["refuted"]:
                sign = "✗ does not work:" if remedy in data["refuted"] else "✓"
                parts += [f"**{sign} {line(remedy['title'])}** ({remedy['id']})", fence(remedy["diff"], "diff")]
                parts += [remedy.get("why", "")]
    return Markdown("\n\n".join(parts))


def case_data(case: Case, evidence: Evidence, answer: bool) -> dict[str, Any]:
    """The case as data: the public form of `clinic show --json`. Without `answer` the folds are left out."""
    record = case.record
    made: dict[str, Any] = {**row_data(case), "symptom": fill(record.symptom, evidence, case)}
    if not answer:
        return made
    made |= {fold: fill(getattr(record, fold), evidence, case) for fold in FOLDS}
    made |= {"snippet": record.snippet, "printed": evidence.snippet, "see": record.see}
    diffs = {variant.id: diff(case.text, variant.text, record.source) for variant in variants(case)}
    for kind, remedies in (("fixes", record.fixes), ("refuted", record.refuted)):
        made[kind] = [{"id": remedy.id, "title": remedy.title, "diff": diffs[remedy.id]} for remedy in remedies]
    for told, remedy in zip(made["refuted"], record.refuted, strict=True):
        told["why"] = fill(remedy.why, evidence, case)
    return made


def row_data(case: Case) -> dict[str, Any]:
    """What `clinic list --json` says of a case."""
    return {"number": case.record.number, "case": case.slug, "title": case.record.title, "tags": case.record.tags}
