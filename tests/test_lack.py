"""Cases on a machine that lacks what measures them: OpenGL, or MuJoCo's package for Node."""

from __future__ import annotations

import logging
from collections.abc import Callable
from pathlib import Path

import mujoco
import pytest
from clinic.engine import node
from clinic.pages.case_files import files_of_case, files_of_cases
from clinic.pages.error_page import unmeasured_page
from clinic.proof.evidence import missing_requirement, needs_images
from clinic.proof.experiments import evidence_task
from clinic.publish.site import make_site
from clinic.record.case import Case, load_case
from clinic.record.checkout import project_root
from clinic.record.problem import CaseError
from clinic.work.cache import Cache
from clinic.work.task import log_missing_once
from helpers import SCRIPT, script_case, tiny_case
from project import write_project

DRAWS = "import mujoco\nmujoco.Renderer(mujoco.MjModel.from_xml_string('<mujoco/>'), 8, 8).close()\n"
ROW = ("contacts: {path: ncon}", "contacts: {path: ncon}\n  row: {measure: image_row, camera: side, geom: box}")
NO_FILM = ("film: {}\n", "")
SNIPPET = ("signals:", "snippet: |\n  " + DRAWS.replace("\n", "\n  ") + "\nsignals:")
Make = Callable[[Path], Case]
MEASURED_IN_IMAGES = [
    pytest.param(lambda root: script_case(root, script=DRAWS + SCRIPT), id="script"),
    pytest.param(lambda root: script_case(root, SNIPPET), id="snippet"),
    pytest.param(lambda root: tiny_case(root, NO_FILM, ROW), id="signal"),
]


@pytest.fixture
def blind(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leaves this process without OpenGL."""

    def fail(*_: object) -> None:
        raise RuntimeError("no display")

    monkeypatch.setattr(mujoco, "Renderer", fail)
    monkeypatch.setenv("CLINIC_JOBS", "1")
    log_missing_once.cache_clear()


@pytest.mark.parametrize("make", MEASURED_IN_IMAGES)
def test_what_draws_is_measured_where_images_can_be_drawn(tmp_path: Path, cache: Cache, make: Make) -> None:
    case = make(tmp_path)
    assert needs_images(case)
    assert "evidence.json" in files_of_case(case, cache)


@pytest.mark.usefixtures("blind")
@pytest.mark.parametrize("make", MEASURED_IN_IMAGES)
@pytest.mark.parametrize(
    ("ci", "level"), [pytest.param("", "INFO", id="by-hand"), pytest.param("true", "WARNING", id="in-ci")]
)
def test_it_is_left_out_and_not_kept_and_said_once(
    tmp_path: Path,
    cache: Cache,
    make: Make,
    ci: str,
    level: str,
    monkeypatch: pytest.MonkeyPatch,
    caplog: pytest.LogCaptureFixture,
) -> None:
    monkeypatch.setenv("CI", ci)
    caplog.set_level(logging.INFO, "mkdocs.clinic")
    case, other = make(tmp_path / "one"), script_case(tmp_path / "two")

    for _ in range(2):
        assert files_of_cases([case], cache) == ({}, [])

    assert cache.get(evidence_task(case).key) is None
    said = [(record.levelname, record.getMessage()) for record in caplog.records]
    assert [name for name, text in said if "is not measured" in text and "no display" in text] == [level]
    assert "evidence.json" in files_of_case(other, cache)


@pytest.mark.usefixtures("blind")
@pytest.mark.parametrize("make", MEASURED_IN_IMAGES)
def test_it_cannot_be_judged(tmp_path: Path, cache: Cache, make: Make) -> None:
    with pytest.raises(
        CaseError, match=r"no display\n.*OpenGL: this case is measured in images\n.*a machine that draws"
    ):
        files_of_case(make(tmp_path), cache)


@pytest.mark.usefixtures("blind")
def test_a_case_that_only_shows_pictures_is_measured_without_them(tmp_path: Path, cache: Cache) -> None:
    files = files_of_case(tiny_case(tmp_path, NO_FILM), cache)
    assert "evidence.json" in files
    assert not [name for name in files if name.endswith(".webp")]


@pytest.mark.usefixtures("blind")
def test_its_page_says_so_and_the_others_are_as_ever(tmp_path: Path, cache: Cache) -> None:
    folder = write_project(tmp_path, NO_FILM)
    script = folder / "cases" / "odd-script" / "script.py"
    script.write_text(DRAWS + SCRIPT, encoding="utf-8")
    assert needs_images(load_case(script.parent))

    site = make_site(folder, cache)

    assert site.problems == ()
    page = site.files["cases/odd-script/index.md"].decode()
    assert "# 2. A script prints an error" in page
    assert "measured in images" in page
    assert "no display" in page
    assert "cases/odd-script/index.md" in str(site.navigation)
    assert "How we know" in site.files["cases/falling-box/index.md"].decode()


@pytest.mark.parametrize("gone", ["executable", "version"])
def test_a_case_in_javascript_waits_for_node_and_its_package(
    tmp_path: Path, cache: Cache, gone: str, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    (folder,) = {path.parent for path in (project_root() / "cases").glob("*/script.mjs")}
    case = load_case(folder)
    monkeypatch.setattr(node, gone, lambda *_: None)
    monkeypatch.setenv("CLINIC_JOBS", "1")
    monkeypatch.setenv("CI", "")
    caplog.set_level(logging.INFO, "mkdocs.clinic")

    assert files_of_cases([case], cache) == ({}, [])

    found = {"executable": "no Node on this machine", "version": "@mujoco/mujoco is not installed"}[gone]
    assert f"case {case.record.number} is not measured: {found}" in caplog.messages
    missing = missing_requirement(case)
    assert missing is not None
    assert found in unmeasured_page("15. A view", missing)
    with pytest.raises(CaseError, match=rf"found: +{found}\n.*this case is run by them"):
        files_of_case(case, cache)
