"""A code case on its page, in a real browser: its script is edited, run and judged there, its instrument answers."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
import yaml
from clinic.record.case import Case, load_case
from clinic.record.folder import INSTRUMENT
from helpers import changed
from live import address, type_text
from playwright.sync_api import Page, expect
from project import ROOT

pytestmark = pytest.mark.xdist_group("site")
CASE = "javascript-view-goes-dead"
REPAIRS = yaml.safe_load((ROOT / "tests/proof/repairs.yaml").read_text(encoding="utf-8"))[CASE]
INSTRUMENTS = sorted(path.parent.name for path in ROOT.glob(f"cases/*/{INSTRUMENT}"))
NETWORK = """
const names = ["fetch", "XMLHttpRequest", "WebSocket", "EventSource", "importScripts", "Worker"];
console.log(names.map((name) => typeof globalThis[name]).join(" "));
"""


@pytest.fixture(scope="module")
def case() -> Case:
    return load_case(ROOT / "cases" / CASE)


def open_bench(page: Page, served: str) -> None:
    page.goto(address(served, CASE))
    page.get_by_role("button", name="Edit and run the broken script").click()
    expect(page.locator(".cm-content")).to_be_visible()


def press(page: Page, name: str) -> None:
    page.get_by_role("button", name=name, exact=True).click()
    expect(page.get_by_role("button", name=name, exact=True)).to_be_enabled()


def test_it_prints_what_the_page_says(page: Page, served: str) -> None:
    open_bench(page, served)
    assert not page.locator(".pg-output").inner_text(), "nothing runs before it is asked to"
    press(page, "Run")

    evidence = page.evaluate("fetch('evidence.json').then(response => response.json())")
    traces: dict[str, Any] = evidence["variants"]["broken"]["traces"]
    printed = page.locator(".pg-output").inner_text()
    assert printed.count("drawn angle = undefined rad") == 3
    assert f"frames drawn = {traces['frames']['value'][-1]:g}" in printed
    (angle,) = re.findall(r"simulated angle = (\S+) rad", printed)[-1:]
    assert float(angle) == pytest.approx(traces["angle"]["value"][-1], rel=1e-4)


def test_every_repair_is_judged_as_the_terminal_judges_it(page: Page, served: str, case: Case) -> None:
    open_bench(page, served)
    texts = {
        f"fix {fix.id}": ("yes", [part for e in fix.edits for part in (e.find, e.replace)]) for fix in case.record.fixes
    }
    for kind, well in (("right", "yes"), ("wrong", "no")):
        texts |= {name: (well, edits) for name, edits in REPAIRS[kind].items()}
    for name, (well, edits) in texts.items():
        type_text(page, changed(case.text, *zip(edits[::2], edits[1::2], strict=True)))
        press(page, "Check my fix")
        assert page.locator(".pg-result").get_attribute("data-well") == well, (
            f"{name}: {page.locator('.pg').inner_text()}"
        )


def test_what_a_script_says_when_it_fails_stands_at_its_line(page: Page, served: str, case: Case) -> None:
    open_bench(page, served)
    type_text(page, case.text.replace("let ghost,", "nothing.at.all;\nlet ghost,"))
    press(page, "Run")

    line = case.text.splitlines().index("let ghost, frames = 0;") + 1
    expect(page.locator(".pg-complaint")).to_have_text(f"Line {line}: ReferenceError: nothing is not defined")
    expect(page.locator(".cm-lintRange-error")).to_have_text("nothing.at.all;")

    type_text(page, case.text.replace('from "node:fs"', 'from "node:net"'))
    press(page, "Run")
    expect(page.locator(".pg-complaint")).to_have_text(
        "node:net cannot be imported here: only @mujoco/mujoco and node:fs"
    )


def test_a_script_has_no_network(page: Page, served: str) -> None:
    open_bench(page, served)
    type_text(page, NETWORK)
    press(page, "Run")
    expect(page.locator(".pg-output")).to_have_text(" ".join(["undefined"] * 6))

    for hidden in (
        'const far = await import("./evidence.json");',
        'export { far } from "./evidence.json";',
        """const far = await Function("return im" + "port('./evidence.json')")();""",
        """const far = await (() => {}).constructor("return im" + "port('./evidence.json')")();""",
    ):
        type_text(page, hidden)
        press(page, "Run")
        expect(page.locator(".pg-complaint")).to_contain_text("the word import is for lines of its own here")

    type_text(page, 'const far = await (async () => {}).constructor("return 1")();')
    press(page, "Run")
    expect(page.locator(".pg-complaint")).to_contain_text("is not a function")


def test_an_endless_script_can_be_stopped(page: Page, served: str) -> None:
    open_bench(page, served)
    type_text(page, "for (;;);")
    page.get_by_role("button", name="Run", exact=True).click()
    page.get_by_role("button", name="Stop").click()
    expect(page.locator(".pg-complaint")).to_have_text("It was stopped.")
    type_text(page, 'console.log("again");')
    press(page, "Run")
    expect(page.locator(".pg-output")).to_have_text("again")


def test_a_link_brings_the_text_and_runs_nothing(page: Page, served: str) -> None:
    open_bench(page, served)
    type_text(page, 'console.log("from a link");')
    page.get_by_role("button", name="Copy link").click()
    link = page.locator(".pg-address")
    expect(link).to_have_value(re.compile("#model="))
    there = link.input_value()

    page.goto("about:blank")
    page.goto(there)

    expect(page.locator(".cm-content")).to_contain_text("from a link")
    expect(page.locator(".pg-file")).to_contain_text("Nothing runs until you press Run")
    expect(page.locator(".pg-output")).to_be_empty()


def readings(page: Page) -> str:
    return page.locator(".pg-readings").inner_text()


@pytest.mark.parametrize("of", INSTRUMENTS)
def test_an_instrument_answers_each_of_its_controls(page: Page, served: str, of: str) -> None:
    page.goto(address(served, of))
    page.get_by_role("button", name="Try it on the engine").click()
    expect(page.locator(".pg-readings tr").first).to_be_visible()
    controls = page.get_by_role("group", name="Instrument")
    first = readings(page)
    for slider in controls.get_by_role("slider").all():
        for end in ("Home", "End"):
            before = readings(page)
            slider.press(end)
            if slider.input_value() != slider.get_attribute("value"):
                expect(page.locator(".pg-readings")).not_to_have_text(before, use_inner_text=True)
    for button in controls.get_by_role("button").all():
        button.click()
    expect(page.locator(".pg-readings")).not_to_have_text(first, use_inner_text=True)
    expect(page.locator(".pg-complaint")).to_be_empty()
    assert "NaN" not in readings(page)


def test_an_instrument_reads_what_the_record_measured(page: Page, served: str) -> None:
    page.goto(address(served, "stale-first-observation"))
    page.get_by_role("button", name="Try it on the engine").click()
    expect(page.locator(".pg-readings")).to_contain_text("0.000 mm")
    page.get_by_role("button", name="write another pose into qpos").click()
    expect(page.locator(".pg-readings")).to_contain_text("382.159 mm")
    page.get_by_role("button", name="mj_forward").click()
    expect(page.locator(".pg-readings")).to_contain_text("0.000 mm")


def test_an_instrument_belongs_to_a_case_with_a_script(tmp_path: Path) -> None:
    from clinic.record.problem import CaseError
    from helpers import tiny_case

    tiny_case(tmp_path)
    (folder,) = (path.parent for path in tmp_path.rglob("case.yaml"))
    (folder / INSTRUMENT).write_text("export default class {}", encoding="utf-8")
    with pytest.raises(CaseError, match="a file that the record does not name"):
        load_case(folder)
