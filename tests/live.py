"""An open playground, and what a reader does with it."""

from __future__ import annotations

from playwright.sync_api import Error, Page, expect

CASE = "box-falls-through-floor"
PASTE = """(editor, text) => {
  const clipboardData = new DataTransfer();
  clipboardData.setData("text/plain", text);
  editor.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true, cancelable: true }));
}"""
LIMIT = 60_000  # ms: how long anything may take on a busy machine; nothing here judges how long it did take

expect.set_options(timeout=LIMIT)


def address(served: str, slug: str = CASE) -> str:
    return f"{served}cases/{slug}/index.html"


def open_playground(page: Page, served: str, slug: str = CASE) -> None:
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
    return [worker.url for worker in page.workers if "playground/worker" in worker.url]


def no_engine(page: Page) -> bool:
    """Whether every engine has ended, or is about to."""
    for worker in page.workers:
        if "playground/worker" in worker.url:
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


def edited(page: Page, find: str, replace: str) -> str:
    """The case's own text with one change."""
    text: str = page.evaluate("fetch('playground.json').then(response => response.json())")["text"]
    assert text.count(find) == 1
    return text.replace(find, replace)
