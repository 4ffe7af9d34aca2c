"""A case's folder: plain text files, the record among them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from clinic.record.problem import Problem

RECORD = "case.yaml"
INSTRUMENT = "instrument.mjs"  # of a code case: what a reader can press and move on its page
SLUG = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*")


def folder_problems(folder: Path) -> Iterator[Problem]:
    """What is wrong with the folder, its name and its files, before anything in them is understood."""
    place = f"cases/{folder.name}"
    if not folder.is_dir():
        yield Problem(place, 1, "", "no folder", "only folders in cases/, one a case", "move what it is into a folder")
        return
    if not SLUG.fullmatch(folder.name):
        found, expected = f"a folder named {folder.name}", "lower-case words joined by hyphens"
        yield Problem(place, 1, "", found, expected, "rename the folder")
    if not (folder / RECORD).is_file():
        expected, repair = f"a {RECORD} in every folder of cases/", "add it, or remove the folder"
        yield Problem(place, 1, "", f"no {RECORD}", expected, repair)
    for path in sorted(folder.iterdir()):
        try:
            path.read_text(encoding="utf-8")
        except UnicodeDecodeError:
            found, repair = "bytes that are not UTF-8", "save the file as UTF-8"
            yield Problem(f"{place}/{path.name}", 1, "", found, "text in UTF-8", repair)
        except OSError:
            repair = "put the file itself into the case's folder"
            yield Problem(f"{place}/{path.name}", 1, "", "a folder, or no file", "plain files", repair)
