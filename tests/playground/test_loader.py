"""What a page loads for the playground, and the sentence that stands in its place where it cannot run."""

from __future__ import annotations

import gzip
from pathlib import Path

import pytest
from live import address, no_engine, open_playground
from playwright.sync_api import Browser, Page, expect

pytestmark = pytest.mark.xdist_group("site")
BEFORE_THE_CLICK = 9_000  # bytes, with what the search, the tiles of the first page and folds ask of every page
AFTER_THE_CLICK = 1_700_000


def test_what_is_fetched_before_and_after_the_click_is_small(fresh: Page, served: str, site: Path) -> None:
    loader = (site / "javascripts/playground/loader.js").stat().st_size
    fetched: list[str] = []
    fresh.on("request", lambda request: fetched.append(request.url.removeprefix(served).split("#")[0]))
    fresh.goto(address(served))
    markup = len(
        fresh.locator(".playground").evaluate("root => root.outerHTML.replace(root.lastElementChild.outerHTML, '')")
    )
    assert [name for name in fetched if "playground" in name] == ["javascripts/playground/loader.js"]
    assert loader + markup < BEFORE_THE_CLICK

    fetched.clear()
    open_playground(fresh, served)

    files = {name for name in fetched if "playground" in name}
    assert "javascripts/playground/mujoco.wasm.gz" in files
    sizes = [
        len(content if name.endswith(".gz") else gzip.compress(content))
        for name in files
        if (content := (site / name).read_bytes())
    ]
    assert sum(sizes) < AFTER_THE_CLICK
    assert all(not name.startswith("http") for name in fetched), fetched


@pytest.mark.parametrize(("scripts", "scheme"), [(False, "http"), (True, "file")])
def test_without_scripts_or_a_server_a_sentence_stands_in_its_place(
    browser: Browser, served: str, site: Path, scripts: bool, scheme: str
) -> None:
    with browser.new_context(java_script_enabled=scripts) as context:
        page = context.new_page()
        page.goto(address(served if scheme == "http" else site.as_uri() + "/"))
        expect(page.get_by_text("Here the model runs live")).to_be_visible()
        expect(page.get_by_role("button", name="Run the broken model")).to_be_hidden()


@pytest.mark.parametrize(
    "loss",
    [
        "delete self.WebGL2RenderingContext",
        "delete self.WebAssembly",
        "HTMLCanvasElement.prototype.getContext = () => null",
    ],
)
def test_without_what_it_needs_a_sentence_stands_in_its_place(fresh: Page, served: str, loss: str) -> None:
    fresh.add_init_script(loss)
    fresh.goto(address(served))
    button = fresh.get_by_role("button", name="Run the broken model")
    if button.is_visible():
        button.dispatch_event("click")  # it may be hidden at any moment
    expect(fresh.get_by_text("Here the model runs live")).to_be_visible()
    expect(button).to_be_hidden()
    assert no_engine(fresh)
