"""Cases in error: what is known of them, and the pages that say so."""

from __future__ import annotations

from html import unescape
from pathlib import Path

import lxml.html
import pytest
import yaml
from clinic.pages.error_page import LONGEST, Name, by_case, error_page, marked, ordered, read_name, without
from clinic.publish.site import navigation
from clinic.record.problem import Problem
from helpers import tiny_case, write_folder
from markup import acting, rendered

PROBLEM = Problem("cases/falling-box/case.yaml", 7, "run", "nothing", "```a fence```", "mend it")


@pytest.mark.parametrize(
    ("record", "name"),
    [
        pytest.param("number: 7\ntitle: A title\n", Name("a-case", 7, "A title"), id="plain"),
        pytest.param('title: "A: title"  \nnumber: 7 # seven\n', Name("a-case", 7, "A: title"), id="quoted"),
        pytest.param("title: A title\n  broken: [\n", Name("a-case", None, "A title"), id="no-number"),
        pytest.param("nonsense", Name("a-case", None, "a-case"), id="nothing"),
    ],
)
def test_the_name_is_read_where_it_can_be(tmp_path: Path, record: str, name: Name) -> None:
    assert read_name(write_folder(tmp_path, "a-case", {"case.yaml": record})) == name


def test_a_folder_without_a_record_is_named_by_itself(tmp_path: Path) -> None:
    assert read_name(write_folder(tmp_path, "a-case", {})).heading == "a-case"


@pytest.mark.parametrize(
    "record",
    [
        pytest.param("number: " + "9" * 5000 + "\n", id="number-of-thousands-of-digits"),
        pytest.param("title: ''\n", id="empty"),
    ],
)
def test_what_is_no_name_is_not_taken_for_one(tmp_path: Path, record: str) -> None:
    assert read_name(write_folder(tmp_path, "a-case", {"case.yaml": record})) == Name("a-case", None, "a-case")


def test_a_title_full_of_blanks_is_cut(tmp_path: Path) -> None:
    folder = write_folder(tmp_path, "a-case", {"case.yaml": "title: a" + " " * 90_000 + "b\n"})
    assert len(read_name(folder).title) == LONGEST


def test_names_are_by_number_and_those_without_come_last() -> None:
    names = [Name("c", None, "c"), Name("b", 10, "b"), Name("a", 9, "a")]
    assert [name.slug for name in ordered(names)] == ["a", "b", "c"]


def test_problems_are_by_case() -> None:
    other = Problem("messages.yaml", 1, "", "x", "y", "z")
    assert by_case([PROBLEM, other]) == {"falling-box": [PROBLEM], "": [other]}


def test_an_error_page_holds_the_message_to_the_letter() -> None:
    page = error_page('7. A "title"', [PROBLEM])
    assert 'title: "7. A \\"title\\""' in page
    assert '\n# 7. A "title"\n' in page
    for line in str(PROBLEM).splitlines():
        assert f"\n    {line}\n" in page
    assert "\n    ````text\n" in page


def test_a_title_that_would_act_is_text_on_its_page_and_in_the_navigation(tmp_path: Path) -> None:
    title = "</title><script>alert(1)</script> { onclick=x } [a](javascript:b)"
    name = read_name(write_folder(tmp_path, "a-case", {"case.yaml": f"number: 7\ntitle: {title}\n"}))
    page = error_page(name.heading, [PROBLEM])
    _, front, body = page.split("---\n", 2)
    assert name.heading == f"7. {title}"
    assert acting(rendered(body)) == []
    assert lxml.html.fromstring(rendered(body)).xpath("string(//h1/text())") == name.heading
    assert "<" not in front + str(navigation([name]))
    assert unescape(yaml.safe_load(front)["title"]) == name.heading


def test_a_marked_page_keeps_all_it_has() -> None:
    page = "---\ntitle: x\n---\n\n# 7. A title\n\nSymptom.\n# 7. A title\n"
    made = marked(page, [PROBLEM])
    assert made.index("# 7. A title") < made.index("!!! failure") < made.index("Symptom.")
    assert made.count("!!! failure") == 1


def test_relations_to_cases_that_cannot_be_shown_are_left_out(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("tags: [contact]", "tags: [contact]\nsee: [one, two]"))
    known = {"falling-box": case, "one": case}
    assert without(case, (), known).record.see == ["one"]
    assert without(case, (), {**known, "two": case}) is case


@pytest.mark.parametrize(
    ("count", "sections"),
    [(1, []), (50, []), (51, ["1 to 50", "51 to 51"]), (120, ["1 to 50", "51 to 100", "101 to 120"])],
)
def test_many_cases_are_in_sections(count: int, sections: list[str]) -> None:
    names = [Name(f"case-{n}", n, "A case") for n in range(1, count + 1)]
    (made,) = (entry["Cases"] for entry in navigation(names) if "Cases" in entry)
    assert isinstance(made, list)
    if sections:
        assert [next(iter(part)) for part in made] == sections
        made = [case for part in made for cases in part.values() for case in cases]
    assert [next(iter(case.values())) for case in made] == [f"cases/case-{n}/index.md" for n in range(1, count + 1)]
