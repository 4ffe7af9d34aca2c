"""Measures how the site grows: 100, 300 and 1,000 cases, varied from those there are. Called by `make growth`.

Simulating, drawing and filming a case is work of its own that no other case makes longer, so a varied case is given
what its original showed. Measured is what is left: reading, judging and writing all pages, MkDocs, what a reader loads.
The sites are built by turns, several times, and the least time of each counts: what else a machine does slows a build,
and nothing quickens it.
"""

from __future__ import annotations

import argparse
import gzip
import json
import os
import re
import shutil
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import yaml
from clinic.pages.case_files import drawing_tasks
from clinic.pages.overviews import screening_tasks
from clinic.pages.search_index import FILE
from clinic.proof.experiments import EVIDENCE, evidence_of, evidence_task, measuring_tasks, whole_evidence
from clinic.record.case import Case, read_cases
from clinic.record.checkout import project_root
from clinic.record.yaml_lines import read_yaml
from clinic.work.cache import Cache, Files
from clinic.work.task import Task
from hosted import served
from measured import PAGE, copied, machine, markdown, put, python, show, write
from playwright.sync_api import sync_playwright

SIZES = (100, 300, 1000)
TURNS = 4
MEMORY, SPREAD = 1.5, 0.2  # GB, share
INDEX, QUICK = 700, 50  # KB, ms
BEAT = 0.1  # s
TELLING = "record.telling"  # a variation belongs to no family: what its prose says of one would have no number
HEAD = ("cases", "warm build", "time a case", "peak memory", "home page", "search index", "search ready", "a query")
QUERY = """async (queries) => {
  const box = document.querySelector(".search input");
  const ask = async (query) => {
    box.value = query;
    box.dispatchEvent(new Event("input"));
    while (document.querySelector(".search-results").hidden) await new Promise(requestAnimationFrame);
  };
  const begun = performance.now();
  await ask(queries[0]);
  const ready = performance.now();
  for (const query of queries) await ask(query);
  return [ready - begun, (performance.now() - ready) / queries.length];
}"""


def varied(case: Case, record: dict[str, object], slugs: list[str], turn: int, number: int) -> dict[str, object]:
    """The record of a case's variation in this turn, with its relations to the variations of the same turn."""
    text = json.dumps({key: value for key, value in record.items() if key not in ("family", "telling")})
    for slug in slugs:
        text = text.replace(f"../{slug}/", f"../{slug}-{turn}/")
    made: dict[str, object] = json.loads(text)
    phrases = [f"{phrase} {turn}" for phrase in case.record.phrases]
    title = f"{case.record.title[:80]} ({turn})"
    see = [f"{slug}-{turn}" for slug in case.record.see if slug in slugs]
    return made | {"number": number, "title": title, "phrases": phrases, "see": see}


def grow(folder: Path, cache: Cache, size: int) -> None:
    """Adds variations to the cases of a copy until there are as many as asked for, and keeps what they showed."""
    originals = read_cases(folder / "cases")[0]
    models = [
        case
        for case in originals
        if case.record.run is not None
        and TELLING not in (folder / "cases" / case.slug / "case.yaml").read_text(encoding="utf-8")
    ]
    number = max(case.record.number or 0 for case in originals)
    turn = 0
    while number < size:
        turn += 1
        batch = models[: size - number]
        slugs = [case.slug for case in batch]
        for case in batch:
            number += 1
            place = folder / "cases" / f"{case.slug}-{turn}"
            place.mkdir()
            record = read_yaml((folder / "cases" / case.slug / "case.yaml").read_text(encoding="utf-8"))[0]
            new = varied(case, record, slugs, turn, number)
            (place / "case.yaml").write_text(yaml.safe_dump(new, allow_unicode=True, sort_keys=False), encoding="utf-8")
            for name, text in case.texts.items():
                (place / name).write_text(text, encoding="utf-8")
    for case in read_cases(folder / "cases")[0]:
        original = next((one for one in models if re.fullmatch(rf"{one.slug}-\d+", case.slug)), None)
        if original is not None:
            keep(original, case, cache)


def keep(original: Case, case: Case, cache: Cache) -> None:
    """Keeps what the original showed as what its variation shows."""
    first = kept(cache, evidence_task(original))
    shown = evidence_of(first).model_copy(update={"case": case.slug, "number": case.record.number})
    renamed = {**first, EVIDENCE: shown.model_dump_json().encode()}
    cache.put(evidence_task(case).key, renamed)
    rest = {}
    for old, new in zip(measuring_tasks(original), measuring_tasks(case), strict=True):
        files = kept(cache, old)
        cache.put(new.key, files)
        rest |= files
    before, after = whole_evidence(original, first, rest), whole_evidence(case, renamed, rest)
    for old, new in zip(drawing_tasks(original, before), drawing_tasks(case, after), strict=True):
        cache.put(new.key, kept(cache, old))
    for old, new in zip(screening_tasks([original]), screening_tasks([case]), strict=True):
        cache.put(new.key, kept(cache, old))


def kept(cache: Cache, task: Task) -> Files:
    """What a task has made."""
    files = cache.get(task.key)
    if files is None:
        sys.exit(f"{task.slug}: its {task.kind} is not kept; was the package changed meanwhile? Start again")
    return files


def build(folder: Path, cache: Path, out: Path) -> float:
    """Seconds of a strict build of the copy."""
    begun = time.perf_counter()
    python(folder, cache, "-m", "mkdocs", "build", "--strict", "--site-dir", str(out))
    return time.perf_counter() - begun


