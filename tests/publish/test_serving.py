"""What MkDocs keeps while it serves: less work for the same bytes as a build from nothing."""

from __future__ import annotations

import json
from pathlib import Path

import bench
import pytest
from helpers import changed
from playwright.sync_api import Browser, expect
from project import SILENT, bytes_of, run, write_project

pytestmark = pytest.mark.xdist_group("kill")
RECORD = "cases/falling-box/case.yaml"
EDITS = {
    "prose": ("Look at the masks.", "Look at the masks twice."),
    "error": ("title: A box", "tittle: A box"),
    "mended": ("tittle: A box", "title: One box"),
    "tags": ("tags: [contact]", "tags: [solver]"),
}
SERVE = """
import json, sys
from pathlib import Path
import markdown
from mkdocs.commands.build import build
from mkdocs.config import load_config

record, texts = Path(sys.argv[1]), json.loads(sys.argv[2])
convert, seen = markdown.Markdown.convert, []
markdown.Markdown.convert = lambda self, text: seen.append(text.count("\\n")) or convert(self, text)
for name, text in texts.items():
    record.write_text(text, encoding="utf-8")
    seen.clear()
    build(load_config(site_dir=f"served/{name}"))
    print(name, sum(1 for lines in seen if lines))
"""


def test_every_rebuild_equals_a_build_from_nothing_and_converts_what_changed(tmp_path: Path, kept: Path) -> None:
    folder = write_project(tmp_path, SILENT, kept=kept)
    texts = {"first": (folder / RECORD).read_text(encoding="utf-8")}
    for name, edit in EDITS.items():
        texts[name] = changed(next(reversed(texts.values())), edit)

    done = run(folder, "-c", SERVE, RECORD, json.dumps(texts))

    assert done.returncode == 0, done.stderr
    counts = dict(line.split() for line in done.stdout.splitlines())
    assert int(counts["prose"]) < int(counts["first"]) / 2
    for name in ("prose", "error", "tags"):
        (folder / RECORD).write_text(texts[name], encoding="utf-8")
        fresh = run(folder, "-m", "mkdocs", "build", "--site-dir", f"fresh/{name}")
        assert fresh.returncode == 0, fresh.stderr
        assert bytes_of(folder / "served" / name) == bytes_of(folder / "fresh" / name), name


def test_a_page_that_is_loaded_anew_stands_where_it_stood(
    tmp_path: Path,
    kept: Path,
    browser: Browser,
) -> None:
    folder = write_project(tmp_path, SILENT, kept=kept)
    record, shown = folder / RECORD, "cases/falling-box/index.html"
    page = browser.new_context(viewport={"width": 800, "height": 400}).new_page()
    with bench.served(folder, folder / "cache") as address:
        page.goto(address + shown)
        page.get_by_text("Fix", exact=True).click()
        page.evaluate("scrollTo(0, 333)")
        record.write_text(changed(record.read_text(encoding="utf-8"), EDITS["prose"]), encoding="utf-8")
        expect(page.get_by_text("Look at the masks twice.")).to_be_attached(timeout=bench.PATIENCE * 1000)
        page.wait_for_function("scrollY === 333")
        assert page.evaluate("[...document.querySelectorAll('details')].filter(fold => fold.open).length") == 1
        page.goto(address + "symptoms.html")
        page.goto(address + shown)
        assert page.evaluate("document.querySelectorAll('details[open]').length") == 0
    page.context.close()


def test_the_server_watches_what_pages_are_made_of(root: Path) -> None:
    text = (root / "mkdocs.yml").read_text(encoding="utf-8")
    watched = text.partition("\nwatch:\n")[2].split()
    assert {"cases", "scripts"} <= set(watched)
