"""Cases in error: their own pages say so, the others stay as they are, and a strict build reports them all."""

from __future__ import annotations

import logging
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from clinic.publish.site import make_site
from clinic.publish.site_files import Site
from clinic.work.cache import Cache
from helpers import changed
from project import SILENT, run, write_project

pytestmark = pytest.mark.xdist_group("kill")
RECORD, MODEL = "cases/falling-box/case.yaml", "cases/falling-box/model.xml"
PAGE, OTHER = "cases/falling-box/index.md", "cases/odd-script/index.md"
MISTAKES = {
    "yaml": (RECORD, "title: A box", "title: {A box", "give each field once"),
    "field": (RECORD, "signals:", "signal:", "signal"),
    "model": (MODEL, "<freejoint", "<freejiont", "freejiont"),
    "edit": (RECORD, 'find: \' contype="2"', 'find: \' contype="3"', "exactly once"),
    "signal": (RECORD, "body(box)", "body(bix)", "bix"),
    "prose": (RECORD, "broken.contacts.max", "broken.contact.max", "contact"),
    "claim": (RECORD, "[0.045, 0.051]", "[0.045, 0.046]", "height (final) = 0.04"),
    "telling": (
        RECORD,
        "no_sweep:",
        "family: sinks\ntelling: {cause: masks, says: x, expr: deep, above: 1}\nno_sweep:",
        "'deep'",
    ),
}


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory, kept: Path) -> tuple[Path, Site]:
    """The project, and its site without errors."""
    folder = write_project(tmp_path_factory.mktemp("project"), SILENT, kept=kept)
    return folder, make_site(folder, Cache(folder / "cache"))


@contextmanager
def mistaken(path: Path, old: str, new: str) -> Iterator[None]:
    """Replaces a text in a file, and puts it back."""
    before = path.read_text(encoding="utf-8")
    path.write_text(changed(before, (old, new)), encoding="utf-8")
    try:
        yield
    finally:
        path.write_text(before, encoding="utf-8")


@pytest.mark.parametrize("kind", MISTAKES)
def test_a_case_in_error_says_so_alone_until_it_is_mended(whole: tuple[Path, Site], kind: str) -> None:
    folder, site = whole
    cache = Cache(folder / "cache")
    name, old, new, said = MISTAKES[kind]
    with mistaken(folder / name, old, new):
        made = make_site(folder, cache)

    page = made.files[PAGE].decode()
    assert "# 1. " in page or "# falling-box" in page
    assert all(line.strip() in page for problem in made.problems for line in str(problem).splitlines())
    assert made.problems
    assert said in page
    assert [list(entry) for entry in made.navigation] == [list(entry) for entry in site.navigation]
    assert PAGE in str(made.navigation)
    others = {name for name in site.files if name.startswith("cases/odd-script/")} | {
        "messages.md",
        "contribute/the-record.md",
    }
    assert {name: made.files[name] for name in others} == {name: site.files[name] for name in others}
    assert make_site(folder, cache) == site


def test_the_problems_of_all_cases_at_all_stages_are_reported_together(whole: tuple[Path, Site]) -> None:
    folder, _ = whole
    third = folder / "cases" / "third-case"
    third.mkdir()
    (third / "case.yaml").write_text("number: 3\ntitle: [\n", encoding="utf-8")
    script = folder / "cases" / "odd-script" / "case.yaml"
    with mistaken(folder / RECORD, *MISTAKES["claim"][1:3]), mistaken(script, "find: '0.5'", "find: '0.6'"):
        strict = run(folder, "-m", "mkdocs", "build", "--strict")
        lenient = run(folder, "-m", "mkdocs", "build")
        command = run(folder, "-m", "clinic", "build", "--out", "out")
    shutil.rmtree(third)

    for done in (strict, lenient, command):
        told = " ".join(done.stderr.split())
        assert "Traceback" not in told
        for words in ("falling-box/case.yaml", "odd-script/case.yaml", "exactly once", "third-case/case.yaml"):
            assert words in told
    assert [done.returncode for done in (strict, lenient, command)] == [1, 0, 1]
    for name in ("falling-box", "odd-script", "third-case"):
        assert "In error" in (folder / "site" / "cases" / name / "index.html").read_text(encoding="utf-8")


def test_a_task_that_raises_what_nobody_foresaw_is_a_problem_of_its_case(
    whole: tuple[Path, Site], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    def fail(case: object) -> dict[str, float]:
        raise ZeroDivisionError("by 0")

    monkeypatch.setenv("CLINIC_JOBS", "1")
    monkeypatch.setattr("clinic.proof.experiments.robustness", fail)
    with caplog.at_level(logging.CRITICAL):
        made = make_site(whole[0], Cache(tmp_path / "cache"))
    assert [(problem.file, problem.found) for problem in made.problems] == [(RECORD, "ZeroDivisionError: by 0")]
    assert made.files[OTHER] == whole[1].files[OTHER]


@pytest.mark.parametrize(
    ("old", "new", "where", "found"),
    [
        pytest.param("cause: The", "cause: After 3 mm the", "cause", "typed by hand", id="number"),
        pytest.param("fix: Share", 'fix: In `contype="7"`, share', "fix", 'contype="7"', id="quotation"),
    ],
)
def test_a_page_says_what_its_prose_must_not(
    whole: tuple[Path, Site], old: str, new: str, where: str, found: str
) -> None:
    folder, _ = whole
    with mistaken(folder / RECORD, old, new):
        made = make_site(folder, Cache(folder / "cache"))
    assert [(problem.where, found in problem.found) for problem in made.problems] == [(where, True)]
