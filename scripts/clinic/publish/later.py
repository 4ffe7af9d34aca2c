"""What a served site does not wait for: a case that was edited shows its numbers, while a process makes the rest.

The process makes the whole site, which this one then finds kept. Saving again replaces it.
"""

from __future__ import annotations

import atexit
import os
import signal
import subprocess
import sys
import threading
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.livereload import LiveReloadServer
from watchdog.observers.polling import PollingObserver

from clinic.publish.kept_site import Site, finished, kept_site, key_of_site
from clinic.record.checkout import cache_folder, project_root
from clinic.work.cache import Cache

if TYPE_CHECKING:
    from clinic.record.case import Case

NICENESS = 5
POLLING = 0.2  # s; MkDocs waits 0.5 s between two looks


class Later:
    """The site as it is served.

    Attributes:
        whole: The last site that was shown whole.
        key: What the process makes, or made, the site of.
        asked: What the last site that was asked for was to be made of.
        teller: Waits for the process, to change a file in `folder`.
        folder: Watched by the server; None where everything is waited for.
    """

    def __init__(self) -> None:
        self.whole: Site | None = None
        self.key = ""
        self.asked = ""
        self.process: subprocess.Popen[bytes] | None = None
        self.teller: threading.Thread | None = None
        self.folder: Path | None = None
        atexit.register(self.stop)

    def site(self, root: Path, cache: Cache) -> Site:
        """The site, whole; or, in a folder that is watched, with a case's numbers and the rest as it was."""
        key = self.asked = key_of_site(root)
        made = kept_site(cache, key)
        if made is None and (early := self._early(root, cache, key)) is not None:
            return early
        self.stop()
        if made is None:  # of an edited site nothing is kept but its parts: the next edit makes another
            made = survey(root, cache) if self.folder else finished(root, cache, survey)
        self.whole = made
        return made

    def stop(self) -> None:
        """Ends the process and all that it started."""
        process, self.process = self.process, None
        if process is not None:
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGTERM)
        if self.teller is not None:
            self.teller.join()

    def _early(self, root: Path, cache: Cache, key: str) -> Site | None:
        """The last whole site with the numbers of the cases that were edited; None if nothing takes long."""
        if self.folder is None or self.whole is None:
            return None
        if self.key == key and (self.process is None or self.process.poll() is not None):
            return None  # it has come to its end, and kept no site: something is wrong with it
        made = interim(root, cache, self.whole)
        if made is not None and self.key != key:
            self.stop()
            self._start(root, key, self.folder)
        return made

    def _start(self, root: Path, key: str, folder: Path) -> None:
        self.key = key
        process = self.process = subprocess.Popen(
            [sys.executable, "-m", "clinic.publish.later"],
            cwd=root,
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )

        assert process.stdin is not None
        lifeline = process.stdin

        def tell() -> None:
            process.wait()
            lifeline.close()
            if self.process is process:
                (folder / "done").write_text(key, encoding="utf-8")

        self.teller = threading.Thread(target=tell, daemon=True)
        self.teller.start()


def interim(root: Path, cache: Cache, whole: Site) -> Site | None:
    """The site with the numbers of every case that was edited and takes long; None if there is none, or it fails."""
    from clinic.pages.case_page import interim_page
    from clinic.pages.cases import AT_ONCE, FOLDER, PAGE
    from clinic.pages.error_page import by_case, with_problems
    from clinic.proof.experiments import EVIDENCE, evidence_of, evidence_task
    from clinic.proof.laws import breaches
    from clinic.publish.site import navigation
    from clinic.record.case import read_cases
    from clinic.record.folder import RECORD
    from clinic.work.task import run_tasks

    cases, problems = read_cases(root / "cases")
    late = [case for case in cases if takes_long(case, cache)]
    if problems or not late:
        return None
    found, _ = run_tasks([evidence_task(case) for case in late], cache)
    files = dict(whole.files)
    problems = [problem for slug, told in by_case(whole.problems).items() if slug not in found for problem in told]
    for case in late:
        if EVIDENCE not in found.get(case.slug, {}):
            return None
        folder, evidence = FOLDER.format(slug=case.slug), evidence_of(found[case.slug])
        wrong = breaches(case, evidence, *AT_ONCE)
        page = interim_page(case, evidence)
        files[PAGE.format(slug=case.slug)] = (with_problems(page, wrong) if wrong else page).encode()
        files |= {f"{folder}/{name}": (root / folder / name).read_bytes() for name in (RECORD, *case.texts)}
        problems += wrong
    return Site(
        files, navigation({case.slug: f"{case.record.number}. {case.record.title}" for case in cases}), tuple(problems)
    )


def takes_long(case: Case, cache: Cache) -> bool:
    """Whether something of the case has to be measured besides its variants."""
    from clinic.proof.experiments import measuring_tasks

    return any(not cache.path(task.key).exists() for task in measuring_tasks(case))


def survey(root: Path, cache: Cache) -> Site:
    """`clinic.publish.site.survey`, imported when it is needed."""
    from clinic.publish.site import survey

    return survey(root, cache)


def on_serve(server: LiveReloadServer, config: MkDocsConfig, **_: object) -> LiveReloadServer:
    """From now on, files are looked at more often, and what takes long is put off, if the end of it can be told."""
    watched = []
    for path in (config.docs_dir, config.config_file_path, *config.theme.dirs):
        with suppress(KeyError):  # the theme is watched if asked for
            server.unwatch(path)
            watched.append(path)
    server.observer = PollingObserver(timeout=POLLING)
    for path in watched:
        server.watch(path)
    folder = cache_folder(project_root()) / "served"
    with suppress(OSError):
        folder.mkdir(parents=True, exist_ok=True)
        LATER.folder = folder
        server.watch(str(folder))
    if LATER.asked and LATER.asked != key_of_site(project_root()):  # saved during the first build: nobody watched
        server._want_rebuild = True
    return server


def _end_with_parent() -> None:
    sys.stdin.read()
    os.killpg(0, signal.SIGTERM)


LATER = Later()


if __name__ == "__main__":
    os.nice(NICENESS)
    threading.Thread(target=_end_with_parent, daemon=True).start()
    finished(project_root(), Cache(cache_folder(project_root())), survey)
