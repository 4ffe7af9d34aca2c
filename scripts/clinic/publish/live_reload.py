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
from clinic.work.cache import Cache, Files

if TYPE_CHECKING:
    from clinic.work.task import Task

NICENESS = 5


class LiveSite:
    """The site of a build, or of one build after the other while it is served.

    Attributes:
        shown: The site of the last build.
        whole: The last site that waited for everything.
        watched: A folder that the server watches; None in a single build, which waits for everything.
        process: The last one that measured what an edit had changed.
        tried: The keys of all work that was tried.
    """

    def __init__(self) -> None:
        self.shown = self.whole = Site({}, [])
        self.watched: Path | None = None
        self.process: subprocess.Popen[bytes] | None = None
        self.tried: set[str] = set()

    def site(self, root: Path, cache: Cache) -> Site:
        """The whole site; or, if an edited case takes long to measure, the last one with the case's new numbers."""
        if self.watched is None:
            self.whole = kept_or_made(root, cache)
            return self.whole
        from clinic.publish.site import make_site

        missing = unmeasured(root, cache)
        new = {task.key for task in missing} - self.tried
        running = self.process is not None and self.process.poll() is None
        numbers = number_pages(root, cache, {task.slug for task in missing}) if new or running else None
        if numbers is None:
            self.whole = make_site(root, cache)
            return self.whole
        if not running:
            self.tried |= new
            command = [sys.executable, "-m", "clinic.publish.live_reload", str(self.watched)]
            self.process = subprocess.Popen(command, cwd=root, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return Site({**self.whole.files, **numbers}, self.whole.navigation, self.whole.problems)


def unmeasured(root: Path, cache: Cache) -> list[Task]:
    """What takes long and is not kept: all but the variants' runs and the plots."""
    from clinic.pages.case_files import picture_tasks
    from clinic.proof.experiments import measuring_tasks
    from clinic.record.case import read_cases

    tasks = [task for case in read_cases(root / "cases")[0] for task in (*measuring_tasks(case), *picture_tasks(case))]
    return [task for task in tasks if not cache.path(task.key).exists()]


def number_pages(root: Path, cache: Cache, slugs: Container[str]) -> Files | None:
    """The pages of these cases with what their checks measured; None if there are none, or one cannot be run."""
    from clinic.pages.case_page import interim_page
    from clinic.pages.cases import PAGE
    from clinic.proof.experiments import EVIDENCE, evidence_of, evidence_task
    from clinic.record.case import read_cases
    from clinic.work.task import run_tasks

    cases = [case for case in read_cases(root / "cases")[0] if case.slug in slugs]
    found, failed = run_tasks([evidence_task(case) for case in cases], cache)
    if failed or not all(EVIDENCE in files for files in found.values()):
        return None
    pages = {case.slug: interim_page(case, evidence_of(found[case.slug])) for case in cases}
    return {PAGE.format(slug=slug): page.encode() for slug, page in pages.items()} or None


def on_serve(server: LiveReloadServer, config: MkDocsConfig, **_: object) -> LiveReloadServer:
    """From now on, what takes long is made by a process whose end the server sees."""
    root = project_root()
    cache = Cache(cache_folder(root))
    LIVE.watched = cache.folder / "served"
    LIVE.watched.mkdir(parents=True, exist_ok=True)
    LIVE.tried = {task.key for task in unmeasured(root, cache)}  # what this machine lacks the means for
    server.watch(str(LIVE.watched))
    return server


LIVE = LiveSite()


if __name__ == "__main__":
    from clinic.publish.site import make_site

    os.nice(NICENESS)
    try:
        make_site(project_root(), Cache(cache_folder(project_root())))
    finally:
        Path(sys.argv[1], "made").touch()
