"""The playground's judgement in a real browser: whatever passes is right, and nothing else is."""

from __future__ import annotations

import pytest
from live import check, open_playground, restore, run, type_text
from playwright.sync_api import Page, expect
from project import ROOT

pytestmark = pytest.mark.xdist_group("site")
MODELS = sorted(path.parent.name for path in ROOT.glob("cases/*/model.xml"))


@pytest.mark.parametrize("name", MODELS)
def test_every_model_runs_and_is_judged(page: Page, served: str, name: str) -> None:
    open_playground(page, served, name)
    run(page)
    assert check(page) == "no"

    record = page.evaluate("fetch('playground.json').then(response => response.json())")
    fix = record["fixes"][0]["id"]  # Node judges all that records hold: see test_engine.py
    page.get_by_label("Show the fix").select_option(fix)
    expect(page.locator(".cm-changedLine, .cm-deletedChunk").first).to_be_attached()
    assert check(page) == "yes", f"{fix}: {page.locator('.pg-result').inner_text()}"
    assert page.locator(".pg-result tbody tr").count() > len(record["checks"]["fixed"])


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