@contextmanager
def watched() -> Iterator[list[int]]:
    """Adds to a list, again and again, the bytes of memory that all processes started from here hold."""
    seen, ended = [0], threading.Event()

    def watch() -> None:
        while not ended.wait(BEAT):
            seen.append(sum(map(resident, tree(os.getpid())[1:])))

    watcher = threading.Thread(target=watch)
    watcher.start()
    try:
        yield seen
    finally:
        ended.set()
        watcher.join()


def tree(pid: int) -> list[int]:
    """A process and all that it started, by their ids."""
    found = [pid]
    for parent in found:
        for task in Path(f"/proc/{parent}/task").glob("*/children"):
            try:
                found += map(int, task.read_text(encoding="ascii").split())
            except OSError:  # it has ended
                continue
    return found


def resident(pid: int) -> int:
    """The bytes of memory that a process holds, its share of what it shares; 0 if it has ended."""
    try:
        found = re.search(
            r"^Pss:\s+(\d+) kB", Path(f"/proc/{pid}/smaps_rollup").read_text(encoding="ascii"), re.MULTILINE
        )
    except OSError:
        return 0
    return int(found[1]) * 1024 if found else 0


def search(site: Path, queries: list[str]) -> tuple[float, float]:
    """Seconds until the search is ready in a browser, and of a query."""
    path = shutil.which("chromium") or shutil.which("google-chrome")
    with served(site) as address, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=["--no-sandbox", "--disable-gpu"])
        page = browser.new_page()
        page.set_default_timeout(0)
        page.goto(f"{address}index.html")  # and its script has run: a letter before is heard by nobody
        ready, query = page.evaluate(QUERY, queries)
        browser.close()
    return ready / 1000, query / 1000


@dataclass
class Site:
    """A site of so many cases, and what was measured of it: GB at once at the most, seconds of each build, KB, ms."""

    size: int
    folder: Path
    cache: Path
    queries: list[str]
    peak: float
    spent: list[float]
    index: float = 0.0
    query: float = 0.0

    @property
    def out(self) -> Path:
        """Where it is built."""
        return self.folder / "site"

    @property
    def each(self) -> float:
        """Seconds a case of the quickest build."""
        return min(self.spent) / self.size

    def build(self) -> None:
        """Builds it once more."""
        self.spent.append(build(self.folder / "copy", self.cache, self.out))

    def row(self) -> tuple[str, ...]:
        """Its row of the table."""
        ready, query = search(self.out, self.queries)
        home, index = ((self.out / name).read_bytes() for name in ("index.html", FILE))
        self.index, self.query = len(index) / 1e3, 1000 * query
        return (
            f"{self.size:,}",
            f"{min(self.spent):.1f} s",
            f"{1000 * self.each:.0f} ms",
            f"{self.peak:.2f} GB",
            f"{len(home) / 1e6:.2f} MB",
            f"{self.index:.0f} KB, {len(gzip.compress(index, 6)) / 1e3:.0f} compressed",
            f"{ready:.1f} s",
            f"{self.query:.0f} ms",
        )

    def missed(self, least: Site) -> list[str]:
        """The aims that it misses, growing from the least of the sites; once its row is there."""
        measured = {
            "the time a case": (self.each / least.each, 1 + SPREAD),
            "the memory": (self.peak, MEMORY),
            "the search index": (self.index, INDEX),
            "a query": (self.query, QUICK),
        }
        return [name for name, (value, most) in measured.items() if value > most]


def grown(root: Path, folder: Path, cache: Path, size: int) -> Site:
    """A site of so many cases, built until all is kept that can be."""
    copy = copied(root, folder / "copy")
    build(copy, cache, folder / "site")
    queries = [phrase for case in read_cases(copy / "cases")[0] for phrase in case.record.phrases][:40]
    grow(copy, Cache(cache), size)
    build(copy, cache, folder / "site")
    with watched() as seen:
        build(copy, cache, folder / "site")
    return Site(size, folder, cache, queries, max(seen) / 1e9, [])


def main() -> None:
    """Prints the table, and puts it into *Work on the code* when asked to."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--write", action="store_true", help="put the table into *Work on the code*")
    parser.add_argument("sizes", type=int, nargs="*", default=SIZES, help="how many cases")
    asked = parser.parse_args()
    root = project_root()
    if asked.write:
        put((root / PAGE).read_text(encoding="utf-8"), "growth", "")
    with tempfile.TemporaryDirectory() as folder:
        sites = [grown(root, Path(folder, str(size)), Path(folder, "cache"), size) for size in asked.sizes]
        for _ in range(TURNS):
            for site in sites:
                site.build()
                print(f"{site.size}: {site.spent[-1]:.1f} s, {site.peak:.2f} GB", file=sys.stderr)
        rows = [HEAD, *(site.row() for site in sites)]
    aim = (
        f"Aims: a time a case that grows by {SPREAD:.0%} at most, less than {MEMORY:g} GB of memory, "
        f"a search index of {INDEX:g} KB at most, and a query within {QUICK:g} ms."
    )
    said = f"Here it is {sites[-1].each / sites[0].each:.2f} times as long at the largest size. "
    said += f"Missed there: {', '.join(sites[-1].missed(sites[0])) or 'none'}."
    show(machine(), rows)
    print(aim, said)
    if asked.write:
        how = f"Measured by `make growth`, the least of {TURNS} builds by turns, on {machine()}."
        write(root, "growth", how, markdown(rows), f"{aim} {said}")


if __name__ == "__main__":
    main()
