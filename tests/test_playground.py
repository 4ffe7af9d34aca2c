"""What the playground is given, and the playground in a real browser, on the built site."""

from __future__ import annotations

import gzip
import json
import re
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from clinic.bundle import node
from clinic.playground import playground
from helpers import tiny_case
from playwright.sync_api import Browser, BrowserContext, Error, Page, TimeoutError, expect
from test_browser import browser, served  # noqa: F401
from test_site import site  # noqa: F401

pytestmark = pytest.mark.xdist_group("site")
ROOT = Path(__file__).parent.parent
MODELS = sorted(path.parent.name for path in ROOT.glob("cases/*/model.xml"))
CASE = "box-falls-through-floor"
WRONG = '<mujoco>\n  <worldbody>\n    <geom size="one"/>\n  </worldbody>\n</mujoco>\n'
DEEP = "<mujoco><worldbody>" + 400 * '<body><joint/><geom size="1"/>' + 400 * "</body>" + "</worldbody></mujoco>"
HUGE = (
    '<mujoco><asset><hfield name="h" nrow="9000" ncol="9000" size="1 1 1 1"/></asset><worldbody>'
    '<geom type="hfield" hfield="h"/><body pos="0 0 1"><freejoint/><geom size="1"/></body></worldbody></mujoco>'
)
HOSTILE = '<!-- <img src="x" onerror="window.harmed = true"><script>window.harmed = true</script> -->\n<mujoco/>\n'
PASTE = """(editor, text) => {
  const clipboardData = new DataTransfer();
  clipboardData.setData("text/plain", text);
  editor.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true, cancelable: true }));
}"""
LIMIT = 60_000  # ms: how long anything may take on a busy machine; nothing here judges how long it did take
PULLS = 4
BEFORE_THE_CLICK, AFTER_THE_CLICK = 2_000, 1_700_000  # bytes

expect.set_options(timeout=LIMIT)


@pytest.fixture
def page(browser: Browser) -> Iterator[Page]:  # noqa: F811
    """A small page on which nothing moves before it is asked to: drawing without a graphics card takes a processor."""
    context = browser.new_context(reduced_motion="reduce", viewport={"width": 600, "height": 600})
    yield context.new_page()
    context.close()


def address(served: str, slug: str = CASE) -> str:  # noqa: F811
    return f"{served}cases/{slug}/index.html"


def open_playground(page: Page, served: str, slug: str = CASE) -> None:  # noqa: F811
    page.goto(address(served, slug))
    page.get_by_role("button", name="Run the broken model").click()
    page.wait_for_function("document.querySelector('.pg-clock')?.dataset.steps", timeout=LIMIT)


def steps(page: Page) -> int:
    return int(page.locator(".pg-clock").get_attribute("data-steps") or 0)


def run(page: Page) -> None:
    """Runs the model until it has moved on, on the clock and in the picture, and stops it."""
    page.get_by_role("button", name="Run", exact=True).click()
    wait_for_steps(page)
    page.get_by_role("button", name="Pause").click()


def wait_for_steps(page: Page) -> None:
    before = steps(page)
    page.wait_for_function(f"document.querySelector('.pg-clock').dataset.steps > {before}", timeout=LIMIT)


def type_text(page: Page, text: str) -> None:
    """Puts a text in the place of all that stands in the editor, as a paste does."""
    editor = page.locator(".cm-content")
    editor.focus()
    page.keyboard.press("Control+a")
    editor.evaluate(PASTE, text)


def engines(page: Page) -> list[str]:
    return [worker.url for worker in page.workers if "playground" in worker.url]


def no_engine(page: Page) -> bool:
    """Whether every engine has ended, or is about to."""
    for worker in page.workers:
        if "playground" in worker.url:
            try:
                worker.evaluate(f"new Promise((done) => setTimeout(done, {LIMIT}))")
            except Error:  # it was closed
                continue
            return False
    return True


def restore(page: Page) -> None:
    page.get_by_role("button", name="Restore").click()
    expect(page.locator(".pg-complaint")).to_be_empty()


def check(page: Page) -> str:
    """Presses `Check my fix` and gives what it says: yes, no, or nothing when there is no judgement."""
    button = page.get_by_role("button", name="Check my fix")
    button.click()
    expect(button).to_be_enabled()
    return page.locator(".pg-result").get_attribute("data-well") or ""


def axe(page: Page) -> list[Any]:
    """Serious findings on the playground."""
    page.add_script_tag(path=str(ROOT / "node_modules/axe-core/axe.min.js"))
    found: list[Any] = page.evaluate("axe.run('.pg').then(found => found.violations)")
    return [
        (finding["id"], [node["html"] for node in finding["nodes"]])
        for finding in found
        if finding["impact"] in ("serious", "critical")
    ]


