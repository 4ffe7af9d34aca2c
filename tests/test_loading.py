"""What a page costs its reader before any click, from a server that compresses, as hosts do."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from hosted import lighthouse
from kinds import KINDS
from playwright.sync_api import Browser, Page, ViewportSize

pytestmark = pytest.mark.xdist_group("site")
MOST = 110_000  # bytes of a page before any click, but for its film
SCREENS: list[ViewportSize] = [{"width": 1280, "height": 800}, {"width": 412, "height": 823}]
PERFECT = ("accessibility", "best-practices", "seo")
PAGES = ("home", "model case")


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("screen", SCREENS, ids=["wide", "phone"])
def test_a_page_is_small_before_any_click(browser: Browser, served: str, kind: str, screen: ViewportSize) -> None:
    context = browser.new_context(viewport=screen)
    page = context.new_page()
    arrived = received(page)
    page.goto(served + KINDS[kind], wait_until="networkidle")
    context.close()
    parts = {address.removeprefix(served): size for address, size in arrived.items() if not address.endswith(".mp4")}
    told = "\n".join(f"{size:7,.0f} {name}" for name, size in sorted(parts.items(), key=lambda part: -part[1]))
    assert sum(parts.values()) < MOST, f"{sum(parts.values()):,.0f} bytes:\n{told}"


def received(page: Page) -> dict[str, float]:
    """The bytes that come over the wire from now on, by address."""
    session = page.context.new_cdp_session(page)
    addresses: dict[str, str] = {}
    arrived: dict[str, float] = {}

    def ask(event: dict[str, Any]) -> None:
        addresses[event["requestId"]] = event["request"]["url"]

    def end(event: dict[str, Any]) -> None:
        address = addresses.get(event["requestId"], "")
        if address.startswith("http"):
            arrived[address] = event["encodedDataLength"]

    session.on("Network.requestWillBeSent", ask)
    session.on("Network.loadingFinished", end)
    session.send("Network.enable")
    return arrived


def test_figures_in_closed_folds_load_when_they_are_opened(page: Page, served: str) -> None:
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    page.goto(served + KINDS["model case"], wait_until="networkidle")
    folded = page.evaluate("[...document.querySelectorAll('details:not([open]) img')].map(image => image.src)")
    assert folded
    assert not set(folded) & set(asked)

    page.evaluate("document.querySelectorAll('details').forEach(fold => fold.open = true)")
    for image in page.locator("details img").all():
        image.scroll_into_view_if_needed()
        image.evaluate("image => image.decode()")

    assert set(folded) <= set(asked)


@pytest.mark.parametrize("kind", PAGES)
def test_lighthouse_finds_nothing_to_better(served: str, root: Path, kind: str) -> None:
    said = lighthouse(root, served + KINDS[kind], *PERFECT)
    audits = said["audits"]
    for name in PERFECT:
        category = said["categories"][name]
        wrong = [audits[ref["id"]] for ref in category["auditRefs"] if ref["weight"]]
        told = [f"{one['title']} {one.get('details', '')}"[:500] for one in wrong if one["score"] == 0]
        assert category["score"] == 1, "\n".join(told)
