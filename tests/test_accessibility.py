"""Every kind of page for who sees or moves otherwise, in a real browser: folds open and closed, light and dark."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from kinds import KINDS
from live import open_playground
from playwright.sync_api import Browser, Page, ViewportSize

pytestmark = pytest.mark.xdist_group("accessibility")
WIDE: ViewportSize = {"width": 1280, "height": 900}
PHONE: ViewportSize = {"width": 390, "height": 800}
NARROW: ViewportSize = {"width": 320, "height": 640}  # 1280 px, four times as large
COLOURS = ["color-contrast", "link-in-text-block"]
STATES = [  # what a scheme changes is colours alone
    (WIDE, "default", False, None),
    (PHONE, "default", True, None),
    (WIDE, "slate", True, COLOURS),
    (PHONE, "slate", False, COLOURS),
]  # without folds the first and the last
FOLDS = "open => document.querySelectorAll('details').forEach(fold => fold.open = open)"
SCHEME = "scheme => document.body.setAttribute('data-md-color-scheme', scheme)"
AXE = """async (only) => {
  for (let frame = 0; frame < 3; frame++) await new Promise(requestAnimationFrame);  // what follows a change of size
  const options = only ? {runOnly: only} : {rules: {"target-size": {enabled: true}}};
  const told = ({message}) => message;
  const {violations} = await axe.run(document, {...options, resultTypes: ["violations"]});
  return violations.flatMap(({id, nodes}) => nodes.map(({target, html, any, all, none}) =>
    `${id}: ${[...any, ...all, ...none].map(told).join("; ") || target}\\n    ${html.slice(0, 160)}`));
}"""
WIDER = """() => {
  const scrolls = one => getComputedStyle(one).overflowX !== "visible";
  const kept = one => one !== document.body && (scrolls(one) || kept(one.parentElement));
  return [...document.querySelectorAll("body *")]
    .filter(one => one.checkVisibility() && one.getBoundingClientRect().right > innerWidth && !kept(one.parentElement))
    .map(one => one.outerHTML.slice(0, 120));
}"""
UNSEEN = """() => {
  const wrong = [];
  const stops = [...document.querySelectorAll("a[href], button, input, select, summary, video, [tabindex='0']")];
  for (const stop of stops.reverse().filter(one => one.checkVisibility({visibilityProperty: true}) && !one.disabled)) {
    stop.focus();
    if (document.activeElement !== stop) continue;
    const shown = stop.matches(".md-option") ? stop.nextElementSibling : stop;
    const {outlineStyle, outlineWidth} = getComputedStyle(shown);
    const told = stop.outerHTML.slice(0, 120);
    if (outlineStyle === "none" || parseFloat(outlineWidth) < 2) wrong.push(`no outline: ${told}`);
    const covered = document.querySelector(".md-header").getBoundingClientRect().bottom;
    if (!stop.closest(".md-header, .md-skip, .md-sidebar") && stop.getBoundingClientRect().bottom < covered)
      wrong.push(`below the header: ${told}`);
  }
  return wrong;
}"""


@pytest.fixture(scope="module", params=KINDS.values(), ids=KINDS.keys())
def shown(browser: Browser, served: str, root: Path, request: pytest.FixtureRequest) -> Iterator[Page]:
    """A page of each kind, in which nothing moves by itself, and axe in it."""
    context = browser.new_context(viewport=WIDE, reduced_motion="reduce")
    page = context.new_page()
    page.goto(served + request.param)
    look_at(page, root)
    yield page
    context.close()


def look_at(page: Page, root: Path) -> None:
    page.evaluate((root / "node_modules" / "axe-core" / "axe.min.js").read_text(encoding="utf-8"))


def test_no_violation(shown: Page) -> None:
    assert not (found := violations(shown)), "\n".join(found)


def violations(page: Page) -> list[str]:
    found = []
    folded = page.locator("details").count() > 0
    for size, scheme, folds, only in STATES if folded else STATES[::3]:
        page.set_viewport_size(size)
        page.evaluate(SCHEME, scheme)
        page.evaluate(FOLDS, folds)
        found += [
            f"{scheme}, {size['width']} px, folds {'open' if folds else 'closed'}: {one}"
            for one in page.evaluate(AXE, only)
        ]
    return found


def test_nothing_is_wider_than_a_page_of_320_px(shown: Page) -> None:
    shown.set_viewport_size(NARROW)
    shown.evaluate(FOLDS, True)
    wide: Any = shown.evaluate("document.documentElement.scrollWidth")
    assert wide <= NARROW["width"], "\n".join(shown.evaluate(WIDER))


def test_the_focus_is_seen(shown: Page) -> None:
    shown.set_viewport_size(WIDE)
    shown.evaluate(FOLDS, True)
    shown.keyboard.press("Tab")  # from here on the browser shows where the focus is
    assert not (unseen := shown.evaluate(UNSEEN)), "\n".join(unseen)


def test_nothing_moves_for_who_asks_for_less_motion(shown: Page) -> None:
    shown.set_viewport_size(WIDE)
    for film in shown.locator("video").all():
        film.scroll_into_view_if_needed()
    assert shown.evaluate("[...document.querySelectorAll('video')].filter(film => !film.paused).length") == 0
    assert shown.evaluate("document.getAnimations().length") == 0


def test_an_open_playground_has_no_violation(page: Page, served: str, root: Path) -> None:
    page.emulate_media(reduced_motion="reduce")
    open_playground(page, served)
    look_at(page, root)
    assert not (found := violations(page)), "\n".join(found)
