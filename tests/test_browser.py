"""The built site in a real browser: folds open, the answer is told to who asks, films run in sight."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
from kinds import KINDS
from playwright.sync_api import Browser, Page, expect

pytestmark = pytest.mark.xdist_group("site")
CASE = "cases/box-falls-through-floor/index.html"
READ = """() => [...document.querySelectorAll("article :is(h1, h2, h3, p, li, td, pre, summary, figcaption)")]
  .filter(one => one.checkVisibility() && !one.closest(".playground, .diagnose, .search"))
  .map(one => one.textContent.trim().replace(/\\s+/g, " "))"""
OTHER = "cases/rotation-error-reads-zero/index.html"


def test_folds_are_closed_and_open_on_a_click(page: Page, served: str) -> None:
    page.goto(served + CASE)
    hidden = page.get_by_text("contype 2 conaffinity 2")
    expect(hidden).to_be_hidden()

    page.get_by_text("Diagnosis", exact=True).click()

    expect(hidden).to_be_visible()
    expect(page.locator("#answer")).to_be_hidden()


@pytest.mark.parametrize("scripts", [True, False])
def test_who_asks_for_the_answer_finds_everything_unfolded(browser: Browser, served: str, scripts: bool) -> None:
    with browser.new_context(java_script_enabled=scripts) as context:
        page = context.new_page()
        page.goto(f"{served}{CASE}#answer")
        expect(page.locator("#answer")).to_be_in_viewport()
        expect(page.get_by_text("The contact masks of the two share no bit.")).to_be_in_viewport()
        expect(page.get_by_text("contype 2 conaffinity 2")).to_be_visible()
        expect(page.get_by_text("Collision filtering is silent")).to_be_visible()


def test_the_way_to_read_is_kept(page: Page, served: str) -> None:
    page.goto(served + CASE)
    page.get_by_text("Just tell me").click()
    assert page.locator("details:not([open])").count() == 0

    page.goto(served + OTHER)
    assert page.locator("details:not([open])").count() == 0
    page.get_by_text("Just tell me").click()
    assert page.locator("details[open]").count() == 0

    page.goto(served + CASE)
    assert page.locator("details[open]").count() == 0


def test_who_comes_from_a_search_engine_is_told_once(page: Page, served: str) -> None:
    page.goto(served + CASE, referer="https://www.google.com/")
    expect(page.locator("#answer")).to_be_visible()
    page.goto(served + CASE, referer="https://www.google.example.org.evil/")
    expect(page.locator("#answer")).to_be_hidden()
    page.goto(served + OTHER, referer=served)
    expect(page.locator("#answer")).to_be_hidden()


def test_an_answer_that_is_linked_from_within_the_page_unfolds_it(page: Page, served: str) -> None:
    page.goto(served + CASE)
    page.evaluate("location.hash = 'answer'")
    expect(page.get_by_text("Collision filtering is silent")).to_be_visible()


def test_plots_in_folds_are_fetched_when_they_are_opened(page: Page, served: str) -> None:
    fetched: list[str] = []
    page.on("request", lambda request: fetched.append(request.url.rsplit("/", 1)[1]))
    page.goto(served + CASE, wait_until="networkidle")
    assert not [name for name in fetched if name.endswith(".svg") and name != "favicon.svg"]
    with page.expect_request("**/plot.svg"):
        page.get_by_text("Fix", exact=True).click()
        page.locator("img[src$='plot.svg']").scroll_into_view_if_needed()


def test_a_film_runs_in_sight_and_stops_when_told(page: Page, served: str) -> None:
    page.goto(served + CASE)
    film = page.locator(".film video")
    film.scroll_into_view_if_needed()
    page.wait_for_function("!document.querySelector('.film video').paused")
    assert not film.evaluate("film => film.controls")
    page.get_by_role("button", name="Pause").click()
    assert film.evaluate("film => film.paused")


def test_a_film_waits_for_who_asks_for_less_motion(page: Page, served: str) -> None:
    page.emulate_media(reduced_motion="reduce")
    fetched: list[str] = []
    page.on("request", lambda request: fetched.append(request.url))
    page.goto(served + CASE, wait_until="networkidle")
    assert page.locator(".film video").evaluate("film => film.paused")
    assert not [url for url in fetched if url.endswith(".mp4")]
    page.get_by_role("button", name="Play").click()
    page.wait_for_function("!document.querySelector('.film video').paused")


def test_without_scripts_the_still_and_the_source_are_there(browser: Browser, served: str) -> None:
    with browser.new_context(java_script_enabled=False) as context:
        page = context.new_page()
        page.goto(served + CASE)
        expect(page.locator(".film .strip")).to_be_visible()
        expect(page.locator(".film video")).to_be_hidden()
        expect(page.locator(".playground pre")).to_contain_text('contype="2"')


def test_no_table_loses_a_column(page: Page, served: str) -> None:
    for width in (360, 1280):
        page.set_viewport_size({"width": width, "height": 800})
        for address in (CASE, OTHER, "cases/ball-passes-through-shelf/index.html"):
            page.goto(f"{served}{address}#answer")
            cut = (
                "table => table.getBoundingClientRect().right > table.closest('details').getBoundingClientRect().right"
            )
            assert not page.locator("table.measured").evaluate(cut), f"{address}, {width} px"


def test_a_page_fits_a_phone(page: Page, served: str) -> None:
    page.set_viewport_size({"width": 360, "height": 800})
    for address in (CASE, "index.html", "triage.html"):
        page.goto(served + address)
        page.evaluate("document.querySelectorAll('details').forEach(fold => fold.open = true)")
        assert page.evaluate("document.documentElement.scrollWidth") <= 360, address


def test_paper_shows_every_fold(page: Page, served: str) -> None:
    page.goto(served + CASE)
    page.emulate_media(media="print")
    expect(page.get_by_text("contype 2 conaffinity 2")).to_be_visible()


def test_a_plot_has_the_colours_of_the_page_rather_than_of_the_system(page: Page, served: str) -> None:
    def seen(system: Any, site: str) -> bytes:
        page.emulate_media(color_scheme=system)
        page.goto(served + CASE)
        page.get_by_text("Fix", exact=True).click()
        page.wait_for_load_state("networkidle")  # the theme's script, asked for by the press, moves what is below
        page.evaluate("scheme => document.body.setAttribute('data-md-color-scheme', scheme)", site)
        plot.scroll_into_view_if_needed()
        plot.evaluate("image => image.decode()")
        page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
        return plot.screenshot(animations="disabled")

    plot = page.locator("img[src$='plot.svg']")
    bright, dark = seen("light", "default"), seen("light", "slate")

    assert bright != dark
    assert seen("dark", "default") == bright
    assert seen("dark", "slate") == dark

    page.emulate_media(media="print")
    expect(plot).to_have_css("color-scheme", "light")


def test_every_case_on_paper_is_two_to_four_sheets(page: Page, served: str, site: Path) -> None:
    sheets = {}
    for case in sorted(path.parent.name for path in site.glob("cases/*/index.html")):
        page.goto(f"{served}cases/{case}/index.html")
        sheets[case] = len(re.findall(rb"/Type\s*/Page\b", page.pdf(format="A4")))
    assert {case: count for case, count in sheets.items() if not 2 <= count <= 4} == {}


@pytest.mark.parametrize("kind", KINDS)
def test_a_page_without_scripts_is_whole_and_offers_nothing_that_does_nothing(
    browser: Browser, served: str, kind: str
) -> None:
    read = []
    for scripts in (True, False):
        with browser.new_context(java_script_enabled=scripts, bypass_csp=True) as context:
            page = context.new_page()
            page.goto(served + KINDS[kind])
            read.append(page.evaluate(READ))
            dead = [button.inner_text() for button in page.locator("button:not([hidden]):visible").all()]
    assert dead == []
    with_scripts, without = read
    assert len(without) > 2
    assert [text for text in with_scripts if text not in without] == []
