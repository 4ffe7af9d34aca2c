"""The Content Security Policy of every page: nothing that stands in a page runs, nothing comes from elsewhere."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import lxml.html
import pytest
from kinds import KINDS
from live import LIMIT, address
from playwright.sync_api import Browser, Page, expect
from project import run

pytestmark = pytest.mark.xdist_group("accessibility")
FALLS = b"<mujoco><worldbody><body><freejoint/><geom size='.1'/></body></worldbody></mujoco>"
META = "//meta[@http-equiv='Content-Security-Policy']/@content"
INLINE = "//script[not(@src) and not(@type='application/json')] | //*[@*[starts-with(name(), 'on')]]"


@pytest.fixture
def page(browser: Browser) -> Iterator[Page]:
    """A page that obeys its policy."""
    context = browser.new_context(reduced_motion="reduce", color_scheme="light")
    context.set_default_timeout(LIMIT)
    yield context.new_page()
    context.close()


def complaints(page: Page) -> list[str]:
    """What the browser complains of in this page from now on: a refusal is an error on the console."""
    told: list[str] = []
    page.on("console", lambda message: told.append(message.text) if message.type == "error" else None)
    page.on("pageerror", lambda error: told.append(str(error)))
    return told


def test_every_page_has_the_policy_and_no_script_stands_in_one(site: Path) -> None:
    for path in sorted(site.rglob("*.html")):
        page = lxml.html.parse(path).getroot()
        (policy,) = page.xpath(META)
        assert "default-src 'none'" in policy
        assert "'unsafe-eval'" not in policy
        assert [lxml.html.tostring(one)[:200] for one in page.xpath(INLINE)] == [], path


def test_the_browser_refuses_nothing_that_a_page_needs(page: Page, site: Path, served: str) -> None:
    told = complaints(page)
    for start in (served, f"{site.as_uri()}/"):
        for place in KINDS.values():
            if (place, start) == ("404.html", f"{site.as_uri()}/"):
                continue  # a host answers with it, wherever the page was looked for; what it names begins at the root
            page.goto(start + place)
            colour = page.evaluate("getComputedStyle(document.querySelector('.md-header')).backgroundColor")
            assert colour == "rgb(20, 83, 45)", f"{start}{place} is without its style"
    assert told == []


def test_the_browser_refuses_nothing_that_search_playground_and_diagnosis_need(page: Page, served: str) -> None:
    told = complaints(page)
    page.goto(served)
    page.locator(".search-home input").fill("box falls")
    expect(page.locator(".search-home .search-results li a").first).to_be_visible()
    page.goto(address(served))
    page.get_by_role("button", name="Run the broken model").click()
    expect(page.locator(".pg-clock")).to_have_attribute("data-steps", re.compile(r"\d"))
    page.get_by_role("button", name="Check my fix").click()
    expect(page.locator(".pg-result[data-well]")).to_be_visible()
    page.goto(f"{served}rules/index.html")
    model = {"name": "model.xml", "mimeType": "application/xml", "buffer": FALLS}
    page.locator(".dg-ask input").first.set_input_files(model)
    expect(page.locator(".dg-report, .dg-error")).to_be_visible(timeout=4 * LIMIT)
    assert told == []


def test_a_script_that_stands_in_a_page_does_not_run(page: Page, served: str) -> None:
    told = complaints(page)
    page.goto(served)
    page.evaluate("document.body.append(Object.assign(document.createElement('script'), {text: 'ran = true'}))")
    page.evaluate("document.body.append(Object.assign(document.createElement('script'), {src: 'data:,ran=true'}))")
    assert page.evaluate("typeof ran") == "undefined"
    assert len(told) == 2
    assert all("Content Security Policy" in each for each in told)


def test_a_served_page_has_none_for_live_reload_puts_a_script_into_it(root: Path) -> None:
    code = """
from clinic.publish.policy import on_startup, policy
for command in ("serve", "build"):
    on_startup(command=command, dirty=False)
    print(bool(policy()))
"""
    assert run(root, "-c", code).stdout.split() == ["False", "True"]