def test_the_file_holds_what_the_browser_needs(tmp_path: Path) -> None:
    spin = ("  contacts: {path: ncon}\n", "  contacts: {path: ncon}\n  spin: {path: 'cvel[1][2]', unit: rad/s}\n")
    case = tiny_case(tmp_path, spin, ("picture: {camera: side}", "picture: {camera: side}\nwarnings: [BADQACC]"))

    made = json.loads(playground(case, "4.0.0", [case]))

    assert made["text"] == case.text
    assert made["signals"]["spin"] == {"path": "cvel[1][2]", "unit": "rad/s", "label": "spin", "columns": [6]}
    assert made["signals"]["contacts"]["columns"] == []
    assert made["checks"]["fixed"] == [{"signal": "height", "take": "final", "between": [0.045, 0.051]}]
    assert made["explained"] == {
        "BADQACC": [{"href": "../falling-box/index.html", "title": "1. A box falls through the floor"}]
    }
    symptom, measure = made["hints"]
    assert symptom["text"].endswith("Repaired, height of the box, at the end: between 0.045 and 0.051 m.")
    assert measure["text"] == "after every step, height of the box, body(box).xpos[2]; contacts, ncon."


def test_a_late_picture_gets_coarser_and_an_early_one_finer_again() -> None:
    code = """
      const { Pace } = await import("./docs/playground/pace.js");
      const pace = new Pace(1.5);
      let now = 0;
      const after = (frames, interval) => {
        for (let i = 0; i < frames; i++) pace.drawn((now += interval));
        return pace.ratio;
      };
      const seen = [after(16, 16), after(160, 40), after(200, 27), after(1600, 16), after(200, 600)];
      console.log(JSON.stringify(seen));
    """
    done = subprocess.run(
        [node(), "--input-type=module", "-e", code], cwd=ROOT, check=True, capture_output=True, text=True
    )

    assert json.loads(done.stdout) == [1.5, 0.5, 0.5, 1.5, 1.5]


@pytest.mark.parametrize("name", MODELS)
def test_every_model_runs_and_is_judged(page: Page, served: str, name: str) -> None:  # noqa: F811
    open_playground(page, served, name)
    run(page)
    assert check(page) == "no"

    record = page.evaluate("fetch('playground.json').then(response => response.json())")
    fix = record["fixes"][0]["id"]  # Node judges all that records hold: see test_parity.py
    page.get_by_label("Show the fix").select_option(fix)
    expect(page.locator(".cm-changedLine, .cm-deletedChunk").first).to_be_attached()
    assert check(page) == "yes", f"{fix}: {page.locator('.pg-result').inner_text()}"
    assert page.locator(".pg-result tbody tr").count() > len(record["checks"]["fixed"])


def test_it_runs_by_itself_unless_the_reader_wants_less_motion(page: Page, served: str) -> None:  # noqa: F811
    open_playground(page, served)
    expect(page.locator(".pg-run")).to_have_text("Run")
    assert steps(page) == 0

    page.emulate_media(reduced_motion="no-preference")
    page.reload()
    open_playground(page, served)
    expect(page.locator(".pg-run")).to_have_text("Pause")
    wait_for_steps(page)


def test_the_picture_changes_while_it_runs(page: Page, served: str) -> None:  # noqa: F811
    open_playground(page, served)
    canvas = page.locator(".pg-stage canvas")
    before = canvas.screenshot()

    page.get_by_role("button", name="Step").evaluate("button => { for (let i = 0; i < 60; i++) button.click(); }")
    page.wait_for_function("document.querySelector('.pg-clock').dataset.steps >= 60", timeout=LIMIT)

    assert canvas.screenshot() != before


def test_a_compile_error_stands_at_its_line_and_the_last_model_goes_on(page: Page, served: str) -> None:  # noqa: F811
    open_playground(page, served)
    type_text(page, WRONG)

    expect(page.locator(".pg-complaint")).to_contain_text("Line 3: XML Error: bad format in attribute 'size'")
    expect(page.locator(".cm-lintRange-error")).to_contain_text('<geom size="one"/>')
    run(page)
    assert check(page) == ""

    restore(page)
    expect(page.locator(".cm-lintRange-error")).to_have_count(0)


