"""Measures what a build costs, beside its aims and beside what it cannot be faster than. Called by `make bench`."""

from __future__ import annotations

import argparse
import re
import socket
import statistics
import subprocess
import sys
import tempfile
import time
import urllib.request
from collections import defaultdict
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import clinic.engine.measure
import hosted
import mujoco
from clinic.engine.simulate import captured_messages, controls, initial_data, step_count
from clinic.pages.case_files import drawing_tasks
from clinic.proof.experiments import evidence_task, measuring_tasks, whole_evidence
from clinic.record.case import Case, read_cases
from clinic.record.checkout import project_root
from clinic.work.task import Task
from measured import PAGE, copied, finished, machine, markdown, put, python, show, surroundings, timed, write

REPEATS, PAIRS = 3, 7
COLD, WARM, EDIT, NUMBERS, TESTS = 90.0, 1.3, 2.0, 4.0, 360.0  # s, times MkDocs alone, s, s, s
PATIENCE = 300.0  # s
LOADS, SCORE = 5, 97  # of Lighthouse, whose score of time varies by a few points; of 100
LOADED = {"the first page": "index.html", "a case": "cases/box-falls-through-floor/index.html"}
MEASURING = "Being measured"  # as an interim page says
PARTS = {"film": "rendering", "pictures": "rendering", "plots": "plotting"}
HEAD = ("what", "measured", "aim")
SHARES = ("part of a cold build, one after the other", "time", "share")


class Physics:
    """How many steps the simulations make, and the seconds that these take with and without us.

    While it is in use, every simulation is made twice: by `mj_step` alone first.
    """

    def __init__(self) -> None:
        self.steps, self.bare, self.ours = 0, 0.0, 0.0

    def simulate(self, model: mujoco.MjModel, spec: Any, paths: Any, nudge: Any = None) -> Any:
        """What `clinic.engine.simulate.simulate` gives."""
        data, steps = initial_data(model, spec, nudge), step_count(model, spec)
        controls(model, spec, steps)(data, 0)
        with captured_messages():
            self.bare += timed(lambda: mujoco.mj_step(model, data, nstep=steps))
        self.steps += steps
        begun = time.perf_counter()
        try:
            return clinic.engine.simulate.simulate(model, spec, paths, nudge)
        finally:
            self.ours += time.perf_counter() - begun


def parts(cases: list[Case]) -> tuple[dict[str, float], Physics]:
    """Seconds of each kind of work, made anew one after the other in this process, and the physics in it."""
    spent: dict[str, float] = defaultdict(float)
    physics = Physics()
    clinic.engine.measure.simulate = physics.simulate

    def run(task: Task) -> dict[str, bytes]:
        begun, bare, ours = time.perf_counter(), physics.bare, physics.ours
        files = task.make()
        simulated = physics.ours - ours
        spent["physics"] += simulated
        kind = PARTS.get(task.kind, "snippets, scripts, and whether a model compiles")
        spent[kind] += time.perf_counter() - begun - simulated - (physics.bare - bare)
        return files

    try:
        for case in cases:
            first, rest = run(evidence_task(case)), {}
            for task in measuring_tasks(case):
                rest |= run(task)
            for task in drawing_tasks(case, whole_evidence(case, first, rest)):
                run(task)
    finally:
        clinic.engine.measure.simulate = clinic.engine.simulate.simulate
    return dict(spent), physics


@contextmanager
def served(folder: Path, cache: Path) -> Iterator[str]:
    """The address of the copy's site, served as `make serve` does."""
    with socket.create_server(("127.0.0.1", 0)) as probe:
        port = probe.getsockname()[1]
    command = [sys.executable, "-m", "mkdocs", "serve", "--livereload", "--dirty", "--dev-addr", f"127.0.0.1:{port}"]
    with subprocess.Popen(
        command, cwd=folder, env=surroundings(folder, cache), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    ) as process:
        try:
            await_page(f"http://127.0.0.1:{port}/index.html", holding("<h1"))
            yield f"http://127.0.0.1:{port}/"
        finally:
            process.terminate()


def holding(text: str) -> Callable[[str], bool]:
    """Whether a page holds the text."""
    return lambda page: text in page


def await_page(address: str, shown: Callable[[str], bool]) -> None:
    """Asks until the page is as wanted."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        try:
            with urllib.request.urlopen(address, timeout=PATIENCE) as answer:
                if shown(answer.read().decode()):
                    return
        except OSError:
            pass
        time.sleep(0.02)
    sys.exit(f"{address} is not as it should be after {PATIENCE:g} s")


def edits(folder: Path, cache: Path, slug: str, repeats: int = REPEATS) -> tuple[float, ...]:
    """Seconds from saving an edit of a case's prose to its page; of its model, to its numbers and to the whole page."""
    case = folder / "cases" / slug
    spent = []
    with served(folder, cache) as address:
        page = f"{address}cases/{slug}/index.html"

        def saved(name: str, old: str, new: str, shown: Callable[[str], bool]) -> float:
            text = (case / name).read_text(encoding="utf-8")
            made, count = re.subn(old, new, text, count=1, flags=re.MULTILINE)
            assert count == 1, f"{name} has no {old}"
            (case / name).write_text(made, encoding="utf-8")
            return timed(lambda: await_page(page, shown))

        for k in range(repeats + 1):  # the first edit also warms the server's processes
            told = f"Edited{k}."
            prose = saved("case.yaml", r"^lesson: \|\n", f"lesson: |\n  {told}\n\n", holding(told))
            numbers = saved("model.xml", r"</mujoco>\s*\Z", f"<!-- {k} --></mujoco>\n", holding(MEASURING))
            rest = timed(lambda: await_page(page, lambda text: MEASURING not in text))
            spent.append((prose, numbers, numbers + rest))
    return tuple(statistics.median(times) for times in zip(*spent[-repeats:], strict=True))


