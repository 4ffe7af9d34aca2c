"""Links into MuJoCo's manual, of the installed version, checked against the copy that comes with the engine."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import mujoco

from clinic.record.case import Case
from clinic.record.problem import Problem, closest, listed

REFERENCE = "XMLreference.html"
SPAN = re.compile(r"`([^`]+)`")
CODE_WORD = re.compile(r"[A-Za-z_]{4,}")
LABEL = re.compile(r"^\.\. _([A-Za-z][\w-]*):\s*$")
RULE = re.compile(r"^([=\-~^\"'`#*+.])\1{2,}$")


def address(page: str) -> str:
    """The page of the manual of the installed version."""
    return f"https://mujoco.readthedocs.io/en/{mujoco.__version__}/{page}"


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
                found |= dict.fromkeys(map(_slug, [*labels, heading]), heading)
            else:  # an attribute, or several, with their types: each label ends with its own
                several = [name.strip() for name in heading.partition(":")[0].split(",")]
                for label in map(_slug, labels):
                    own = (name for name in several if name and label.endswith(_slug(name)))
                    found[label] = next(own, several[0])
            labels = []
    return found


def _slug(label: str) -> str:
    """A label as Sphinx writes it."""
    return re.sub(r"[^a-z0-9]+", "-", label.lower()).strip("-")


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
        elif anchor and not _spoken(case, file, anchor, known[anchor]):
            found, wanted = (
                f"#{anchor}, {known[anchor]}: the case speaks of no such thing",
                "what prose or an edit names",
            )
            yield case.problem(
                ("manual", index), found, wanted, "correct the anchor, or say what it has to do with this"
            )


def _spoken(case: Case, file: str, anchor: str, heading: str) -> bool:
    """Whether the record names the attribute; of a section, a word of its heading, code or a tag that stands in it."""
    told = case.record.model_dump_json(exclude={"manual", "see", "tags"})
    if file == REFERENCE:
        return any(re.search(rf"(?<![a-z]){word}", told) for word in re.findall(r"\w+", heading))
    named = [word for word in re.findall(r"[a-z]+", heading.lower()) if len(word) > 3]
    code, passage = set(CODE_WORD.findall(" ".join(SPAN.findall(told)))), passage_words(file, anchor)
    code |= {*case.record.tags}
    return not passage or bool(code & passage) or any(word[:6] in told.lower() for word in named)


@cache
def passage_words(page: str, anchor: str) -> set[str]:
    """The words of what stands at a label, and at the next one; empty if the anchor is that of a heading."""
    source = (Path(mujoco.__file__).parent / "doc" / Path(page).with_suffix(".rst")).read_text(encoding="utf-8")
    passages = re.split(r"^\.\. _", source, flags=re.MULTILINE)[1:]
    labels = [_slug(passage.partition(":")[0]) for passage in passages]
    if anchor not in labels:
        return set()
    place = labels.index(anchor)
    return set(CODE_WORD.findall(" ".join(passages[place : place + 2])))
