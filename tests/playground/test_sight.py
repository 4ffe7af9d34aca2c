"""What is in sight while one edits, in a real browser, and what the chart and the verdict say."""

from __future__ import annotations

import json
import re
from typing import Any

import pytest
from clinic.pages.playground import playground
from clinic.record.case import Case
from live import LIMIT, address, check, edited, no_engine, open_playground, type_text, wait_for_steps
from playwright.sync_api import Page, expect

pytestmark = pytest.mark.xdist_group("site")
CONTRAST = """element => {
  const lights = ["color", "backgroundColor"].map((name) => {
    const parts = getComputedStyle(element)[name].match(/[0-9.]+/g).slice(0, 3).map((part) => part / 255);
    const linear = parts.map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4));
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
  });
  return (Math.max(...lights) + 0.05) / (Math.min(...lights) + 0.05);
}"""


@pytest.mark.parametrize(("width", "height"), [(1440, 900), (1024, 768), (360, 740)])
def test_picture_chart_and_check_are_in_sight_while_one_edits(page: Page, served: str, width: int, height: int) -> None:
    page.set_viewport_size({"width": width, "height": height})
    open_playground(page, served)

    page.locator(".cm-line").first.click()
    for key in ("Control+Home", "Control+End"):
        page.keyboard.press(key)
        for part in (".cm-cursor-primary", ".pg-stage", ".pg-chart", ".pg-check"):
            expect(page.locator(part)).to_be_in_viewport(ratio=1)


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("name", ["Run", "Check my fix"])
def test_a_button_under_the_pointer_can_be_read(page: Page, served: str, name: str, scheme: Any) -> None:
    page.emulate_media(color_scheme=scheme)
    open_playground(page, served)
    button = page.get_by_role("button", name=name, exact=True)
    before = button.evaluate("button => getComputedStyle(button).backgroundColor")

    button.hover()

    assert button.evaluate("button => getComputedStyle(button).backgroundColor") != before
    assert button.evaluate(CONTRAST) > 4.5


def test_the_chart_shows_the_broken_run_beside_the_reader_s_and_tells_both(page: Page, served: str) -> None:
    open_playground(page, served)
    page.get_by_label("Show the fix").select_option("default-masks")
    page.get_by_label("Speed", exact=True).select_option("10")
    page.get_by_role("button", name="Run", exact=True).click()
    page.wait_for_function("parseFloat(document.querySelector('.pg-clock').value) > 2", timeout=LIMIT)
    page.get_by_role("button", name="Pause").click()
    expect(page.locator(".pg-asked")).to_have_text("The check asks, at the end: between 0.045 and 0.053 m.")
    chart, told = page.locator(".pg-chart .u-over"), page.locator(".pg-newest")
    both = page.locator(".pg-chart").screenshot()

    box = chart.bounding_box()
    assert box
    seconds = max(2, page.locator(".pg-clock").evaluate("clock => parseFloat(clock.value)"))
    chart.hover(position={"x": 1.9 / seconds * box["width"], "y": 20})
    expect(told).to_have_text(re.compile(r"^at \d\.\d+ s: yours 0\.0498\d m, broken -1\d(?:\.\d+)? m$"))

    page.get_by_label("broken", exact=True).uncheck()
    chart.hover(position={"x": 1.8 / seconds * box["width"], "y": 20})
    expect(told).to_have_text(re.compile(r"^at .* s: yours \S+ m$"))
    assert page.locator(".pg-chart").screenshot() != both


def test_a_check_that_fails_says_what_it_guards(page: Page, served: str) -> None:
    open_playground(page, served, "servo-sags")
    assert check(page) == "no"
    expect(page.locator(".pg-told li").first).to_contain_text("This is the symptom: the broken model fails it as well.")

    stiff = edited(page, 'joint="shoulder"/>', 'joint="shoulder" kp="400"/>')
    type_text(page, stiff.replace('damping="1"', 'damping="0"'))
    assert check(page) == "no"
    expect(page.locator(".pg-told li").first).to_contain_text(
        "The broken model passes this: it guards against repairs that spoil something else"
    )


