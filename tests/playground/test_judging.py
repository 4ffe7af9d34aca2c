"""The playground in a real browser: a text is edited, compiled, judged and handed on."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from live import LIMIT, check, engines, open_playground, restore, run, type_text, wait_for_steps
from playwright.sync_api import Page, expect
from project import ROOT

pytestmark = pytest.mark.xdist_group("site")

MODELS = sorted(path.parent.name for path in ROOT.glob("cases/*/model.xml"))
WRONG = '<mujoco>\n  <worldbody>\n    <geom size="one"/>\n  </worldbody>\n</mujoco>\n'
DEEP = "<mujoco><worldbody>" + 400 * '<body><joint/><geom size="1"/>' + 400 * "</body>" + "</worldbody></mujoco>"
HUGE = (
    '<mujoco><asset><hfield name="h" nrow="9000" ncol="9000" size="1 1 1 1"/></asset><worldbody>'
    '<geom type="hfield" hfield="h"/><body pos="0 0 1"><freejoint/><geom size="1"/></body></worldbody></mujoco>'
)
HOSTILE = '<!-- <img src="x" onerror="window.harmed = true"><script>window.harmed = true</script> -->\n<mujoco/>\n'


@pytest.mark.parametrize("name", MODELS)
def test_every_model_runs_and_is_judged(page: Page, served: str, name: str) -> None:
    open_playground(page, served, name)
    run(page)
    assert check(page) == "no"

    record = page.evaluate("fetch('playground.json').then(response => response.json())")
    fix = record["fixes"][0]["id"]  # Node judges all that records hold: see test_parity.py
    page.get_by_label("Show the fix").select_option(fix)
    expect(page.locator(".cm-changedLine, .cm-deletedChunk").first).to_be_attached()
    assert check(page) == "yes", f"{fix}: {page.locator('.pg-result').inner_text()}"
    assert page.locator(".pg-result tbody tr").count() > len(record["checks"]["fixed"])


def test_a_compile_error_stands_at_its_line_and_the_last_model_goes_on(page: Page, served: str) -> None:
    open_playground(page, served)
    type_text(page, WRONG)

    expect(page.locator(".pg-complaint")).to_contain_text("Line 3: XML Error: bad format in attribute 'size'")
    expect(page.locator(".cm-lintRange-error")).to_contain_text('<geom size="one"/>')
    run(page)
    assert check(page) == ""

    restore(page)
    expect(page.locator(".cm-lintRange-error")).to_have_count(0)


def test_a_text_that_was_edited_during_its_check_is_not_judged(page: Page, served: str) -> None:
    open_playground(page, served)
    text = page.evaluate("fetch('playground.json').then(response => response.json())")["text"]
    slow = text.replace("<visual>", '<option timestep="1e-6"/><visual>')
    type_text(page, slow)
    button = page.get_by_role("button", name="Check my fix")
    button.click()
    expect(page.locator(".pg-result")).to_contain_text("Checking..")
    type_text(page, slow + "<!-- edited -->")

    expect(button).to_be_enabled()

    expect(page.locator(".pg-result")).to_have_text("The text was edited during the check. Check again.")


@pytest.mark.parametrize("text", [DEEP, HUGE], ids=["crashing", "endless"])
def test_a_model_that_ends_the_engine_leaves_the_page_usable(page: Page, served: str, text: str) -> None:
    open_playground(page, served)
    type_text(page, text)
    expect(page.locator(".pg-complaint")).not_to_be_empty()

    restore(page)

    run(page)
    assert check(page) == "no"


def test_a_tiny_timestep_is_not_judged_and_harms_nothing(page: Page, served: str) -> None:
    open_playground(page, served)
    type_text(
        page,
        '<mujoco><option timestep="1e-9"/><worldbody><body><freejoint/><geom size="1"/></body></worldbody></mujoco>',
    )

    assert check(page) == ""
    expect(page.locator(".pg-result")).to_contain_text(
        "2 s at a timestep of 1e-9 s: a run must take 1 to 2,000,000 steps"
    )

    restore(page)
    assert check(page) == "no"


def test_a_link_brings_the_text_back_and_runs_nothing(page: Page, served: str) -> None:
    open_playground(page, served)
    type_text(page, HOSTILE)
    page.get_by_role("button", name="Copy link").click()
    link = page.locator(".pg-address")
    expect(link).to_have_value(re.compile("#model="))
    there = link.input_value()

    page.goto("about:blank")
    page.goto(there)

    expect(page.locator(".cm-content")).to_contain_text('<img src="x" onerror="window.harmed = true">')
    assert engines(page) == []
    assert page.evaluate("window.harmed") is None
    assert page.locator(".pg img, .pg script").count() == 0

    page.get_by_role("button", name="Run", exact=True).click()
    page.wait_for_function("document.querySelector('.pg-clock')?.dataset.steps", timeout=LIMIT)
    assert page.evaluate("window.harmed") is None


def test_a_link_to_a_text_that_does_not_compile_says_so(page: Page, served: str) -> None:
    open_playground(page, served)
    type_text(page, WRONG)
    page.get_by_role("button", name="Copy link").click()
    expect(page.locator(".pg-address")).to_have_value(re.compile("#model="))
    expect(page.locator(".pg-status")).to_contain_text("This runs in MuJoCo")
    there = page.locator(".pg-address").input_value()
    page.goto("about:blank")
    page.goto(there)

    page.get_by_role("button", name="Run", exact=True).click()
    wait_for_steps(page)

    expect(page.locator(".pg-complaint")).to_contain_text("Line 3: XML Error: bad format in attribute 'size'")
    expect(page.locator(".cm-lintRange-error")).to_contain_text('<geom size="one"/>')


def test_solved_cases_are_ticked_until_the_reader_forgets_them(page: Page, served: str) -> None:
    forget = page.get_by_role("button", name="Forget which cases I solved")
    page.goto(served + "index.html")
    expect(forget).to_be_hidden()
    open_playground(page, served)
    page.get_by_label("Show the fix").select_option("default-masks")
    assert check(page) == "yes"

    page.goto(served + "index.html")
    expect(page.locator(".case[data-solved]")).to_have_count(1)
    expect(page.locator(".case[data-solved]")).to_contain_text("falls through the floor")

    forget.click()
    expect(page.locator(".case[data-solved]")).to_have_count(0)
    expect(forget).to_be_hidden()


def test_the_fix_that_is_shown_is_named_until_the_text_is_edited(page: Page, served: str) -> None:
    open_playground(page, served)
    shown = page.get_by_label("Show the fix")
    shown.select_option("default-masks")
    expect(page.locator(".cm-changedLine, .cm-deletedChunk").first).to_be_attached()
    expect(shown).to_have_value("default-masks")

    page.locator(".cm-content").press("Enter")

    expect(shown).to_have_value("")


def test_hints_come_one_by_one_and_end_at_the_diagnosis(page: Page, served: str) -> None:
    open_playground(page, served)
    hints = page.locator(".pg-hints li")
    expect(hints).to_have_count(0)

    page.get_by_role("button", name="Give me a hint").click()
    expect(hints).to_contain_text(
        "Repaired, contacts, at the end: above 0.5; height of the box, at the end: between 0.045 and 0.053 m"
    )
    page.get_by_role("button", name="Another hint").click()
    expect(hints).to_have_count(2)
    page.get_by_role("button", name="Open the diagnosis").click()

    expect(page.get_by_text("contype 2 conaffinity 2")).to_be_visible()


def test_the_text_is_downloaded_as_it_stands(page: Page, served: str) -> None:
    open_playground(page, served)
    type_text(page, WRONG)

    with page.expect_download() as download:
        page.get_by_role("button", name="Download XML").click()

    assert Path(download.value.path()).read_text(encoding="utf-8") == WRONG
