"""Live reload: after an edit of a model the page first shows its numbers, later its film and sweeps.

They are made by a process of their own; when it has ended, a file that the server watches is touched.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from threading import Thread

from mkdocs.livereload import LiveReloadServer

from clinic.publish.kept_site import cached_or_new_site
from clinic.publish.site_files import Site
from clinic.record.checkout import cache_folder, project_root
from clinic.work.cache import Cache


class LiveSite:
    """The site of a build, or of one build after the other while it is served.

    Attributes:
        shown: The site of the last build.
        watched: A folder that the server watches; None in a single build, which waits for everything.
        process: The last one that measured what an edit had changed.
        end: Waits for that process, and then touches the file.
        tried: The keys of all work that was tried.
    """

    def __init__(self) -> None:
        self.shown = Site({}, [])
        self.watched: Path | None = None
        self.process: subprocess.Popen[bytes] | None = None
        self.end: Thread | None = None
        self.tried: set[str] = set()

    def site(self, root: Path, cache: Cache) -> Site:
        """The whole site; or, if an edited case takes long to measure, the last one with the case's new numbers."""
        if self.watched is None:
            return cached_or_new_site(root, cache)
        from clinic.publish.site import interim_pages, make_site, slow_tasks_to_do

        missing = slow_tasks_to_do(root, cache)
        new = {task.key for task in missing} - self.tried
        running = self.process is not None and self.process.poll() is None
        numbers = interim_pages(root, cache, {task.slug for task in missing}) if new or running else None
        if numbers is None:
            return make_site(root, cache)
        if not running:
            self.tried |= new
            command = [sys.executable, "-m", "clinic.publish.live_reload"]
            self.process = subprocess.Popen(command, cwd=root, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            self.end = Thread(target=_tell_end, args=(self.process, self.watched / "made"), daemon=True)
            self.end.start()
        return Site({**self.shown.files, **numbers}, self.shown.navigation, self.shown.problems)


def _tell_end(process: subprocess.Popen[bytes], made: Path) -> None:
    """Touches the file once the process is gone: a build that still saw it running would wait for it for ever."""
    process.wait()
    made.touch()


def on_serve(server: LiveReloadServer, **_: object) -> None:
    """From now on, what takes long is made by a process whose end the server sees."""
    from clinic.publish.site import slow_tasks_to_do

    root = project_root()
    cache = Cache(cache_folder(root))
    LIVE.watched = cache.folder / "served"
    LIVE.watched.mkdir(parents=True, exist_ok=True)
    LIVE.tried = {task.key for task in slow_tasks_to_do(root, cache)}  # what this machine lacks the means for
    server.watch(str(LIVE.watched))


LIVE = LiveSite()


if __name__ == "__main__":
    from clinic.publish.site import make_site

    os.nice(5)
    make_site(project_root(), Cache(cache_folder(project_root())))
