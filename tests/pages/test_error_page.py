"""The pages of cases in error."""

from __future__ import annotations

from html import unescape
from pathlib import Path

import lxml.html
import pytest
import yaml
from clinic.pages.cases import keep_relations
from clinic.pages.error_page import error_page, with_problems
from clinic.publish.site import navigation
from clinic.record.problem import Problem
from helpers import tiny_case
from markup import acting, rendered

PROBLEM = Problem("cases/falling-box/case.yaml", 7, "run", "nothing", "```a fence```", "mend it")


def test_an_error_page_holds_the_message_to_the_letter() -> None:
    page = error_page('7. A "title"', [PROBLEM])
    assert 'title: "7. A \\"title\\""' in page
    assert '\n# 7. A "title"\n' in page
    for line in str(PROBLEM).splitlines():
        assert f"\n    {line}\n" in page
    assert "\n    ````text\n" in page


def test_a_title_that_would_act_is_text_on_its_page_and_in_the_navigation() -> None:
    title = "7. </title><script>alert(1)</script> { onclick=x } [a](javascript:b)"
    _, front, body = error_page(title, [PROBLEM]).split("---\n", 2)
    assert acting(rendered(body)) == []
    assert lxml.html.fromstring(rendered(body)).xpath("string(//h1/text())") == title
    assert "<" not in front + str(navigation({"a-case": title}))
    assert unescape(yaml.safe_load(front)["title"]) == title


def test_a_marked_page_keeps_all_it_has() -> None:
    page = "---\ntitle: x\n---\n\n# 7. A title\n\nSymptom.\n# 7. A title\n"
    made = with_problems(page, [PROBLEM])
    assert made.index("# 7. A title") < made.index("!!! failure") < made.index("Symptom.")
    assert made.count("!!! failure") == 1


def test_relations_to_cases_that_cannot_be_shown_are_left_out(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("tags: [contact]", "tags: [contact]\nsee: [one, two]"))
    known = {"falling-box": case, "one": case}
    assert keep_relations(case, known).record.see == ["one"]
    assert keep_relations(case, {**known, "two": case}) == case


@pytest.mark.parametrize(
    ("count", "sections"),
    [(1, []), (50, []), (51, ["1 to 50", "51 to 51"]), (120, ["1 to 50", "51 to 100", "101 to 120"])],
)
def test_many_cases_are_in_sections(count: int, sections: list[str]) -> None:
    slugs = [f"case-{n}" for n in range(1, count + 1)]
    (made,) = (entry["Cases"] for entry in navigation(dict(zip(slugs, slugs, strict=True))) if "Cases" in entry)
    assert isinstance(made, list)
    if sections:
        assert [next(iter(part)) for part in made] == sections
        made = [case for part in made for cases in part.values() for case in cases]
    assert made == [{slug: f"cases/{slug}/index.md"} for slug in slugs]
