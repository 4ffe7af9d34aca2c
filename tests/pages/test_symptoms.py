"""Finding a case by its symptom: the list of the families, and a page of each."""

from __future__ import annotations

from pathlib import Path

from clinic.pages.case_page import case_page, telling
from clinic.pages.cases import CasePage
from clinic.pages.symptoms import symptom_pages
from clinic.proof.evidence import collect
from clinic.proof.experiments import differential
from clinic.record.families import families
from clinic.work.cache import Cache
from helpers import page_of, tiny_case

STILL = "still: {share-a-bit: No motor.}"
STILL = "still: {share-a-bit: No motor.}"
TELLS = (
    f"family: falls-through\ntelling: {{cause: masks, says: contacts at the start, expr: model.nu, below: 1, {STILL}}}"
)


def test_a_case_without_a_family_stands_at_the_end(tmp_path: Path) -> None:
    pages = symptom_pages([CasePage(tiny_case(tmp_path), "", "It falls.", {})], {None: None})
    listed = pages["symptoms.md"].decode()
    assert "falls through the floor" in listed.partition("## Something else")[2]
    assert listed.count("No case yet.") == len(families())
    assert list(pages) == ["symptoms.md"]


def test_a_family_has_its_causes_the_procedure_and_what_it_prints(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("tags: [contact]", f"tags: [contact]\n{TELLS}"))
    told, problems = differential("falls-through", [case], Cache(tmp_path / "cache"))
    assert problems == []
    evidence = collect(case)
    shown = CasePage(case, "", "It falls.", {}, telling(case, evidence))
    pages = {name: page.decode() for name, page in symptom_pages([shown], {"falls-through": told}).items()}
    listed, page = pages["symptoms.md"], pages["symptoms/falls-through.md"]
    assert "(cases/falling-box/index.md)" in listed.partition("{ #falls-through }")[2].partition("\n## ")[0]
    assert "(symptoms/falls-through.md) A script that measures your model.\n" in listed
    without = symptom_pages([shown], {"falls-through": None})["symptoms.md"].decode()
    assert "(symptoms/falls-through.md) What to look for in your code.\n" in without
    named = "**Masks**, as in [1. A box falls through the floor](../cases/falling-box/index.md#answer)  \n"
    assert f"{named}Contacts at the start: below 1.\n" in page
    assert page.index("{ #rules }") < page.index("{ #procedure }")
    assert "rows = [  # the case" in page
    assert "falling-box = 0\nit is falling-box: masks\n" in page
    assert "after the repair `share-a-bit`. No motor." in page
    rules = page.partition("{ #rules }")[2].partition("<details markdown>")
    assert "too.\n\n- [" in rules[0]  # a blank line before it, or Markdown takes the list for more of the sentence
    assert "](../rules/masks.md)  \n  Two things that should touch" in rules[0]
    assert rules[0].index("rules/gravity.md") < rules[0].index("rules/tendon-never-taut.md")  # a cause, and a hint
    assert "](../rules/soft-contact.md)" in rules[2]  # whose first family is another


def test_a_case_links_to_its_family_in_the_open_and_tells_its_row_folded(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("tags: [contact]", f"tags: [contact]\n{TELLS}"))
    told, _ = differential("falls-through", [case], Cache(tmp_path / "cache"))
    opened, _, folded = case_page(case, collect(case), {}, {case.slug: case}, told).partition("<summary>Diagnosis")
    assert "**Is it your model?** [Run this script on it](../../symptoms/falls-through.md#procedure)" in opened
    assert "[have it diagnosed](../../rules/index.md)" in opened
    assert "ontacts at the start" not in opened
    assert "Contacts at the start: below 1." in folded
    assert "| **this one** | 0\u00a0\u2713 |" in folded
    assert "Is it your model" not in page_of(tiny_case(tmp_path / "other"), collect(case))
