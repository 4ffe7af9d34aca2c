"""The playground's judgement in a real browser: whatever passes is right, and nothing else is."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import pytest
from live import check, edited, open_playground, restore, run, type_text
from playwright.sync_api import Page, Route, expect
from project import ROOT

pytestmark = pytest.mark.xdist_group("site")
MODELS = sorted(path.parent.name for path in ROOT.glob("cases/*/model.xml"))


@pytest.mark.parametrize("name", MODELS)
def test_every_model_runs_and_is_judged(page: Page, served: str, name: str) -> None:
    open_playground(page, served, name)
    run(page)
    assert check(page) == "no"

    record = page.evaluate("fetch('playground.json').then(response => response.json())")
    fix = next(
        one["id"] for one in record["fixes"] if not one["needs"]
    )  # Node judges all that records hold: see test_engine.py
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
    expect(page.locator(".pg-result")).to_contain_text(re.compile(r"Checking the case's own run\.[1-9]\d* %"))
    type_text(page, slow + "<!-- edited -->")

    expect(button).to_be_enabled()

    expect(page.locator(".pg-result")).to_have_text("The text was edited during the check. Check again.")


def test_a_tiny_timestep_is_not_judged_and_harms_nothing(page: Page, served: str) -> None:
    open_playground(page, served)
    type_text(
        page,
        '<mujoco><option timestep="1e-9"/><worldbody><body><freejoint/><geom size="1"/></body></worldbody></mujoco>',
    )

    assert check(page) == "no"
    expect(page.locator(".pg-told")).to_contain_text("You removed or renamed body box.")
    expect(page.locator(".pg-told")).to_contain_text(
        "In the trial 'Dropped from twice the height' it cannot be run: "
        "2 s at a timestep of 1e-9 s: a run must take 1 to 2,000,000 steps"
    )

    restore(page)
    assert check(page) == "no"


def test_a_repair_is_refused_for_the_task_and_for_a_trial_and_a_true_one_is_accepted(page: Page, served: str) -> None:
    open_playground(page, served, "servo-sags")
    result, told = page.locator(".pg-result"), page.locator(".pg-told li")

    type_text(page, edited(page, "<visual>", '<option gravity="0 0 0"/><visual>'))
    assert check(page) == "no"
    expect(result).to_contain_text("Not repaired: the task was changed")
    expect(told.first).to_have_text("You turned gravity off.")

    type_text(page, edited(page, 'joint="shoulder"/>', 'joint="shoulder" kp="30" kv="5"/>'))
    assert check(page) == "no"
    expect(told.last).to_contain_text(re.compile(r"^In the trial 'Sent half a radian up': angle .* expected between"))

    type_text(page, edited(page, 'joint="shoulder"/>', 'joint="shoulder" kp="400" kv="20"/>'))
    assert check(page) == "yes"
    expect(result).to_contain_text("Repaired: every check holds in the case's own run and in its 3 trials.")
    expect(told).to_have_count(0)
    page.get_by_text("All that was measured").click()
    expect(result.get_by_text("Trial: With twice the load")).to_be_visible()


def test_a_check_is_stopped_in_a_trial(page: Page, served: str) -> None:
    change_record(page, lambda record: record["trials"][0].update(duration=1900))
    open_playground(page, served, "box-falls-through-floor")
    page.get_by_role("button", name="Check my fix").click()
    result = page.locator(".pg-result")
    expect(result).to_contain_text(re.compile(r"Checking the trial 'Dropped from twice the height' \(1 of \d\)\."))

    page.get_by_role("button", name="Stop checking").click()

    expect(result).to_have_text("Stopped.")


def test_a_fix_that_the_engine_is_too_old_for_says_so(page: Page, served: str) -> None:
    new = {"id": "new", "title": "Look ahead", "needs": "4.0"}
    flag = '<option><flag speculative="enable"/></option><visual>'
    change_record(
        page, lambda record: record["fixes"].append({**new, "edits": [{"find": "<visual>", "replace": flag}]})
    )
    open_playground(page, served)

    page.get_by_label("Show the fix").select_option(label="fix 3 of 3 (needs MuJoCo 4.0)")

    said = re.compile(r"MuJoCo 3\.\d+\.0, which does not know `speculative`; `clinic judge` with MuJoCo 4\.0 does\.")
    expect(page.locator(".pg-complaint")).to_contain_text(said)
    assert check(page) == ""
    expect(page.locator(".pg-result")).to_contain_text(said)


def change_record(page: Page, change: Callable[[dict[str, Any]], object]) -> None:
    """Gives the page a record that is changed, once."""

    def answer(route: Route) -> None:
        record = route.fetch().json()
        change(record)
        route.fulfill(json=record)

    page.route("**/playground.json", answer, times=1)


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
    expect(hints).to_have_text(
        "The symptom in numbers: as it is, height of the box, at the end: -19.1 ± 0.1 m. "
        "Repaired, height of the box, at the end: between 0.045 and 0.053 m."
    )
    page.get_by_role("button", name="Another hint").click()
    page.get_by_role("button", name="Another hint").click()
    expect(hints.last).to_contain_text("Repaired, contacts, at the end: above 0.5")
    page.get_by_role("button", name="Open the diagnosis").click()

    expect(page.get_by_text("contype 2 conaffinity 2")).to_be_visible()
