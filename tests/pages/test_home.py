"""The first page's text: tiles, messages and cards."""

from __future__ import annotations

import re
from pathlib import Path

from clinic.pages.brief import brief
from clinic.pages.cases import CasePage
from clinic.pages.home import PASTED, home, tiles
from clinic.pages.playground import FILE as PLAYGROUND
from clinic.pages.text.prose import opening
from clinic.proof.evidence import collect
from clinic.record.case import Case
from helpers import script_case, tiny_case

FAMILY = ("tags: [contact]", "tags: [contact]\nfamily: falls-through")
PICTURES = ("thumb.webp", "clip.mp4", PLAYGROUND)


def shown(case: Case, *files: str) -> CasePage:
    evidence = collect(case)
    return CasePage(case, "", opening(case, evidence), dict.fromkeys(files, b""), "", brief(case, evidence))


def test_a_card_has_the_failure_the_title_what_was_measured_and_says_that_one_can_play(tmp_path: Path) -> None:
    page = home([shown(tiny_case(tmp_path, FAMILY), *PICTURES)])
    (card,) = re.findall(r'<div class="case".*?</div>', page, re.DOTALL)
    assert 'data-family="falls-through"' in card
    assert 'src="cases/falling-box/thumb.webp"' in card
    assert '<a href="cases/falling-box/index.html">A box falls through the floor</a>' in card
    measured = re.search(r'Height of the box at the end: .*?"was">(.*?)<.*?"now">(.*?)<', card)
    assert measured is not None
    broken, repaired = measured.groups()
    assert broken.startswith("\u22120.")
    assert repaired.startswith("0.04")
    assert "playable" in card
    assert "playable" not in home([shown(tiny_case(tmp_path / "other", FAMILY))])


def test_what_a_script_prints_has_no_moment_of_its_own(tmp_path: Path) -> None:
    final = script_case(tmp_path / "final")
    largest = script_case(tmp_path / "largest", ("{signal: error, equals: 0}", "{signal: error, take: max, equals: 0}"))
    for case, said in ((final, "error"), (largest, "error, highest")):
        found = brief(case, collect(case))
        assert found is not None
        assert found.measured == said


def test_lengths_below_a_millimetre_are_told_in_millimetres(tmp_path: Path) -> None:
    found = brief(case := tiny_case(tmp_path), evidence := collect(case))
    assert found is not None
    assert found.repaired == "0.0499\u00a0m"
    deep, flat = (evidence.variants[name] for name in ("broken", "share-a-bit"))
    tiny = [each.model_copy(update={"measured": 1.2e-4}) for each in flat.checks["fixed"]]
    large = [each.model_copy(update={"measured": 0.102}) for each in deep.checks["fixed"]]
    changed = {
        "broken": deep.model_copy(update={"checks": deep.checks | {"fixed": large}}),
        "share-a-bit": flat.model_copy(update={"checks": flat.checks | {"fixed": tiny}}),
    }
    again = brief(case, evidence.model_copy(update={"variants": evidence.variants | changed}))
    assert again is not None
    assert again[1:] == ("102\u00a0mm", "0.120\u00a0mm")


def test_a_tile_leads_to_the_page_of_its_symptom_and_names_its_film(tmp_path: Path) -> None:
    page = home([shown(tiny_case(tmp_path, FAMILY), *PICTURES)])
    (tile,) = re.findall(r'<a class="tile".*?</a>', page)
    assert 'href="symptoms/falls-through.html"' in tile
    assert 'data-film="cases/falling-box/clip.mp4"' in tile
    assert "<b>falls through</b>" in tile
    assert all(f"messages.html#{key}" in page for key in PASTED)


def test_the_case_with_a_film_lends_its_picture_to_the_tile(tmp_path: Path) -> None:
    still, filmed = (
        shown(tiny_case(tmp_path / name, FAMILY, ("number: 1", f"number: {number}")), *files)
        for name, number, files in (("one", 1, ("thumb.webp",)), ("two", 2, PICTURES))
    )
    (tile,) = tiles([still, filmed])
    assert (tile.picture, tile.film) == (filmed.case.slug, filmed.case.slug)
    (alone,) = tiles([still])
    assert (alone.picture, alone.film) == (still.case.slug, "")


def test_a_title_on_a_card_holds_no_html_of_its_own(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("title: A box falls", "title: A <b> falls"), ("label: height", "label: <b>height"))
    (card,) = re.findall(r'<div class="case".*?</div>', home([shown(case)]), re.DOTALL)
    assert "<b>" not in card
    assert card.count("&#60;b&#62;") + card.count("&#60;b>") == 2
