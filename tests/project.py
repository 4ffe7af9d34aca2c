"""A small checkout of two tiny cases that builds as the real one does, for tests of whole builds."""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import sys
from pathlib import Path

import clinic
from clinic.pages.overviews import REFERENCE_MARK
from clinic.triage.steps import STEPS
from helpers import write_case, write_script_case

ROOT = Path(__file__).parent.parent
SILENT = ("film: {}\n", "")
COPIED = (
    "mkdocs.yml",
    "pyproject.toml",
    "scripts/gen_pages.py",
    "scripts/hooks.py",
    "scripts/theme",
    "docs/tags.md",
    "docs/stylesheets",
)
CHECK = "# Check your models in CI\n\n## What a model silences { #silence }\n"
TRIAGE = "# Triage\n\nThe table is made by the build.\n\n```python run\nprint(2 * 3)\n```\n"
TRIAGE += "".join(f"\n## {title} {{ #{step} }}\n" for step, (title, _) in STEPS.items())


def write_project(folder: Path, *changes: tuple[str, str], kept: Path | None = None) -> Path:
    """Writes the project with a model case, its record changed, and a script case; `kept` is a cache to begin with."""
    for name in COPIED:
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copy
        copy(ROOT / name, target)
    package = Path(clinic.__file__).parent  # a copy, so that nothing depends on what happens to the checkout meanwhile
    shutil.copytree(package, folder / "scripts" / "clinic")
    (folder / "docs" / "triage.md").write_text(TRIAGE, encoding="utf-8")
    (folder / "docs" / "check-your-models.md").write_text(CHECK, encoding="utf-8")
    (folder / "docs" / "contribute").mkdir()
    for name in ("add-a-case", "the-record", "work-on-the-code"):
        (folder / "docs" / "contribute" / f"{name}.md").write_text(f"# {name}\n\n{REFERENCE_MARK}\n", encoding="utf-8")
    write_case(folder, ("duration: 0.4", "duration: 0.2"), *changes)
    write_script_case(folder)
    if kept is not None:
        shutil.copytree(kept, folder / "cache")
    return folder


def run(folder: Path, *command: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Runs Python in a project, in a process group of its own."""
    return subprocess.run(
        [sys.executable, *command],
        cwd=folder,
        env=settings(folder) | environment,
        check=False,
        capture_output=True,
        text=True,
        start_new_session=True,
    )


def settings(folder: Path) -> dict[str, str]:
    """The environment of a build in a project: its own package and cache, one worker."""
    kept = {name: value for name, value in os.environ.items() if name not in ("CI", "SITE_URL")}
    quiet = {"NO_MKDOCS_2_WARNING": "1", "DISABLE_MKDOCS_2_WARNING": "true"}
    own = {"CLINIC_CACHE": str(folder / "cache"), "PYTHONPATH": str(folder / "scripts"), "CLINIC_JOBS": "1"}
    return kept | quiet | own


def bytes_of(folder: Path) -> dict[str, str]:
    """A digest of every file below a folder, by its path."""
    return {
        path.relative_to(folder).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }
