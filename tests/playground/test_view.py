"""The playground's view in a real browser: the model moves, is pulled, and is seen from where the reader likes."""

from __future__ import annotations

from typing import Any

import pytest
from live import LIMIT, address, check, open_playground, steps, wait_for_steps
from playwright.sync_api import Page, TimeoutError, expect
from project import ROOT

pytestmark = pytest.mark.xdist_group("site")
PULLS = 4


def axe(page: Page) -> list[Any]:
    """Serious findings on the playground."""
    page.add_script_tag(path=str(ROOT / "node_modules/axe-core/axe.min.js"))
    found: list[Any] = page.evaluate("axe.run('.pg').then(found => found.violations)")
    return [
        (finding["id"], [node["html"] for node in finding["nodes"]])
        for finding in found
        if finding["impact"] in ("serious", "critical")
    ]


def test_it_runs_by_itself(page: Page, served: str) -> None:
    page.emulate_media(reduced_motion="no-preference")
    open_playground(page, served)

    expect(page.locator(".pg-run")).to_have_text("Pause")
    wait_for_steps(page)


def test_the_picture_changes_while_it_runs_which_a_reader_who_wants_less_motion_asks_for(
    page: Page, served: str
) -> None:
    open_playground(page, served)
    expect(page.locator(".pg-run")).to_have_text("Run")
    assert steps(page) == 0
    canvas = page.locator(".pg-stage canvas")
    before = canvas.screenshot()

    page.get_by_role("button", name="Step").evaluate("button => { for (let i = 0; i < 60; i++) button.click(); }")
    page.wait_for_function("document.querySelector('.pg-clock').dataset.steps >= 60", timeout=LIMIT)

    assert canvas.screenshot() != before


def test_warnings_of_the_engine_link_to_what_explains_them(page: Page, served: str) -> None:
    open_playground(page, served, "arm-explodes")
    page.get_by_role("button", name="Run", exact=True).click()

    warning = page.locator(".pg-warnings li")
    expect(warning).to_contain_text("Nan, Inf or huge value in QACC")
    for link in warning.locator("a").all():
        answer = page.request.get(link.evaluate("a => a.href"))
        assert answer.ok, link.get_attribute("href")


def test_a_body_is_pulled_with_buttons_and_with_the_pointer(page: Page, served: str) -> None:
    open_playground(page, served)
    page.get_by_label("Show the fix").select_option("default-masks")
    page.get_by_label("Speed", exact=True).select_option("1")
    page.get_by_label("Signal", exact=True).select_option("height")
    page.get_by_role("button", name="Run", exact=True).click()
    page.wait_for_function("parseFloat(document.querySelector('.pg-newest').value) < 0.051", timeout=LIMIT)
    page.locator(".pg-more summary").click()
    risen = "parseFloat(document.querySelector('.pg-newest').value) > 0.06"

    page.get_by_role("button", name="Pull the body up").click()
    page.wait_for_function(risen, timeout=LIMIT)

    page.get_by_role("button", name="Reset").click()
    page.get_by_role("button", name="Drag pulls").click()
    page.wait_for_function("parseFloat(document.querySelector('.pg-newest').value) < 0.051", timeout=LIMIT)
    page.locator(".pg-stage").scroll_into_view_if_needed()
    box = page.locator(".pg-stage canvas").bounding_box()
    assert box
    x, y = box["x"] + box["width"] / 2, box["y"] + 0.68 * box["height"]
    for attempt in range(PULLS):  # on a busy machine a gesture may be over between two frames
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x, y - 20)
        page.mouse.move(x, y - 0.3 * box["height"])
        try:
            page.wait_for_function(risen, timeout=LIMIT / PULLS)
            break
        except TimeoutError:
            assert attempt < PULLS - 1, "no pull moves the body"
        finally:
            page.mouse.up()


def test_the_view_is_turned_with_buttons_and_with_the_pointer(page: Page, served: str) -> None:
    open_playground(page, served)
    page.locator(".pg-more summary").click()
    canvas = page.locator(".pg-stage canvas")
    seen = [canvas.screenshot()]

    page.get_by_role("button", name="Turn the view left").click()
    seen.append(canvas.screenshot())
    page.get_by_role("button", name="Zoom in").click()
    seen.append(canvas.screenshot())
    canvas.drag_to(canvas, source_position={"x": 60, "y": 60}, target_position={"x": 160, "y": 90})
    seen.append(canvas.screenshot())

    assert len(set(seen)) == len(seen)


def test_overlays_are_off_until_asked_for(page: Page, served: str) -> None:
    open_playground(page, served, "grasp-slips")
    page.locator(".pg-more summary").click()
    boxes = page.get_by_role("group", name="Overlays").get_by_role("checkbox")
    assert not any(box.is_checked() for box in boxes.all())

    page.get_by_role("button", name="Show what matters").click()

    assert [box.is_checked() for box in boxes.all()].count(True) == 2

    page.get_by_role("button", name="Show what matters", pressed=True).click()

    assert not any(box.is_checked() for box in boxes.all())


def test_everything_is_reached_with_the_keyboard(page: Page, served: str) -> None:
    page.goto(address(served))
    page.get_by_role("button", name="Run the broken model").press("Enter")
    page.wait_for_function("document.querySelector('.pg-clock')?.dataset.steps", timeout=LIMIT)
    page.locator(".pg-run").focus()

    reached = []
    for _ in range(60):
        page.keyboard.press("Tab")
        reached.append(page.evaluate("document.activeElement.textContent.slice(0, 20) || document.activeElement.id"))
        if reached[-1] == "Give me a hint":
            break

    assert reached[-1] == "Give me a hint", reached
    assert {"Step", "Reset", "Check my fix", "Restore"} <= set(reached)
    assert any(name.startswith("<mujoco") for name in reached)


@pytest.mark.parametrize(("width", "scheme"), [(360, "dark"), (1280, "light")])
def test_it_fits_and_has_no_serious_finding(page: Page, served: str, width: int, scheme: Any) -> None:
    page.set_viewport_size({"width": width, "height": 800})
    page.emulate_media(color_scheme=scheme)
    open_playground(page, served, "ball-passes-through-shelf")
    page.locator(".pg-more summary").click()
    page.get_by_role("button", name="Give me a hint").click()
    page.get_by_label("Show the fix").select_option(index=1)
    check(page)
    page.get_by_role("button", name="Copy link").click()

    assert page.evaluate("document.documentElement.scrollWidth") <= width
    assert axe(page) == []
