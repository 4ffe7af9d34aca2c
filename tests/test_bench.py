"""What measures builds and growth: tables in their place, physics counted, variations that need no run."""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterator
from pathlib import Path

import bench
import growth
import measured
import pytest
import yaml
from clinic.pages.case_files import files_of_cases
from clinic.proof.experiments import evidence_of
from clinic.publish.site import make_site
from clinic.record.case import load_case, read_cases
from clinic.work.cache import Cache
from helpers import tiny_case
from project import SILENT, write_project

pytestmark = pytest.mark.xdist_group("kill")
PAGE = "# A page\n\n## One { #one }\n\nold\n\n| a |\n\n### Two { #two }\n\nkept\n"


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory, kept: Path) -> Iterator[Path]:
    folder = write_project(tmp_path_factory.mktemp("project"), SILENT, kept=kept)
    yield folder
    shutil.rmtree(folder)


def test_a_table_takes_the_place_of_the_one_before() -> None:
    table = measured.markdown([("what", "time"), ("build", "1 s")])
    assert table == "| what | time |\n| --- | --: |\n| build | 1 s |"
    once = measured.put(PAGE, "one", table)
    assert once == f"# A page\n\n## One {{ #one }}\n\n{table}\n\n### Two {{ #two }}\n\nkept\n"
    assert measured.put(once, "one", table) == once
    assert measured.put(PAGE, "two", "new").endswith("### Two { #two }\n\nnew\n")


def test_a_page_without_the_heading_is_left() -> None:
    with pytest.raises(ValueError, match="0 headings with the anchor #three"):
        measured.put(PAGE, "three", "new")


@pytest.mark.parametrize("anchor", ["cost", "growth"])
def test_the_tables_have_their_place_on_their_page(root: Path, anchor: str) -> None:
    text = (root / measured.PAGE).read_text(encoding="utf-8")
    assert measured.put(measured.put(text, anchor, "x"), anchor, "y").count("\ny\n") == 1


def test_the_aims_that_a_grown_site_misses_are_named() -> None:
    least = growth.Site(100, Path(), Path(), [], 0.1, [10.0, 9.0])
    largest = growth.Site(1000, Path(), Path(), [], 0.8, [80.0], index=growth.INDEX + 1, query=1.0)
    assert largest.missed(least) == ["the search index"]
    largest.spent, largest.index = [200.0], growth.INDEX
    assert largest.missed(least) == ["the time a case"]


def test_the_steps_of_all_runs_are_counted(tmp_path: Path) -> None:
    case = tiny_case(tmp_path, ("film: {}\n", ""))
    spent, physics = bench.parts([case])
    runs = 200 + 200 + 400  # broken, fix, refuted: 0.4 s of 2 ms, 2 ms, 1 ms
    assert physics.steps > runs
    assert physics.steps % 200 == 0
    assert set(spent) == {"physics", "rendering", "plotting", "snippets, scripts, and whether a model compiles"}
    assert min(spent.values()) > 0


def without_policy(page: Path) -> str:
    """The page without the policy, which a hook gives."""
    said = re.sub(r'<meta http-equiv="Content-Security-Policy" [^>]*>', "", page.read_text(encoding="utf-8"))
    return "\n".join(filter(str.strip, said.splitlines()))


def test_a_plain_site_has_the_same_pages_and_nothing_of_ours(project: Path, tmp_path: Path) -> None:
    copy, cache = measured.copied(project, tmp_path / "copy"), project / "cache"
    plain = measured.finished(copy, cache, tmp_path / "finished" / "docs")
    settings = yaml.safe_load(plain.read_text(encoding="utf-8"))
    assert "gen-files" not in str(settings)
    assert settings["hooks"] == settings["watch"] == []
    for name in ("ours", "plain"):
        chosen = ["--config-file", plain.name] if name == "plain" else []
        measured.python(copy, cache, "-m", "mkdocs", "build", "--strict", "--site-dir", str(tmp_path / name), *chosen)
    ours, theirs = (
        {p.relative_to(tmp_path / name): without_policy(p) for p in (tmp_path / name).rglob("*.html")}
        for name in ("ours", "plain")
    )
    assert ours == theirs


def test_variations_are_cases_that_need_no_run(project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    copy, cache = measured.copied(project, tmp_path / "copy"), Cache(project / "cache")
    make_site(copy, cache)
    growth.grow(copy, cache, 5)
    cases = read_cases(copy / "cases")[0]
    assert [case.record.number for case in cases] == [1, 2, 3, 4, 5]
    assert len({case.record.title for case in cases}) == 5

    def none(work: object, tasks: list[object]) -> list[object]:
        assert not tasks
        return []

    monkeypatch.setattr("clinic.work.task.parallel", none)
    made = make_site(copy, cache)
    assert not made.problems
    shown, _ = files_of_cases([load_case(copy / "cases" / "falling-box-2")], cache)
    assert evidence_of(shown["falling-box-2"]).number == 4
    assert "cases/falling-box-3/index.md" in made.files
