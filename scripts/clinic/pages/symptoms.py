"""Finding a case by its symptom: the list of the families, and a page of each that has a case."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from clinic.diagnosis.rules import rules
from clinic.pages.case_page import value_in
from clinic.pages.cases import CasePage, Differentials
from clinic.pages.text.template import render
from clinic.proof.procedure import Answer, members
from clinic.record.families import families
from clinic.work.cache import Files

PAGE = "symptoms/{family}.md"


def symptom_pages(shown: Sequence[CasePage], told: Differentials) -> Files:
    """The list of the families, and the page of each that has a case."""
    by_slug = {one.case.slug: one for one in shown}
    own = {name: [by_slug[case.slug] for case in members(name, [one.case for one in shown])] for name in families()}
    others = [one for one in shown if one.case.record.family is None]
    scripts = {name for name, found in told.items() if found and found.code}
    listed = render("symptoms", families=families(), own=own, others=others, scripts=scripts)
    made = {"symptoms.md": listed.encode()}
    for name, causes in own.items():
        if causes:
            made[PAGE.format(family=name)] = _page(name, causes, told).encode()
    return made


def _page(name: str, causes: list[CasePage], told: Differentials) -> str:
    found = told[name]
    measured = [one for one in causes if found and one.case.slug in found.answers]
    return render(
        "family",
        symptom=name,
        family=families()[name],
        causes=causes,
        code=found.code if found else "",
        measured=measured,
        matrix=[_row(one, measured, found.answers) for one in measured] if found else [],
        printed=found.answers[measured[0].case.slug].printed if found and measured else "",
        rules=sorted(
            (rule for rule in rules().values() if name in rule.families),
            key=lambda rule: (rule.level == "hint", -rule.odds),
        ),
    )


def _row(row: CasePage, columns: list[CasePage], answers: Mapping[str, Answer]) -> dict[str, Any]:
    """What the measurement of one case gives for the broken model of each."""
    tells = row.case.record.telling
    assert tells is not None
    cells = [value_in(answers[column.case.slug], row.case.slug) for column in columns]
    return {"case": row.case, "unit": tells.unit, "cells": cells}
