"""While the site is served, an edited case shows its numbers first and the rest when it is made."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import bench
import measured
import pytest
from bench import MEASURING
from clinic.pages.search_index import ANSWERS
from clinic.publish import live_reload
from clinic.publish.live_reload import LiveSite
from clinic.publish.site import make_site, slow_tasks_to_do
from clinic.publish.site_files import Site
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
def live(project: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[LiveSite]:
    """The project as it is served, its files put back afterwards."""
    monkeypatch.setenv("CLINIC_CACHE", str(project / "cache"))
    monkeypatch.chdir(project)
    monkeypatch.setattr(live_reload, "LIVE", LiveSite())
    before = {project / name: (project / name).read_text(encoding="utf-8") for name in (MODEL, RECORD)}
    made = live_reload.LIVE
    site(made, project)
    server = LiveReloadServer(lambda: None, "127.0.0.1", 0, str(project))
    live_reload.on_serve(server, config=load_config(str(project / "mkdocs.yml")))
    assert made.watched is not None
    assert [emitter.watch.path for emitter in server.observer.emitters] == [str(made.watched)]
    yield made
    server.server_close()
    if made.process is not None:
        made.process.wait(PATIENCE)
    for path, text in before.items():
        path.write_text(text, encoding="utf-8")


def edit(project: Path, name: str, old: str, new: str) -> None:
    path = project / name
    path.write_text(changed(path.read_text(encoding="utf-8"), (old, new)), encoding="utf-8")


def ended(live: LiveSite) -> None:
    """Waits until the process has come to its end, and has told so."""
    assert live.end is not None
    assert live.watched is not None
    live.end.join(PATIENCE)
    (live.watched / "made").unlink()


def site(live: LiveSite, project: Path) -> Site:
    live.shown = live.site(project, Cache(project / "cache"))
    return live.shown


def differing(one: Site, other: Site) -> set[str]:
    return {name for name in one.files | other.files if one.files.get(name) != other.files.get(name)}


def test_an_edited_model_shows_its_numbers_and_then_the_rest(project: Path, live: LiveSite) -> None:
    whole = site(live, project)
    assert not whole.problems
    edit(project, MODEL, 'pos="0 0 0.06"', 'pos="0 0 0.07"')
    early = site(live, project)
    assert differing(early, whole) == {PAGE}
    assert MEASURING in early.files[PAGE].decode()
    assert "0.1252" in early.files[PAGE].decode()
    ended(live)
    assert not slow_tasks_to_do(project, Cache(project / "cache"))
    made = site(live, project)
    assert made == make_site(project, Cache(project / "cache"))
    assert MEASURING not in made.files[PAGE].decode()
    assert differing(made, whole) > {PAGE, MODEL}


def test_an_edit_of_prose_waits_for_nothing(project: Path, live: LiveSite) -> None:
    whole = site(live, project)
    edit(project, RECORD, "Look at the masks.", "Look at all masks.")
    assert differing(site(live, project), whole) == {PAGE, RECORD, ANSWERS}
    assert live.process is None


@pytest.mark.parametrize(
    "old", [pytest.param("<freejoint", id="no model"), pytest.param('name="box" pos', id="no such body")]
)
def test_an_edit_that_cannot_run_says_so_at_once(project: Path, live: LiveSite, old: str) -> None:
    whole = site(live, project)
    edit(project, MODEL, old, "<frejoint" if old[0] == "<" else 'name="bix" pos')
    made = site(live, project)
    assert made.problems
    assert "In error" in made.files[PAGE].decode()
    assert made.files[OTHER] == whole.files[OTHER]
    assert live.process is None


def test_what_is_saved_meanwhile_is_made_next(project: Path, live: LiveSite) -> None:
    edit(project, MODEL, 'mass="1"', 'mass="2"')
    site(live, project)
    first = live.process
    edit(project, MODEL, 'mass="2"', 'mass="3"')
    site(live, project)
    assert live.process is first
    ended(live)
    if slow_tasks_to_do(project, Cache(project / "cache")):  # unless the process read the second edit
        site(live, project)
        assert live.process is not first
        ended(live)
    assert MEASURING not in site(live, project).files[PAGE].decode()


def test_what_the_process_could_not_make_is_made_here(project: Path, live: LiveSite) -> None:
    edit(project, MODEL, 'mass="1"', 'mass="4"')
    site(live, project)
    assert live.process is not None
    live.process.kill()
    live.process.wait(PATIENCE)
    assert MEASURING not in site(live, project).files[PAGE].decode()


def test_the_server_shows_prose_and_numbers_and_then_the_page(project: Path, tmp_path: Path) -> None:
    copy = measured.copied(project, tmp_path / "copy")
    bench.edits(copy, project / "cache", "falling-box", repeats=1)  # exits where a page does not come