def builds(root: Path, folder: Path) -> tuple[list[tuple[str, str, str]], float]:
    """The rows about whole builds, and the seconds of MkDocs alone."""
    copy, cache = copied(root, folder / "copy"), folder / "cache"
    build = ("-m", "mkdocs", "build", "--strict", "--site-dir", str(folder / "site"))
    cold = timed(lambda: python(copy, cache, *build))
    plain = finished(copy, cache, folder / "finished" / "docs")
    alone, warm = [], []
    for _ in range(PAIRS):
        alone.append(timed(lambda: python(copy, cache, *build, "--config-file", plain.name)))
        warm.append(timed(lambda: python(copy, cache, *build)))
    limit, again = statistics.median(alone), statistics.median(warm)
    times = statistics.median(ours / theirs for ours, theirs in zip(warm, alone, strict=True))  # side by side
    slug = min((case.record.number, case.slug) for case in read_cases(copy / "cases")[0] if case.record.model)[1]
    prose, numbers, whole = edits(copy, cache, slug)
    rows = [
        ("cold build, with films and sweeps", f"{cold:.1f} s", f"below {COLD:g} s"),
        ("warm build", f"{again:.1f} s, {times:.2f} times MkDocs alone", f"{WARM:g} times at most"),
        ("MkDocs alone, given the finished pages", f"{limit:.1f} s", ""),
        ("an edit of prose, from saving to the page", f"{prose:.1f} s", f"below {EDIT:g} s"),
        ("an edit of a model, from saving to its numbers on the page", f"{numbers:.1f} s", f"below {NUMBERS:g} s"),
        ("the same, to its film, plots and sweeps", f"{whole:.1f} s", ""),
    ]
    return rows, limit


def tests(root: Path, folder: Path) -> tuple[str, str, str]:
    """The row about the tests, with nothing kept."""
    command = ["make", "--silent", "test"]
    environment = surroundings(root, folder / "tests")
    done = []
    spent = timed(lambda: done.append(subprocess.run(command, cwd=root, env=environment, check=False).returncode))
    return f"`make test`{', which fails' if done[0] else ''}", f"{spent / 60:.1f} min", f"below {TESTS / 60:g} min"


def loading(root: Path, site: Path) -> Iterator[tuple[str, str, str]]:
    """How quickly pages are there on a telephone: the row of each."""
    with hosted.served(site) as address:
        for name, page in LOADED.items():
            said = [hosted.lighthouse(root, address + page, "performance") for _ in range(LOADS)]
            score = statistics.median(100 * one["categories"]["performance"]["score"] for one in said)
            times = [
                statistics.median(one["audits"][audit]["numericValue"] for one in said)
                for audit in ("largest-contentful-paint", "total-blocking-time")
            ]
            shown = f"{score:.0f}; its largest part after {times[0] / 1000:.1f} s, {times[1]:.0f} ms blocked"
            yield f"Lighthouse of {name}, median of {LOADS}", shown, f"{SCORE} at least"


def main() -> None:
    """Prints the tables, and puts them into *Work on the code* when asked to."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--write", action="store_true", help="put the tables into *Work on the code*")
    parser.add_argument("--tests", action="store_true", help="time `make test` too")
    asked = parser.parse_args()
    root = project_root()
    if asked.write:
        put((root / PAGE).read_text(encoding="utf-8"), "cost", "")
    cases = read_cases(root / "cases")[0]
    with tempfile.TemporaryDirectory() as folder:
        rows, alone = builds(root, Path(folder))
        spent, physics = parts(cases)
        times = f"{physics.ours:.1f} s, {physics.ours / physics.bare:.1f} times `mj_step` alone"
        rows.append((f"physics, {physics.steps:,} steps, in one process", times, ""))
        rows.append(("`mj_step` alone, as many steps", f"{physics.bare:.1f} s", ""))
        rows += loading(root, Path(folder, "site"))
        if asked.tests:
            rows.append(tests(root, Path(folder)))
    spent["MkDocs alone"] = alone
    whole = sum(spent.values())
    ordered = sorted(spent.items(), key=lambda item: -item[1])
    shares = [SHARES, *((kind, f"{seconds:.1f} s", f"{seconds / whole:.0%}") for kind, seconds in ordered)]
    said = f"{len(cases)} cases: {machine()}"
    show(said, [HEAD, *rows])
    show(said, shares)
    if asked.write:
        write(root, "cost", f"Measured by `make bench` with {said}.", markdown([HEAD, *rows]), markdown(shares))


if __name__ == "__main__":
    main()
