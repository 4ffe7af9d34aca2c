"""While the site is served, an edited case shows its numbers at once and the rest when it is made."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from pathlib import Path

import bench
import measured
import pytest
from bench import MEASURING
from clinic.publish import later as module
from clinic.publish.kept_site import Site
from clinic.publish.later import Later, takes_long
from clinic.publish.site import survey
from clinic.record.case import load_case
from clinic.work.cache import Cache
from helpers import changed
from mkdocs.config import load_config
from mkdocs.livereload import LiveReloadServer
from project import SILENT, write_project

pytestmark = pytest.mark.xdist_group("kill")
PAGE, OTHER = "cases/falling-box/index.md", "cases/odd-script/index.md"
MODEL, RECORD = "cases/falling-box/model.xml", "cases/falling-box/case.yaml"
PATIENCE = 120.0  # s


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory, kept: Path) -> Path:
    lesson = ("lesson: Look", "lesson: |\n  Look")
    return write_project(tmp_path_factory.mktemp("project"), SILENT, lesson, kept=kept)


@pytest.fixture
def served(project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Later]:
    """The project as it is served, its files put back afterwards."""
    monkeypatch.setenv("CLINIC_CACHE", str(project / "cache"))
    monkeypatch.setenv("PYTHONPATH", str(Path(module.__file__).parent.parent))
    before = {project / name: (project / name).read_text(encoding="utf-8") for name in (MODEL, RECORD)}
    made = Later()
    made.folder = tmp_path
    yield made
    made.stop()
    for path, text in before.items():
        path.write_text(text, encoding="utf-8")


def edit(project: Path, name: str, old: str, new: str) -> None:
    path = project / name
    path.write_text(changed(path.read_text(encoding="utf-8"), (old, new)), encoding="utf-8")


def ended(later: Later) -> None:
    """Waits until the process has come to its end, and has told so."""
    assert later.teller is not None
    later.teller.join(PATIENCE)
    assert later.folder is not None
    assert list(later.folder.iterdir())


def site(later: Later, project: Path) -> Site:
    return later.site(project, Cache(project / "cache"))


def differing(one: Site, other: Site) -> set[str]:
    return {name for name in one.files | other.files if one.files.get(name) != other.files.get(name)}


def test_an_edited_model_shows_its_numbers_and_then_the_rest(project: Path, served: Later) -> None:
    whole = site(served, project)
    assert not whole.problems
    edit(project, MODEL, 'pos="0 0 0.06"', 'pos="0 0 0.07"')
    early = site(served, project)
    assert differing(early, whole) == {PAGE, MODEL}
    assert MEASURING in early.files[PAGE].decode()
    assert "0.1252" in early.files[PAGE].decode()
    assert early.navigation == whole.navigation
    assert site(served, project) == early
    ended(served)
    assert not takes_long(load_case(project / "cases" / "falling-box"), Cache(project / "cache"))
    made = site(served, project)
    assert made == survey(project, Cache(project / "cache"))
    assert MEASURING not in made.files[PAGE].decode()
    assert differing(made, whole) > {PAGE, MODEL, "cases/falling-box/plot.svg"}


def test_an_edit_of_prose_waits_for_nothing(project: Path, served: Later) -> None:
    whole = site(served, project)
    edit(project, RECORD, "Look at the masks.", "Look at all masks.")
    assert differing(site(served, project), whole) == {PAGE, RECORD}
    assert served.process is None


@pytest.mark.parametrize(
    "old", [pytest.param("<freejoint", id="no model"), pytest.param('name="box" pos', id="no such body")]
)
def test_an_edit_that_cannot_run_says_so_at_once(project: Path, served: Later, old: str) -> None:
    whole = site(served, project)
    edit(project, MODEL, old, "<frejoint" if old[0] == "<" else 'name="bix" pos')
    made = site(served, project)
    assert made.problems
    assert "In error" in made.files[PAGE].decode()
    assert made.files[OTHER] == whole.files[OTHER]
    assert served.process is None


def test_a_claim_that_the_numbers_do_not_bear_out_is_said_at_once(project: Path, served: Later) -> None:
    site(served, project)
    edit(project, RECORD, "[0.045, 0.051]", "[0.045, 0.046]")
    early = site(served, project)
    assert {problem.where for problem in early.problems} == {"checks.fixed[0]"}
    assert "share-a-bit: height (final) = 0.0498" in early.files[PAGE].decode()
    assert MEASURING in early.files[PAGE].decode()
    ended(served)
    made = site(served, project)
    assert "In error" in made.files[PAGE].decode()
    edit(project, RECORD, "[0.045, 0.046]", "[0.045, 0.052]")
    assert not site(served, project).problems


def test_saving_again_ends_what_is_being_made(project: Path, served: Later) -> None:
    site(served, project)
    edit(project, MODEL, 'mass="1"', 'mass="2"')
    site(served, project)
    first, teller = served.process, served.teller
    edit(project, MODEL, 'mass="2"', 'mass="3"')
    site(served, project)
    assert first is not None
    assert first.poll() == -signal.SIGTERM
    assert teller is not None
    teller.join(PATIENCE)
    assert served.folder is not None
    assert not list(served.folder.iterdir())
    assert served.process is not None
    edit(project, MODEL, 'mass="3"', 'mass="1"')
    assert MEASURING not in site(served, project).files[PAGE].decode()
    assert served.process is None


def test_what_the_process_could_not_make_is_made_here(project: Path, served: Later) -> None:
    site(served, project)
    edit(project, MODEL, 'mass="1"', 'mass="4"')
    site(served, project)
    assert served.process is not None
    os.killpg(served.process.pid, signal.SIGKILL)
    ended(served)
    assert site(served, project) == survey(project, Cache(project / "cache"))


def test_a_build_waits_for_everything(project: Path, tmp_path: Path) -> None:
    later = Later()
    edited = write_project(tmp_path / "project", SILENT, ("Look at the masks.", "Look."))
    later.site(edited, Cache(project / "cache"))
    edit(edited, MODEL, 'mass="1"', 'mass="5"')
    assert MEASURING not in later.site(edited, Cache(project / "cache")).files[PAGE].decode()
    assert later.process is None


def test_the_process_ends_with_the_one_that_started_it(project: Path, served: Later) -> None:
    site(served, project)
    edit(project, MODEL, 'mass="1"', 'mass="6"')
    site(served, project)
    assert served.process is not None
    assert served.process.stdin is not None
    served.process.stdin.close()
    assert served.process.wait(PATIENCE) == -signal.SIGTERM


def test_the_server_shows_the_numbers_and_then_the_page(project: Path, tmp_path: Path) -> None:
    copy = measured.copied(project, tmp_path / "copy")
    prose, numbers, whole = bench.edits(copy, project / "cache", "falling-box", repeats=0)
    assert prose > 0
    assert 0 < numbers < whole


@pytest.mark.parametrize("meanwhile", [False, True])
def test_what_was_saved_during_the_first_build_is_built(
    project: Path, served: Later, monkeypatch: pytest.MonkeyPatch, meanwhile: bool
) -> None:
    monkeypatch.chdir(project)
    monkeypatch.setattr(module, "LATER", served)
    site(served, project)
    if meanwhile:
        edit(project, RECORD, "Look at the masks.", "Look at all masks.")
    config = load_config(str(project / "mkdocs.yml"))
    server = LiveReloadServer(lambda: None, "127.0.0.1", 0, str(project))
    module.on_serve(server, config=config)
    assert server._want_rebuild is meanwhile
    server.server_close()


def test_the_server_looks_often_at_all_that_it_watched_before(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CLINIC_CACHE", str(project / "cache"))
    monkeypatch.setattr(module, "LATER", Later())
    config = load_config(str(project / "mkdocs.yml"))
    server = LiveReloadServer(lambda: None, "127.0.0.1", 0, str(project))
    theme = config.theme.dirs[0]  # as `--watch-theme` has it
    for path in (config.docs_dir, config.config_file_path, theme):
        server.watch(path)
    module.on_serve(server, config=config)
    assert server.observer.timeout == module.POLLING < 0.5
    seen = {emitter.watch.path for emitter in server.observer.emitters}
    assert seen == {config.docs_dir, str(project), theme, str(module.LATER.folder)}  # a file is seen in its folder
    server.server_close()
