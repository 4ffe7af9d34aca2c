"""Words that a newcomer misses, explained where they first stand."""

from __future__ import annotations

from pathlib import Path

from clinic.pages.text.manual import anchors
from clinic.pages.text.words import words
from markup import rendered

GEOM = f'<abbr title="{words()["geom"].says}">geom</abbr>'


def test_the_first_of_a_word_is_explained_and_no_other() -> None:
    html = rendered("# A geom\n\nThis geom, and that *geom*.\n\nGeoms of a geometry.")
    assert html.count("<abbr") == 1
    assert f"<p>This {GEOM}, and that <em>geom</em>.</p>" in html


def test_code_is_explained_where_it_is_the_word_alone() -> None:
    html = rendered("A site: `solref=x` and `solref`\n\n    solimp\n\n[solimp](https://example.org), `site`")
    assert html.count("title=") == html.count('class="word"') == 2
    assert "A site:" in html


def test_two_words_in_a_text_and_one_behind_an_element() -> None:
    html = rendered("A keyframe of *the* hinge and its gear.")
    assert html.count("<abbr") == 3
    assert html.count("keyframe") == html.count("hinge</abbr>") == html.count("gear</abbr>") == 1


def test_every_word_has_its_place_in_the_manual_and_a_short_sentence() -> None:
    assert len(words()) >= 30
    for key, word in words().items():
        page, _, anchor = word.manual.partition("#")
        assert anchor in anchors(page), f"{key}: {page} has no #{anchor}; its anchors begin {list(anchors(page))[:20]}"
        assert 20 < len(word.says) < 170, f"{key}: say it in one or two short sentences"
        assert word.says.endswith(".")


def test_no_form_is_of_two_words() -> None:
    forms = [form for word in words().values() for form in word.forms]
    assert len(forms) == len(set(forms))


def test_the_site_explains_words(site: Path) -> None:
    assert "<abbr title=" in (site / "cases/box-falls-through-floor/index.html").read_text(encoding="utf-8")
