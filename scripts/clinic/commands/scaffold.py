"""The start of a case: a folder that passes every law, for an author to put a bug into."""

from __future__ import annotations

import os
import re
import tempfile
from collections.abc import Iterable
from enum import StrEnum
from pathlib import Path

import jinja2
import yaml

from clinic.pages.error_page import read_name
from clinic.pages.schema import MODELINE
from clinic.record.checkout import slugs
from clinic.record.folder import SLUG
from clinic.record.parts import VISIBLE
from clinic.record.problem import CaseError, Problem
from clinic.record.yaml_lines import CONTROL, named

MAX_TITLE, MAX_SLUG = 90, 60
TEMPLATES = jinja2.Environment(
    loader=jinja2.PackageLoader("clinic.commands", "new"),
    variable_start_string="<<",
    variable_end_string=">>",
    block_start_string="<%",
    block_end_string="%>",
    comment_start_string="<#",
    comment_end_string="#>",
    undefined=jinja2.StrictUndefined,
    trim_blocks=True,
    keep_trailing_newline=True,
)


class Kind(StrEnum):
    """Where the bug lives."""

    model = "model"
    python = "python"
    javascript = "javascript"


FILES: dict[Kind, tuple[str, ...]] = {
    Kind.model: ("model/case.yaml", "model/model.xml"),
    Kind.python: ("script/case.yaml", "script/scene.xml", "script/script.py"),
    Kind.javascript: ("script/case.yaml", "script/scene.xml", "script/script.mjs"),
}


def start(root: Path, slug: str, title: str, kind: Kind) -> Path:
    """Writes the folder of a new case, whole or not at all, and gives its place.

    Raises:
        CaseError: If the slug or the title will not do.
    """
    if problems := [*slug_problems(root, slug), *title_problems(slug, title)]:
        raise CaseError(problems)
    place = root / "cases" / slug
    work = root / ".cache"  # beside `cases`, which a running `make serve` watches
    work.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="new-", dir=work) as made:
        folder = Path(made, slug)
        folder.mkdir()
        for name, text in files(slug, title, kind, free_number(root)).items():
            (folder / name).write_text(text, encoding="utf-8")
        os.rename(folder, place)
    return place


def files(slug: str, title: str, kind: Kind, number: int) -> dict[str, str]:
    """The files of a new case, by name."""
    line = yaml.safe_dump(" ".join(title.split()), allow_unicode=True, width=200).removesuffix("...\n").strip()
    words = {
        "slug": slug,
        "title": line,
        "number": number,
        "modeline": MODELINE,
        "script": FILES[kind][-1].rpartition("/")[2],
        "javascript": kind is Kind.javascript,
    }
    return {name.rpartition("/")[2]: TEMPLATES.get_template(name).render(words) for name in FILES[kind]}


def free_number(root: Path) -> int:
    """The smallest number that no case has, be the rest of its record as it may."""
    taken = {read_name(root / "cases" / slug).number for slug in slugs(root)}
    return next(number for number in range(1, len(taken) + 2) if number not in taken)


def slug_problems(root: Path, slug: str) -> Iterable[Problem]:
    """Why a slug will not do."""
    if not SLUG.fullmatch(slug):
        words = re.findall(r"[a-z0-9]+", slug.lower())
        guess = "-".join(words).lstrip("0123456789-")
        repair = f"write {guess}" if guess else "name the symptom: box-falls-through-floor"
        yield Problem(f"cases/{slug}", 1, "", f"the slug {slug}", "lower-case words joined by hyphens", repair)
    elif len(slug) > MAX_SLUG:
        found, repair = f"a slug of {len(slug)} characters", "name the symptom in fewer words"
        yield Problem("cases", 1, "", found, f"{MAX_SLUG} characters at most", repair)
    elif (root / "cases" / slug).exists() or slug in slugs(root):
        yield Problem(f"cases/{slug}", 1, "", "a folder that is there", "a slug of its own", "take another name")


def title_problems(slug: str, title: str) -> Iterable[Problem]:
    """Why a title will not do."""
    file, length = f"cases/{slug}/case.yaml", len(" ".join(title.split()))
    if not 1 <= length <= MAX_TITLE:
        found, repair = f"a title of {length} characters", "say what is seen, in one short sentence"
        yield Problem(file, 1, "title", found, f"1 to {MAX_TITLE} characters", repair)
    elif strange := CONTROL.search(title):
        yield Problem(file, 1, "title", named(strange[0]), "text that can be read", "delete it")
    elif not re.search(VISIBLE, title):
        yield Problem(file, 1, "title", "nothing that is seen", "the symptom as a sentence", "say what is seen")
    elif title.strip().endswith("."):
        yield Problem(file, 1, "title", title.strip(), "a sentence without a full stop", "remove the full stop")
