"""A case's folder: plain text files of bounded size, the record among them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from clinic.record.problem import Problem, closest, listed
from clinic.record.yaml_lines import CONTROL, named

RECORD = "case.yaml"
LARGEST = {RECORD: 100_000}  # bytes
LARGE = 1_000_000
SLUG = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*")


def folder_problems(folder: Path) -> Iterator[Problem]:
    """What is wrong with the folder, its name and its files, before anything in them is understood."""
    place = f"cases/{folder.name}"
    if not folder.is_dir():
        known = sorted(path.name for path in folder.parent.iterdir())
        guess = closest(folder.name, known)
        repair = f"write {guess}" if guess else "correct the name"
        yield Problem(place, 1, "", f"no folder {folder.name}", f"the folder of a case: {listed(known, 30)}", repair)
        return
    if folder.is_symlink():
        yield Problem(place, 1, "", "a symbolic link", "a folder", "put the folder itself into cases/")
        return
    if not SLUG.fullmatch(folder.name):
        yield Problem(
            place, 1, "", f"a folder named {folder.name}", "lower-case words joined by hyphens", "rename the folder"
        )
    if not (folder / RECORD).is_file():
        yield Problem(
            place, 1, "", f"no {RECORD}", f"a {RECORD} in every folder of cases/", "add it, or remove the folder"
        )
    for path in sorted(folder.iterdir()):
        if bad := unreadable(path):
            yield Problem(f"{place}/{path.name}", *bad)


def unreadable(path: Path) -> tuple[int, str, str, str, str] | None:
    """Why a file of a case is no plain text: its line, an empty field, what was found, expected, and the repair."""
    if path.is_symlink() or not path.is_file():
        kind = "a symbolic link" if path.is_symlink() else "a folder" if path.is_dir() else "no file"
        return 1, "", kind, "plain files", "put the file itself into the case's folder"
    size, largest = path.stat().st_size, LARGEST.get(path.name, LARGE)
    if size > largest:
        return 1, "", f"{size} bytes", f"{largest} bytes at most", "keep what shows the bug"
    try:
        text = path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        return 1, "", "bytes that are not UTF-8", "text in UTF-8", "save the file as UTF-8"
    if strange := CONTROL.search(text):
        line = text.count("\n", 0, strange.start()) + 1
        return line, "", named(strange[0]), "text that can be read", "delete it"
    return None