def test_a_text_that_was_edited_during_its_check_is_not_judged(page: Page, served: str) -> None:  # noqa: F811
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
def test_a_model_that_ends_the_engine_leaves_the_page_usable(page: Page, served: str, text: str) -> None:  # noqa: F811
    open_playground(page, served)
    type_text(page, text)
    expect(page.locator(".pg-complaint")).not_to_be_empty()

    restore(page)

    run(page)
    assert check(page) == "no"


def test_a_tiny_timestep_is_not_judged_and_harms_nothing(page: Page, served: str) -> None:  # noqa: F811
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


def test_leaving_by_instant_navigation_leaves_no_worker_behind(page: Page, served: str) -> None:  # noqa: F811
    open_playground(page, served)
    assert len(engines(page)) == 1

    page.get_by_role("link", name="Six steps of triage").or_(
        page.locator("a.md-nav__link[href*=triage]")
    ).first.evaluate("a => a.click()")
    expect(page.locator("h1")).to_contain_text("Six steps of triage")
    assert page.evaluate("document.querySelector('.pg')") is None
    assert no_engine(page)

    page.go_back()
    page.get_by_role("button", name="Run the broken model").click()
    page.wait_for_function("document.querySelector('.pg-clock')?.dataset.steps", timeout=LIMIT)
    assert len(engines(page)) == 1


def test_a_link_brings_the_text_back_and_runs_nothing(page: Page, served: str) -> None:  # noqa: F811
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


def test_a_link_to_a_text_that_does_not_compile_says_so(page: Page, served: str) -> None:  # noqa: F811
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


def test_solved_cases_are_ticked_until_the_reader_forgets_them(page: Page, served: str) -> None:  # noqa: F811
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


def test_warnings_of_the_engine_link_to_what_explains_them(page: Page, served: str) -> None:  # noqa: F811
    open_playground(page, served, "arm-explodes")
    page.get_by_role("button", name="Run", exact=True).click()

    warning = page.locator(".pg-warnings li")
    expect(warning).to_contain_text("Nan, Inf or huge value in QACC")
    for link in warning.locator("a").all():
        answer = page.request.get(link.evaluate("a => a.href"))
        assert answer.ok, link.get_attribute("href")


def test_a_body_is_pulled_with_buttons_and_with_the_pointer(page: Page, served: str) -> None:  # noqa: F811
    open_playground(page, served)
    page.get_by_label("Show the fix").select_option("default-masks")
    page.get_by_label("Speed", exact=True).select_option("1")
    page.get_by_label("Signal", exact=True).select_option("height")
    page.get_by_role("button", name="Run", exact=True).click()
    page.wait_for_function("parseFloat(document.querySelector('.pg-newest').value) < 0.051", timeout=LIMIT)
    page.locator(".pg-fold summary").click()
    risen = "parseFloat(document.querySelector('.pg-newest').value) > 0.06"

    page.get_by_role("button", name="Pull the body up").click()
    page.wait_for_function(risen, timeout=LIMIT)

    page.get_by_role("button", name="Reset").click()
    page.get_by_role("button", name="Drag pulls").click()
    page.wait_for_function("parseFloat(document.querySelector('.pg-newest').value) < 0.051", timeout=LIMIT)
    page.locator(".pg-stage").scroll_into_view_if_needed()
    box = page.locator(".pg-stage canvas").bounding_box()
    assert box
    x, y = box["x"] + box["width"] / 2, box["y"] + 0.55 * box["height"]
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


def test_the_view_is_turned_with_buttons_and_with_the_pointer(page: Page, served: str) -> None:  # noqa: F811
    open_playground(page, served)
    page.locator(".pg-fold summary").click()
    canvas = page.locator(".pg-stage canvas")
    seen = [canvas.screenshot()]

    page.get_by_role("button", name="Turn the view left").click()
    seen.append(canvas.screenshot())
    page.get_by_role("button", name="Zoom in").click()
    seen.append(canvas.screenshot())
    canvas.drag_to(canvas, source_position={"x": 60, "y": 60}, target_position={"x": 160, "y": 90})
    seen.append(canvas.screenshot())

    assert len(set(seen)) == len(seen)


def test_overlays_are_off_until_asked_for(page: Page, served: str) -> None:  # noqa: F811
    open_playground(page, served, "grasp-slips")
    page.locator(".pg-fold summary").click()
    boxes = page.get_by_role("group", name="Overlays").get_by_role("checkbox")
    assert not any(box.is_checked() for box in boxes.all())

    page.get_by_role("button", name="Show what matters").click()

    assert [box.is_checked() for box in boxes.all()].count(True) == 2

    page.get_by_role("button", name="Show what matters", pressed=True).click()

    assert not any(box.is_checked() for box in boxes.all())


