"""The built site in a real browser: folds open."""

from __future__ import annotations

from typing import Any

import pytest
from playwright.sync_api import Page, expect

pytestmark = pytest.mark.xdist_group("site")
CASE = "cases/box-falls-through-floor/index.html"


def test_folds_are_closed_and_open_on_a_click(page: Page, served: str) -> None:
    page.goto(served + CASE)
    hidden = page.get_by_text("contype 2 conaffinity 2")
    expect(hidden).to_be_hidden()

    page.get_by_text("Diagnosis", exact=True).click()

    expect(hidden).to_be_visible()


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
        page.evaluate("scheme => document.body.setAttribute('data-md-color-scheme', scheme)", site)
        plot.scroll_into_view_if_needed()
        plot.evaluate("image => image.decode()")
        return plot.screenshot(animations="disabled")

    plot = page.locator("img[src$='plot.svg']")
    bright, dark = seen("light", "default"), seen("light", "slate")

    assert bright != dark
    assert seen("dark", "default") == bright
    assert seen("dark", "slate") == dark

    page.emulate_media(media="print")
    expect(plot).to_have_css("color-scheme", "light")
