"""Nothing on a folded case page, nor what leads to it, says the words that its fixes add."""

from __future__ import annotations

import json
import re
from pathlib import Path

import lxml.html
import pytest
from clinic.engine.variant import variants
from clinic.pages.text.prose import fill
from clinic.proof.evidence import Evidence
from clinic.record.case import Case
from conftest import Proven

pytestmark = pytest.mark.xdist_group("site")
WORD = re.compile(r"[a-z]\w+")
SEEN = ("alt", "title", "aria-label", "content", "placeholder")  # attributes that a reader is shown or told
PLACES = "//head/title | //head/meta | //*[@class='md-tags'] | //nav[contains(@class, 'md-nav--secondary')] | //article"


def words(text: str) -> set[str]:
    """The words of a text and, of those that join several, each."""
    found = set(WORD.findall(text.lower()))
    return found | {part for word in found for part in word.split("_") if len(part) > 1}


def telling_words(case: Case, evidence: Evidence) -> set[str]:
    """What the fixes add that neither the broken source nor the symptom says, nor what the symptom's numbers are of."""
    record = case.record
    quoted = (name for name in record.signals if f".{name}." in record.symptom)
    labels = (record.signals[name].label for name in quoted)
    known = " ".join([*case.texts.values(), record.title, fill(record.symptom, evidence, case), *labels])
    added = (variant.text for variant in variants(case) if variant.kind == "fix")
    return words(" ".join(added)) - words(known)


def folded(page: lxml.html.HtmlElement) -> str:
    """What is read or heard of a page while its folds are closed."""
    for hidden in page.xpath("//details/*[not(self::summary)] | //script | //style | //meta[@http-equiv]"):
        hidden.drop_tree()
    seen = []
    for place in page.xpath(PLACES):
        seen.append(place.text_content())
        seen += [value for each in place.iter() for name in SEEN if (value := each.get(name))]
    return " ".join(seen)


def test_the_folded_page_tells_no_word_of_a_fix(slug: str, proven: Proven, site: Path) -> None:
    telling = telling_words(*proven(slug))
    seen = words(folded(lxml.html.parse(site / "cases" / slug / "index.html").getroot()))
    assert not (told := telling & seen), f"{slug} is told by {sorted(told)} in the open: fold it, or say it otherwise"


def test_what_the_search_shows_tells_no_word_of_a_fix(slug: str, proven: Proven, site: Path) -> None:
    index = (site / "javascripts/search/index.js").read_text(encoding="utf-8").partition("=")[2].strip().rstrip(";")
    cases = json.loads(index)["documents"]["case"]
    (shown,) = (dict(zip(cases["fields"], values, strict=True)) for rest, *values in cases["rows"] if rest == slug)
    assert not telling_words(*proven(slug)) & words(shown["title"] + " " + shown["text"])


def test_the_first_hint_tells_no_word_of_a_fix(slug: str, proven: Proven, site: Path) -> None:
    if not (file := site / "cases" / slug / "playground.json").is_file():
        return
    hint = json.loads(file.read_text(encoding="utf-8")).get("hints", [{"text": ""}])[0]["text"]  # a script has none
    assert not (told := telling_words(*proven(slug)) & words(hint)), f"the first hint of {slug} tells {sorted(told)}"


def test_the_words_are_found_where_they_are_told(proven: Proven, site: Path) -> None:
    """The sentinel: with its folds open the page of a case says what its fix adds."""
    telling = telling_words(*proven("servo-oscillates"))
    page = lxml.html.parse(site / "cases" / "servo-oscillates" / "index.html").getroot()
    assert {"dampratio"} <= telling & words(page.text_content())
