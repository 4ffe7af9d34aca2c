"""The scaffold of a new case: a folder that passes every law, for an author to put a bug into."""

from __future__ import annotations

import itertools
import re
import shutil
from pathlib import Path

import jinja2
import yaml

from clinic.pages.schema import MODELINE
from clinic.record.case import load_case
from clinic.record.folder import RECORD, SLUG
from clinic.record.problem import CaseError, Problem

SOURCES = {"model": "model.xml", "python": "script.py", "javascript": "script.mjs"}  # the broken file, by kind
TEMPLATES = jinja2.Environment(  # `{{ }}` is what a record's prose writes
    loader=jinja2.PackageLoader("clinic.commands", "new"),
    variable_start_string="<<",
    variable_end_string=">>",
    block_start_string="<%",
    block_end_string="%>",
    undefined=jinja2.StrictUndefined,
    trim_blocks=True,
    keep_trailing_newline=True,
)


def write_case(root: Path, slug: str, title: str, kind: str, family: str) -> Path:
    """Writes the folder of a new case, whole or not at all, and gives its place; `kind` is one of SOURCES.

    `family` is the name of one.

    Raises:
        CaseError: If the slug, the title or the family will not do.
    """
    check_slug(root, slug)
    place = root / "cases" / slug
    place.mkdir()
    for name, text in case_texts(slug, title, kind, free_number(root), family).items():
        (place / name).write_text(text, encoding="utf-8")
    try:
        load_case(place)
    except CaseError:
        shutil.rmtree(place)
        raise
    return place


def check_slug(root: Path, slug: str) -> None:
    """Refuses what can be no new case's folder.

    Raises:
        CaseError: If it is no slug, or taken.
    """
    place = root / "cases" / slug
    if not SLUG.fullmatch(slug) or place.exists():
        found = f"the slug {slug}{', which is taken' if place.exists() else ''}"
        expected = "a name of its own: lower-case words joined by hyphens"
        repair = "name the symptom, as in box-falls-through-floor"
        raise CaseError([Problem(f"cases/{slug}", 1, "", found, expected, repair)])


def case_texts(slug: str, title: str, kind: str, number: int, family: str) -> dict[str, str]:
    """The files of a new case, by name."""
    sentence = " ".join(title.split()).removesuffix(".")
    quoted = yaml.safe_dump(sentence, allow_unicode=True, width=200).removesuffix("...\n").strip()
    source = SOURCES[kind]
    words = {"slug": slug, "title": quoted, "number": number, "modeline": MODELINE, "source": source, "kind": kind}
    words["family"] = family
    return {name: TEMPLATES.get_template(name).render(words) for name in sorted({RECORD, "model.xml", source})}


def free_number(root: Path) -> int:
    """The smallest number that no case has, be the rest of its record as it may."""
    records = (path.read_text(encoding="utf-8") for path in (root / "cases").glob(f"*/{RECORD}"))
    taken = {int(number) for text in records for number in re.findall(r"^number: *(\d+)", text, re.MULTILINE)}
    return next(number for number in itertools.count(1) if number not in taken)