def test_the_fix_that_is_shown_is_named_until_the_text_is_edited(page: Page, served: str) -> None:  # noqa: F811
    open_playground(page, served)
    shown = page.get_by_label("Show the fix")
    shown.select_option("default-masks")
    expect(page.locator(".cm-changedLine, .cm-deletedChunk").first).to_be_attached()
    expect(shown).to_have_value("default-masks")

    page.locator(".cm-content").press("Enter")

    expect(shown).to_have_value("")


def test_hints_come_one_by_one_and_end_at_the_diagnosis(page: Page, served: str) -> None:  # noqa: F811
    open_playground(page, served)
    hints = page.locator(".pg-hints li")
    expect(hints).to_have_count(0)

    page.get_by_role("button", name="Give me a hint").click()
    expect(hints).to_contain_text(
        "Repaired, contacts, at the end: 4 exactly; height of the box, at the end: 0.05 ± 0.001 m"
    )
    page.get_by_role("button", name="Another hint").click()
    expect(hints).to_have_count(2)
    page.get_by_role("button", name="Open the diagnosis").click()

    expect(page.get_by_text("contype 2 conaffinity 2")).to_be_visible()


def test_the_text_is_downloaded_as_it_stands(page: Page, served: str) -> None:  # noqa: F811
    open_playground(page, served)
    type_text(page, WRONG)

    with page.expect_download() as download:
        page.get_by_role("button", name="Download XML").click()

    assert Path(download.value.path()).read_text(encoding="utf-8") == WRONG


def test_everything_is_reached_with_the_keyboard(page: Page, served: str) -> None:  # noqa: F811
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
def test_it_fits_and_has_no_serious_finding(browser: Browser, served: str, width: int, scheme: str) -> None:  # noqa: F811
    size: Any = {"color_scheme": scheme, "viewport": {"width": width, "height": 800}}
    context = browser.new_context(reduced_motion="reduce", **size)
    page = context.new_page()
    open_playground(page, served, "ball-passes-through-shelf")
    page.locator(".pg-fold summary").click()
    page.get_by_role("button", name="Give me a hint").click()
    page.get_by_label("Show the fix").select_option(index=1)
    check(page)
    page.get_by_role("button", name="Copy link").click()

    assert page.evaluate("document.documentElement.scrollWidth") <= width
    assert axe(page) == []
    context.close()


def test_what_is_fetched_before_and_after_the_click_is_small(page: Page, served: str, site: Path) -> None:  # noqa: F811
    loader = (site / "javascripts/playground/loader.js").stat().st_size
    fetched: list[str] = []
    page.on("request", lambda request: fetched.append(request.url.removeprefix(served).split("#")[0]))
    page.goto(address(served))
    markup = len(page.locator(".playground").evaluate("root => root.outerHTML"))
    assert [name for name in fetched if "playground" in name] == ["javascripts/playground/loader.js"]
    assert loader + markup < BEFORE_THE_CLICK

    fetched.clear()
    open_playground(page, served)

    files = {name for name in fetched if "playground" in name}
    assert "javascripts/playground/mujoco.wasm.gz" in files
    sizes = [
        len(content if name.endswith(".gz") else gzip.compress(content))
        for name in files
        if (content := (site / name).read_bytes())
    ]
    assert sum(sizes) < AFTER_THE_CLICK
    assert all(not name.startswith("http") for name in fetched), fetched


@pytest.fixture
def bare(browser: Browser) -> Iterator[BrowserContext]:  # noqa: F811
    context = browser.new_context(java_script_enabled=False)
    yield context
    context.close()


def test_without_scripts_a_sentence_stands_in_its_place(bare: BrowserContext, served: str) -> None:  # noqa: F811
    page = bare.new_page()
    page.goto(address(served))
    expect(page.get_by_text("Here the model runs live")).to_be_visible()
    expect(page.get_by_role("button", name="Run the broken model")).to_be_hidden()


def test_over_files_a_sentence_stands_in_its_place(page: Page, site: Path) -> None:  # noqa: F811
    page.goto((site / "cases" / CASE / "index.html").as_uri())
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
def test_without_what_it_needs_a_sentence_stands_in_its_place(page: Page, served: str, loss: str) -> None:  # noqa: F811
    page.add_init_script(loss)
    page.goto(address(served))
    button = page.get_by_role("button", name="Run the broken model")
    if button.is_visible():
        button.dispatch_event("click")  # it may be hidden at any moment
    expect(page.get_by_text("Here the model runs live")).to_be_visible()
    expect(button).to_be_hidden()
    assert no_engine(page)