def test_a_remedy_that_does_not_help_says_why(page: Page, served: str) -> None:
    open_playground(page, served, "servo-sags")
    page.get_by_label("Show the fix").select_option("more-damping")
    assert check(page) == "no"
    expect(page.locator(".pg-refuted")).to_contain_text(
        "Damp the joint three times more: An arm that drops seems to want holding back."
    )


def test_the_keyboard_runs_and_checks(page: Page, served: str) -> None:
    open_playground(page, served)
    page.locator(".pg-stage canvas").press("Space")
    expect(page.locator(".pg-run")).to_have_text("Pause")
    wait_for_steps(page)
    page.locator(".pg-stage canvas").press("Space")
    expect(page.locator(".pg-run")).to_have_text("Run")

    second = page.locator(".cm-line").nth(1)
    text = second.inner_text()
    assert text.strip()
    page.locator(".cm-content").press("Control+Enter")

    expect(page.locator(".pg-result")).to_have_attribute("data-well", "no")
    expect(second).to_have_text(text)


def test_an_actuator_is_held_and_given_back(page: Page, served: str) -> None:
    open_playground(page, served, "elbow-will-not-bend")
    page.get_by_text("Controls", exact=True).click()
    page.get_by_role("button", name="Step").click()
    told = page.locator(".pg-sliders output")
    expect(told).to_have_text("2")

    page.get_by_label("Control of elbow").fill("-1.5")
    expect(told).to_have_text("-1.5")
    page.get_by_role("button", name="Step").click()
    expect(told).to_have_text("-1.5")

    page.get_by_role("button", name="Give them back").click()
    page.get_by_role("button", name="Step").click()
    expect(told).to_have_text("2")


@pytest.mark.parametrize("lost", ["start.js", "playground.json"])
def test_offline_it_says_so_and_is_tried_again(fresh: Page, served: str, lost: str) -> None:
    fresh.goto(address(served))
    fresh.route(f"**/{lost}", lambda route: route.abort())
    button = fresh.get_by_role("button", name="Run the broken model")
    button.click()
    expect(fresh.get_by_text("The playground could not be fetched. Are you offline?")).to_be_visible()
    assert no_engine(fresh)

    fresh.unroute(f"**/{lost}")
    button.click()

    fresh.wait_for_function("document.querySelector('.pg-clock')?.dataset.steps", timeout=LIMIT)


def test_an_engine_that_cannot_be_fetched_is_tried_again(fresh: Page, served: str) -> None:
    fresh.goto(address(served))
    fresh.context.route("**/mujoco.wasm.gz", lambda route: route.abort())
    fresh.get_by_role("button", name="Run the broken model").click()
    expect(fresh.locator(".pg-complaint")).to_contain_text("The engine could not be fetched. Are you offline?")

    fresh.context.unroute("**/mujoco.wasm.gz")
    fresh.get_by_role("button", name="Try again").click()

    fresh.wait_for_function("document.querySelector('.pg-clock')?.dataset.steps", timeout=LIMIT)
    expect(fresh.locator(".pg-complaint")).to_be_empty()


def test_nothing_tells_the_cause_before_it_is_asked_for(page: Page, served: str, cases: list[Case]) -> None:
    for case in cases:
        record = json.loads(playground(case, cases))
        hidden = [signal["label"] for signal in record["signals"].values() if not signal["seen"]]
        first = record["hints"][0]["text"]
        assert not [label for label in hidden if f" {label}, " in first], f"{case.slug}: {first}"

    open_playground(page, served)
    record = json.loads(playground(next(case for case in cases if case.slug == "box-falls-through-floor"), cases))
    options = page.locator(".pg option").all_inner_texts()
    assert not {fix["title"] for fix in record["fixes"]} & {*options}
    assert not [text for text in options if "contype" in text], options

    page.get_by_label("Signal", exact=True).select_option(label="more, which may tell the cause")
    page.get_by_label("Signal", exact=True).select_option(label="contype of the floor")
