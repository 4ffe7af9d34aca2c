"""The reader's text in a real browser: kept while it is typed, brought by a link or a file, never lost on the way."""

from __future__ import annotations

import base64
import re
import zlib

import pytest
from live import LIMIT, address, engines, open_playground, restore, type_text, wait_for_steps
from playwright.sync_api import Page, expect

pytestmark = pytest.mark.xdist_group("site")
MINE = '<mujoco>\n  <worldbody>\n    <geom name="mine" size="1"/>\n  </worldbody>\n</mujoco>\n'
OTHER = MINE.replace("mine", "other")
DROP = """(root, [name, text]) => {
  const dataTransfer = new DataTransfer();
  dataTransfer.items.add(new File([text], name));
  for (const type of ["dragover", "drop"]) {
    const event = new DragEvent(type, { dataTransfer, bubbles: true, cancelable: true });
    root.querySelector(".cm-content").dispatchEvent(event);
  }
}"""


def link(served: str, text: str) -> str:
    packed = zlib.compress(text.encode(), wbits=-15)
    return f"{address(served)}#model={base64.urlsafe_b64encode(packed).decode().rstrip('=')}"


def opened(page: Page) -> None:
    page.wait_for_function("document.querySelector('.pg-clock')?.dataset.steps", timeout=LIMIT)


def test_the_text_survives_a_reload_and_the_way_back(page: Page, served: str) -> None:
    open_playground(page, served)
    type_text(page, MINE)
    expect(page.locator(".pg-kept")).to_have_text("Kept in this browser.")

    page.reload()
    opened(page)
    expect(page.locator(".cm-content")).to_contain_text('name="mine"')
    expect(page.locator(".pg-kept")).to_have_text("Your text, as you left it in this browser.")

    page.goto(served + "index.html")
    page.go_back()
    opened(page)
    expect(page.locator(".cm-content")).to_contain_text('name="mine"')

    restore(page)
    page.reload()
    expect(page.get_by_role("button", name="Run the broken model")).to_be_enabled()


def test_leaving_asks_nothing(page: Page, served: str) -> None:
    asked: list[str] = []
    page.on("dialog", lambda dialog: (asked.append(dialog.type), dialog.accept()))
    open_playground(page, served)
    type_text(page, MINE)

    page.goto(served + "index.html")

    assert asked == []


@pytest.mark.parametrize(
    ("fragment", "said"),
    [("#model=AAAA%%", "This link is damaged"), (None, "too long: more than 1,000,000 characters")],
    ids=["damaged", "long"],
)
def test_a_link_that_cannot_be_read_says_so_and_runs_nothing(
    page: Page, served: str, fragment: str | None, said: str
) -> None:
    page.goto(address(served) + fragment if fragment else link(served, f"<!--{' ' * 1_000_000}-->"))

    expect(page.locator(".pg-status")).to_contain_text(said)
    expect(page.locator(".pg-status")).to_contain_text("What you see is the case's own text.")
    expect(page.locator(".cm-content")).to_contain_text('<mujoco model="box above a floor">')
    assert engines(page) == []

    page.get_by_role("button", name="Run", exact=True).click()
    wait_for_steps(page)


def test_a_link_does_not_cost_the_reader_the_text_left_here(page: Page, served: str) -> None:
    open_playground(page, served)
    type_text(page, MINE)
    page.goto("about:blank")
    page.goto(link(served, OTHER))
    expect(page.locator(".cm-content")).to_contain_text('name="other"')

    page.get_by_role("button", name="Show the text that I left here").click()

    expect(page.locator(".cm-content")).to_contain_text('name="mine"')


def test_a_link_that_is_put_into_the_open_page_s_address_is_opened(page: Page, served: str) -> None:
    open_playground(page, served)
    page.evaluate("address => { location.href = address; }", link(served, OTHER))
    expect(page.locator(".pg-status")).to_contain_text("This text came with the link.")
    expect(page.locator(".cm-content")).to_contain_text('name="other"')


def test_what_is_edited_after_a_link_survives_a_reload(page: Page, served: str) -> None:
    page.goto(link(served, OTHER))
    expect(page.locator(".cm-content")).to_contain_text('name="other"')
    type_text(page, MINE)

    page.reload()

    opened(page)
    expect(page.locator(".cm-content")).to_contain_text('name="mine"')


def test_a_text_too_long_for_a_link_gets_none(page: Page, served: str) -> None:
    open_playground(page, served)
    type_text(page, MINE + f"<!--{' ' * 1_000_000}-->")

    page.get_by_role("button", name="Copy link").click()

    expect(page.get_by_text("This text is too long for a link. Download it instead.")).to_be_visible()


def test_a_model_is_dropped_and_taken_out_again(page: Page, served: str) -> None:
    open_playground(page, served)
    page.locator(".pg").evaluate(DROP, ["mine.xml", MINE])
    expect(page.locator(".cm-content")).to_have_text(re.compile(r"^<mujoco>.*name=\"mine\""))
    expect(page.get_by_text("mine.xml is in the editor; Undo takes it out again.")).to_be_visible()

    page.get_by_role("button", name="Undo").click()
    expect(page.locator(".cm-content")).to_contain_text("box above a floor")

    page.locator(".pg").evaluate(DROP, ["notes.txt", "no model"])
    expect(page.get_by_text("notes.txt is no model: there is no <mujoco> in it.")).to_be_visible()
    expect(page.locator(".cm-content")).to_contain_text("box above a floor")


def test_ones_own_changes_are_shown_at_any_time(page: Page, served: str) -> None:
    open_playground(page, served)
    changes = page.get_by_role("button", name="My changes")
    expect(changes).to_be_disabled()
    type_text(page, MINE)

    changes.click()
    expect(page.locator(".cm-deletedChunk").first).to_be_attached()
    changes.click()
    expect(page.locator(".cm-deletedChunk")).to_have_count(0)


def test_a_text_is_indented_as_it_is_nested(page: Page, served: str) -> None:
    open_playground(page, served)
    type_text(page, re.sub(r"\n +", "\n", MINE).replace("<worldbody>", "<worldbody>   "))

    page.get_by_role("button", name="Format").click()

    lines = page.locator(".cm-line").evaluate_all("lines => lines.map(line => line.textContent)")
    assert lines == MINE.split("\n")
