"""A served site: after an edit of a model its numbers are shown first, and its film and sweeps when they are made.

They are made by a process of their own, which then touches a file that the server watches.
"""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Container
from pathlib import Path
from typing import TYPE_CHECKING

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.livereload import LiveReloadServer

from clinic.publish.kept_site import Site, kept_or_made
from clinic.record.checkout import cache_folder, project_root
from clinic.work.cache import Cache

if TYPE_CHECKING:
    from clinic.record.case import Case

NICENESS = 5


class LiveSite:
    """The site of a build, or of one build after the other while it is served.

    Attributes:
        built: The site of the last build.
        whole: The last site in which nothing was missing.
        watched: A folder that the server watches; None in a single build, which waits for everything.
        process: The last one that measured what an edit had changed.
        begun: The keys of all work that such a process was started for.
    """

    def __init__(self) -> None:
        self.built = Site({}, [])
        self.whole: Site | None = None
        self.watched: Path | None = None
        self.process: subprocess.Popen[bytes] | None = None
        self.begun: set[str] = set()

    def site(self, root: Path, cache: Cache) -> Site:
        """The whole site; or, if an edited case takes long to measure, the last one with the case's new numbers."""
        if self.watched and self.whole and (early := self._with_numbers(root, cache, self.whole, self.watched)):
            return early
        self.whole = make_site(root, cache) if self.watched else kept_or_made(root, cache, make_site)
        return self.whole

    def _with_numbers(self, root: Path, cache: Cache, whole: Site, watched: Path) -> Site | None:
        from clinic.record.case import read_cases

        cases, problems = read_cases(root / "cases")
        missing = {case.slug: keys for case in cases if (keys := missing_keys(case, cache))}
        running = self.process is not None and self.process.poll() is None
        wanted = set().union(*missing.values())
        if problems or not wanted or (wanted <= self.begun and not running):  # it could not be made: say why
            return None
        early = interim_site(root, cache, whole, cases, missing)
        if early and not running:
            self.begun |= wanted
            command = [sys.executable, "-m", "clinic.publish.live_reload", str(watched)]
            self.process = subprocess.Popen(command, cwd=root, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return early


def interim_site(root: Path, cache: Cache, whole: Site, cases: list[Case], slugs: Container[str]) -> Site | None:
    """The site with interim pages of the cases `slugs`, which show their numbers; None if one of them cannot be run."""
    from clinic.pages.case_page import interim_page
    from clinic.pages.cases import AT_ONCE, FOLDER, PAGE
    from clinic.pages.error_page import by_case, marked, name_of
    from clinic.pages.exhibits import evidence_of, evidence_task
    from clinic.proof.laws import breaches
    from clinic.publish.site import navigation
    from clinic.record.folder import RECORD
    from clinic.work.task import run_tasks

    edited = [case for case in cases if case.slug in slugs]
    found, failed = run_tasks([evidence_task(case) for case in edited], cache)
    if failed or len(found) < len(edited):
        return None
    files = dict(whole.files)
    problems = [problem for slug, told in by_case(whole.problems).items() if slug not in slugs for problem in told]
    for case in edited:
        evidence = evidence_of(found[case.slug])
        wrong = list(breaches(case, evidence, *AT_ONCE))
        page = interim_page(case, evidence)
        files[PAGE.format(slug=case.slug)] = (marked(page, wrong) if wrong else page).encode()
        folder = FOLDER.format(slug=case.slug)
        files |= {f"{folder}/{name}": (root / folder / name).read_bytes() for name in (RECORD, *case.texts)}
        problems += wrong
    return Site(files, navigation(map(name_of, cases)), tuple(problems))


def missing_keys(case: Case, cache: Cache) -> set[str]:
    """The keys of what has to be measured or filmed of a case besides its variants."""
    from clinic.pages.exhibits import measuring_tasks

    return {task.key for task in measuring_tasks(case) if not cache.path(task.key).exists()}


def make_site(root: Path, cache: Cache) -> Site:
    """`clinic.publish.site.make_site`, imported when it is needed."""
    from clinic.publish import site

    return site.make_site(root, cache)


def on_serve(server: LiveReloadServer, config: MkDocsConfig, **_: object) -> LiveReloadServer:
    """From now on, what takes long is made by a process whose end the server sees."""
    folder = cache_folder(project_root()) / "served"
    folder.mkdir(parents=True, exist_ok=True)
    server.watch(str(folder))
    LIVE.watched = folder
    return server


LIVE = LiveSite()


if __name__ == "__main__":
    os.nice(NICENESS)
    try:
        make_site(project_root(), Cache(cache_folder(project_root())))
    finally:
        Path(sys.argv[1], "made").touch()
