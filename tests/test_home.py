"""The first page in a real browser: what it weighs, how soon the cards come, its tiles and their films."""

from __future__ import annotations

import gzip
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

pytestmark = pytest.mark.xdist_group("site")
WEIGHT = 110_000  # bytes, as a server compresses them, before any click
PHONE = {"width": 360, "height": 800}
COMPRESSED = (".webp", ".gz", ".mp4")


@pytest.fixture
def calm(browser: Browser) -> Iterator[Page]:
    """A page of who asks for less motion."""
    context = browser.new_context(reduced_motion="reduce")
    yield context.new_page()
    context.close()


def films(page: Page) -> list[str]:
    """The films that the page asks for from now on."""
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url) if request.url.endswith(".mp4") else None)
    return asked


@pytest.mark.parametrize("size", [PHONE, {"width": 1440, "height": 900}])
def test_the_first_page_is_light(page: Page, served: str, site: Path, size: dict[str, int]) -> None:
    page.set_viewport_size(size)  # type: ignore[arg-type]
    asked: set[str] = set()
    page.on("request", lambda request: asked.add(request.url.partition("#")[0]))
    page.goto(served + "index.html")
    page.wait_for_load_state("networkidle")
    weights = {}
    for url in asked:
        path = site / url.removeprefix(served)
        if path.is_file() and path.suffix != ".mp4":
            content = path.read_bytes()
            weights[path.name] = len(content if path.suffix in COMPRESSED else gzip.compress(content))
    assert {"index.html", "loader.js", "home.css"} <= weights.keys()
    heaviest = sorted(weights.items(), key=lambda each: -each[1])[:8]
    assert sum(weights.values()) < WEIGHT, f"make one of these smaller, or load it later: {heaviest}"


def test_on_a_phone_the_cards_begin_after_a_screen_and_a_half(page: Page, served: str) -> None:
    page.set_viewport_size(PHONE)  # type: ignore[arg-type]
    page.goto(served + "index.html")
    top = page.locator(".case").first.evaluate("card => card.getBoundingClientRect().top")
    assert top <= 1.5 * PHONE["height"], "shorten what stands above the cards in home.md.j2 or home.css"


def test_on_a_phone_the_word_of_a_tile_hides_nothing_of_its_picture(page: Page, served: str) -> None:
    page.set_viewport_size(PHONE)  # type: ignore[arg-type]
    page.goto(served + "index.html")
    hidden = """tiles => tiles.filter(tile => tile.querySelector("b").getBoundingClientRect().top
        < tile.querySelector(".tile-picture").getBoundingClientRect().bottom - 0.5).map(tile => tile.textContent)"""
    assert page.locator(".tile").evaluate_all(hidden) == []


def test_a_tile_shows_the_cards_of_its_symptom_and_gives_all_back(page: Page, served: str) -> None:
    page.goto(served + "index.html")
    count = page.locator(".case:visible").count()
    page.locator(".tile[data-family=falls-through]").click()
    expect(page.locator(".case:visible")).to_have_count(page.locator(".case[data-family=falls-through]").count())
    expect(page.locator(".tile[aria-current]")).to_have_attribute("data-family", "falls-through")
    expect(page.locator(".chosen")).to_contain_text("It falls or passes through")
    assert page.url.endswith("index.html#falls-through")
    page.go_back()
    expect(page.locator(".case:visible")).to_have_count(count)
    page.goto(served + "index.html#sinks")
    page.reload()
    expect(page.locator(".case:visible").first).to_have_attribute("data-family", "sinks")
    page.get_by_role("link", name="What to measure first").click()
    expect(page.locator("h1")).to_contain_text("It sinks in")
    page.go_back()
    page.get_by_role("link", name="Show all cases").click()
    expect(page.locator(".case:visible")).to_have_count(count)


def test_without_scripts_a_tile_leads_to_the_page_of_its_symptom(browser: Browser, served: str) -> None:
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto(served + "index.html")
    page.locator(".tile", has_text="falls through").click()
    expect(page.locator("h1")).to_contain_text("It falls or passes through")
    context.close()


def test_a_film_is_fetched_when_one_points_at_its_tile_or_comes_to_it(page: Page, served: str) -> None:
    asked = films(page)
    page.goto(served + "index.html")
    page.wait_for_load_state("networkidle")
    assert not asked
    tile, other = page.locator(".tile[data-film]").first, page.locator(".tile[data-film]").nth(1)
    tile.hover()
    expect(tile.locator("video.plays")).to_have_count(1)
    assert tile.locator("video").evaluate("film => film.muted && film.loop && !film.paused")
    length = tile.locator("video").evaluate("film => film.duration")
    assert 1.9 <= length <= 2.1
    other.focus()
    page.mouse.move(0, 0)
    expect(other.locator("video")).to_have_count(1)
    expect(tile.locator("video")).to_have_count(0)


def test_a_finger_has_the_films_in_sight(browser: Browser, served: str) -> None:
    context = browser.new_context(has_touch=True, is_mobile=True, viewport=PHONE)  # type: ignore[arg-type]
    page = context.new_page()
    page.goto(served + "index.html")
    tile = page.locator(".tile[data-film]").first
    tile.evaluate("tile => tile.scrollIntoView({block: 'center'})")
    expect(tile.locator("video.plays")).to_have_count(1)
    page.evaluate("scrollTo(0, document.documentElement.scrollHeight)")
    expect(page.locator(".tile video")).to_have_count(0)
    context.close()


def test_who_asks_for_less_motion_gets_no_film(calm: Page, served: str) -> None:
    asked = films(calm)
    calm.goto(served + "index.html")
    calm.locator(".tile[data-film]").first.hover()
    calm.locator(".tile[data-film]").first.focus()
    calm.wait_for_timeout(500)
    assert not asked
    assert not calm.locator("video").count()


def test_a_card_is_ticked_once_its_case_is_solved(page: Page, served: str) -> None:
    page.goto(served + "index.html")
    page.evaluate("localStorage.setItem('mujoco-clinic', JSON.stringify(['servo-sags']))")
    page.reload()
    marks = page.locator(".case[data-case=servo-sags] .case-marks")
    assert "solved" in marks.evaluate("marks => getComputedStyle(marks, '::after').content")
    page.get_by_role("button", name="Forget which cases I solved").click()
    assert "solved" not in marks.evaluate("marks => getComputedStyle(marks, '::after').content")
