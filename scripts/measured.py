"""What `make bench` and `make growth` share: commands in a copy of the checkout, and tables in *Work on the code*."""

from __future__ import annotations

import os
import platform
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

import mujoco
import yaml
from clinic.publish.page_head import about
from clinic.work.parallel import jobs
from mkdocs.utils.yaml import get_yaml_loader
from rich.console import Console
from rich.table import Table

NOT_COPIED = shutil.ignore_patterns(".*", "site", "node_modules", "__pycache__", "case.schema.json")
GENERATOR = "gen-files"
PAGE = "docs/contribute/work-on-the-code.md"
Row = Sequence[str]


def timed(work: Callable[[], object]) -> float:
    """Seconds that `work` takes."""
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def copied(root: Path, folder: Path) -> Path:
    """A copy of the checkout, so that nothing depends on what happens to it meanwhile."""
    made = Path(shutil.copytree(root, folder, ignore=NOT_COPIED))
    if (root / "node_modules").is_dir():
        (made / "node_modules").symlink_to(root / "node_modules")
    return made


def surroundings(folder: Path, cache: Path) -> dict[str, str]:
    """The environment of a command in a copy: its own package, and a cache of its own."""
    kept = {name: value for name, value in os.environ.items() if name not in ("CI", "SITE_URL", "CLINIC_DASK")}
    quiet = {"NO_MKDOCS_2_WARNING": "1", "DISABLE_MKDOCS_2_WARNING": "true"}
    return kept | quiet | {"PYTHONPATH": str(folder / "scripts"), "CLINIC_CACHE": str(cache)}


def python(folder: Path, cache: Path, *command: str) -> None:
    """Runs Python in a copy; a command that fails ends everything with what it said."""
    done = subprocess.run(
        [sys.executable, *command],
        cwd=folder,
        env=surroundings(folder, cache),
        check=False,
        capture_output=True,
        text=True,
    )
    if done.returncode:
        sys.exit(f"{' '.join(command)}:\n{done.stdout}{done.stderr}")


def plain_settings(folder: Path, pages: Path) -> Path:
    """The settings of a site of finished pages, with the same theme and plugins but nothing of ours."""
    given = yaml.load((folder / "mkdocs.yml").read_text(encoding="utf-8"), get_yaml_loader())
    navigation = yaml.safe_load((pages.parent / "nav.yml").read_text(encoding="utf-8"))
    plugins = [plugin for plugin in given["plugins"] if plugin != GENERATOR and GENERATOR not in plugin]
    bare: dict[str, object] = {"hooks": [], "watch": [], "extra": {"about": about()}}
    changes = {"docs_dir": str(pages), "plugins": plugins, "nav": navigation, **bare}
    made = folder / "plain.yml"
    made.write_text(yaml.safe_dump({"INHERIT": "mkdocs.yml", **changes}, sort_keys=False), encoding="utf-8")
    return made


FINISHED = """
import sys, yaml
from pathlib import Path
from clinic.publish.site import make_site
from clinic.record.checkout import cache_folder
from clinic.work.cache import Cache
out = Path(sys.argv[1])
made = make_site(Path(), Cache(cache_folder(Path())))
for name, content in made.files.items():
    (out / name).parent.mkdir(parents=True, exist_ok=True)
    (out / name).write_bytes(content)
(out.parent / "nav.yml").write_text(yaml.safe_dump(made.navigation), encoding="utf-8")
"""


def finished(folder: Path, cache: Path, pages: Path) -> Path:
    """The settings of a plain site with the finished pages of the copy, written to the folder `pages`."""
    shutil.copytree(folder / "docs", pages)
    python(folder, cache, "-c", FINISHED, str(pages))
    return plain_settings(folder, pages)


def machine() -> str:
    """What was measured on, without names."""
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    versions = f"Python {platform.python_version()}, MuJoCo {mujoco.__version__}"
    return f"{os.cpu_count()} cores, {memory:.0f} GiB of memory, {platform.machine()}, {versions}, {jobs()} processes"


def markdown(rows: Iterable[Row]) -> str:
    """The rows as a table, the first as its head; numbers to the right."""
    head, *body = rows
    marks = ["---", *("--:" for _ in head[1:])]
    return "\n".join(f"| {' | '.join(row)} |" for row in [head, marks, *body])


def show(title: str, rows: Iterable[Row]) -> None:
    """Prints the rows as a table, the first as its head."""
    head, *body = rows
    table = Table(*head, title=title)
    for row in body:
        table.add_row(*row)
    Console().print(table)


def put(text: str, anchor: str, body: str) -> str:
    """The text with `body` in place of what stood between the heading of this anchor and the next heading.

    Raises:
        ValueError: If there is no such heading, or more than one.
    """
    section = re.compile(rf"(^#+ [^\n]* {{ #{anchor} }}\n).*?(?=^#|\Z)", re.MULTILINE | re.DOTALL)
    made, count = section.subn(lambda match: f"{match[1]}\n{body.strip()}\n\n", text)
    if count != 1:
        raise ValueError(f"{count} headings with the anchor #{anchor}, expected one")
    return made.rstrip("\n") + "\n"


def write(root: Path, anchor: str, *parts: str) -> None:
    """Puts the parts, a paragraph or a table each, into PAGE."""
    page = root / PAGE
    page.write_text(put(page.read_text(encoding="utf-8"), anchor, "\n\n".join(parts)), encoding="utf-8")
