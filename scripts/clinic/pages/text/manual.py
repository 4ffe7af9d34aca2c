"""Links into MuJoCo's manual, of the installed version, checked against the copy that comes with the engine."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import mujoco

from clinic.record.case import Case
from clinic.record.problem import Problem, closest, listed

ADDRESS = "https://mujoco.readthedocs.io/en/{version}/{page}"
LABEL = re.compile(r"^\.\. _([A-Za-z][\w-]*):\s*$")
RULE = re.compile(r"^([=\-~^\"'`#*+.])\1{2,}$")


def address(page: str) -> str:
    """The page of the manual of the installed version."""
    return ADDRESS.format(version=mujoco.__version__, page=page)


def title(page: str) -> str:
    """What a link to the page says: its title, and what stands at the anchor."""
    file, _, anchor = page.partition("#")
    known = anchors(file)
    whole = next(iter(known.values()), Path(file).stem)
    return f"{whole}: {known[anchor]}" if anchor in known else whole


@cache
def anchors(page: str) -> dict[str, str]:
    """The anchors of a page with what stands there, by the page's address without the manual's; empty without one."""
    source = Path(mujoco.__file__).parent / "doc" / Path(page).with_suffix(".rst")
    if not source.is_file():
        return {}
    lines = source.read_text(encoding="utf-8").splitlines()
    found: dict[str, str] = {}
    labels: list[str] = []
    for line, following in zip(lines, [*lines[1:], ""], strict=True):
        if match := LABEL.match(line):
            labels.append(match[1])
        elif line.strip() and not RULE.match(line):
            heading = re.sub(r":[\w-]+:`([^`<]*?)\s*(?:<[^>]*>)?`|\s*\|[^|]*\|\s*|\*\*|``", r"\1", line).strip()
            if RULE.match(following):
                labels.append(heading)
            else:  # an attribute, or several, with their types
                heading = re.split("[:,]", heading)[0]
            found |= {_slug(label): heading for label in labels}
            labels = []
    return found


def manual_problems(case: Case) -> Iterator[Problem]:
    """Links of a case that lead nowhere."""
    for index, page in enumerate(case.record.manual):
        file, _, anchor = page.partition("#")
        known = anchors(file)
        if not known:
            expected = "a page of the manual: XMLreference.html, modeling.html, computation/index.html, ..."
            yield case.problem(("manual", index), f"{file}, which is not there", expected, "correct the page")
        elif anchor and anchor not in known:
            found, guess = f"#{anchor}, which {file} does not have", closest(anchor, known)
            near = [name for name in known if name.startswith(anchor[:4])] or list(known)
            repair = f"write {file}#{guess}" if guess else "correct the anchor"
            yield case.problem(("manual", index), found, f"an anchor: {listed(near)}", repair)


def _slug(text: str) -> str:
    """An anchor as Sphinx writes it."""
    return re.sub(r"[^a-z0-9]+", "-", text.lower()).strip("-")
