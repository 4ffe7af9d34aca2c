"""Where the cases are: in the checkout, or in the installed package. Nothing here runs or reads a case."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

from clinic.record.problem import CaseError, Problem, closest, listed

PACKAGE = Path(__file__).parent.parent


def project_root() -> Path:
    """The checkout: the working directory or the nearest one above it that holds `cases/` and `pyproject.toml`.

    Raises:
        FileNotFoundError: If there is none.
    """
    here = Path.cwd()
    for folder in (here, *here.parents):
        if (folder / "cases").is_dir() and (folder / "pyproject.toml").is_file():
            return folder
    raise FileNotFoundError(f"this needs a checkout: no folder with cases/ and pyproject.toml at or above {here}")


def cases_root() -> Path:
    """The folder whose `cases/` can be read: the checkout, or elsewhere that of the package, which else has a copy.

    Raises:
        FileNotFoundError: If there is neither.
    """
    try:
        return project_root()
    except FileNotFoundError:
        for folder in (PACKAGE, PACKAGE.parents[1]):
            if (folder / "cases").is_dir():
                return folder
        raise


def cache_folder(root: Path) -> Path:
    """Where finished work is kept: CLINIC_CACHE, or `.cache/clinic` in the checkout, or in the user's home."""
    home = Path.home() if root == PACKAGE else root
    return Path(os.environ.get("CLINIC_CACHE") or home / ".cache" / "clinic")


def slugs(root: Path) -> list[str]:
    """The names of the folders in `cases/`, in order."""
    return sorted(path.name for path in (root / "cases").iterdir() if path.is_dir())


def folders(root: Path, wanted: Iterable[str]) -> list[Path]:
    """The folders of the cases named, each once; of all cases when none is named.

    Raises:
        CaseError: With every name that no case has, and the name nearest to it.
    """
    known = slugs(root)
    names = list(dict.fromkeys(name.removeprefix("cases/").rstrip("/") for name in wanted)) or known
    problems = []
    for name in set(names) - set(known):
        guess = closest(name, known)
        repair = f"write {guess}" if guess else "`clinic list` names them all"
        expected = f"the folder of a case: {listed(known, 30)}"
        problems.append(Problem(f"cases/{name}", 1, "", f"no case {name}", expected, repair))
    if problems:
        raise CaseError(problems)
    return [root / "cases" / name for name in names]
