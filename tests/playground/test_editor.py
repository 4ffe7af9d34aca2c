"""The playground's editor in a real browser: a text is edited, compiled and handed on, and nothing of it acts."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from live import check, engines, open_playground, restore, run, type_text, wait_for_steps
from playwright.sync_api import Page, expect

pytestmark = pytest.mark.xdist_group("site")
WRONG = '<mujoco>\n  <worldbody>\n    <geom size="one"/>\n  </worldbody>\n</mujoco>\n'
DEEP = "<mujoco><worldbody>" + 400 * '<body><joint/><geom size="1"/>' + 400 * "</body>" + "</worldbody></mujoco>"
HUGE = (
    '<mujoco><asset><hfield name="h" nrow="9000" ncol="9000" size="1 1 1 1"/></asset><worldbody>'
    '<geom type="hfield" hfield="h"/><body pos="0 0 1"><freejoint/><geom size="1"/></body></worldbody></mujoco>'
)
HOSTILE = f'<!-- <img src="x" onerror="window.harmed = true"><script>window.harmed = true</script> -->\n{WRONG}'


def test_a_compile_error_stands_at_its_line_and_the_last_model_goes_on(page: Page, served: str) -> None:
    open_playground(page, served)
    type_text(page, WRONG)

    expect(page.locator(".pg-complaint")).to_contain_text("Line 3: XML Error: bad format in attribute 'size'")
    expect(page.locator(".cm-lintRange-error")).to_contain_text('<geom size="one"/>')
    run(page)
    assert check(page) == ""

    restore(page)
    expect(page.locator(".cm-lintRange-error")).to_have_count(0)


@pytest.mark.parametrize("text", [DEEP, HUGE], ids=["crashing", "endless"])
def test_a_model_that_ends_the_engine_leaves_the_page_usable(page: Page, served: str, text: str) -> None:
    open_playground(page, served)
    type_text(page, text)
    expect(page.locator(".pg-complaint")).not_to_be_empty()

    restore(page)

    run(page)
    assert check(page) == "no"


def test_a_link_brings_the_text_back_and_runs_nothing_before_it_is_asked_to(page: Page, served: str) -> None:
    open_playground(page, served)
    type_text(page, HOSTILE)
    page.get_by_role("button", name="Copy link").click()
    link = page.locator(".pg-address")
    expect(link).to_have_value(re.compile("#model="))
    expect(page.locator(".pg-status")).to_contain_text("This runs in MuJoCo")
    there = link.input_value()

    page.goto("about:blank")
    page.goto(there)

    expect(page.locator(".cm-content")).to_contain_text('<img src="x" onerror="window.harmed = true">')
    assert engines(page) == []

    page.get_by_role("button", name="Run", exact=True).click()
    wait_for_steps(page)

    expect(page.locator(".pg-complaint")).to_contain_text("Line 4: XML Error: bad format in attribute 'size'")
    expect(page.locator(".cm-lintRange-error")).to_contain_text('<geom size="one"/>')
    assert page.evaluate("window.harmed") is None
    assert page.locator(".pg img, .pg script").count() == 0


def test_the_fix_that_is_shown_is_named_until_the_text_is_edited(page: Page, served: str) -> None:
    open_playground(page, served)
    shown = page.get_by_label("Show the fix")
    shown.select_option("default-masks")
    expect(page.locator(".cm-changedLine, .cm-deletedChunk").first).to_be_attached()
    expect(shown).to_have_value("default-masks")

    page.locator(".cm-content").press("Enter")

    expect(shown).to_have_value("")


def test_the_text_is_downloaded_as_it_stands(page: Page, served: str) -> None:
    open_playground(page, served)
    type_text(page, WRONG)

    with page.expect_download() as download:
        page.get_by_role("button", name="Download XML").click()

    assert Path(download.value.path()).read_text(encoding="utf-8") == WRONG


def test_elements_and_attributes_are_offered_with_the_manual_s_sentence(page: Page, served: str) -> None:
    open_playground(page, served)
    page.set_viewport_size({"width": 1280, "height": 900})
    options = page.locator(".cm-tooltip-autocomplete li")
    page.locator(".cm-line", has_text="<freejoint").click()
    page.keyboard.press("End")
    page.keyboard.press("Enter")

    page.keyboard.type("<")
    expect(options.get_by_text("geom", exact=True)).to_be_attached()
    page.keyboard.type("geo")
    expect(options).to_have_text(["geom"])
    page.keyboard.press("Enter")
    page.keyboard.type("cont")
    expect(options.first).to_contain_text("contype")
    expect(page.locator(".cm-completionInfo")).to_contain_text("32-bit integer bitmasks used for contact filtering")
    page.keyboard.press("Enter")
    page.keyboard.type("1")

    expect(page.locator(".cm-line", has_text='contype="1"')).to_have_text('      <geom contype="1"/>')


def test_a_value_of_a_few_is_offered_and_what_the_engine_is_too_old_for_is_named(page: Page, served: str) -> None:
    open_playground(page, served)
    options = page.locator(".cm-tooltip-autocomplete li")
    type_text(page, "")
    page.keyboard.type('<mujoco><option integrator="imp')
    expect(options).to_have_text(["implicit", "implicitfast"])
    page.keyboard.press("Escape")
    type_text(page, "")
    page.keyboard.type("<mujoco><option><flag specul")
    expect(options).to_contain_text(["needs MuJoCo 4.0; this page runs 3."])


def test_the_manual_s_sentence_stands_under_the_pointer(page: Page, served: str) -> None:
    open_playground(page, served)
    expect(page.locator(".pg-status")).to_contain_text("This runs in MuJoCo")
    word = page.locator(".cm-line", has_text="<freejoint").get_by_text("freejoint", exact=True)
    word.hover()
    page.wait_for_function("'document$' in globalThis")  # the theme has come: nothing moves any more
    page.mouse.move(0, 0)
    word.hover()
    expect(page.locator(".cm-tooltip-hover")).to_contain_text("This element creates a free joint")
