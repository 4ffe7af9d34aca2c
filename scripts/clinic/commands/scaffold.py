"""The scaffold of a new case: a folder that passes every law, for an author to put a bug into."""

from __future__ import annotations

import itertools
import re
import tempfile
from pathlib import Path

import jinja2
import yaml

from clinic.pages.schema import MODELINE
from clinic.record.case import load_case
from clinic.record.folder import RECORD, SLUG
from clinic.record.problem import CaseError, Problem

MAX_SLUG = 60
SOURCES = {"model": "model.xml", "python": "script.py", "javascript": "script.mjs"}
"""The broken file, by the place where the bug lives."""
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


def write_case(root: Path, slug: str, title: str, kind: str) -> Path:
    """Writes the folder of a new case, whole or not at all, and gives its place; `kind` is one of SOURCES.

    Raises:
        CaseError: If the slug or the title will not do.
    """
    place = root / "cases" / slug
    if not SLUG.fullmatch(slug) or len(slug) > MAX_SLUG:
        guess = "-".join(re.findall(r"[a-z0-9]+", slug.lower())).lstrip("0123456789-")[:MAX_SLUG]
        repair = f"write {guess}" if guess else "name the symptom: box-falls-through-floor"
        expected = f"lower-case words joined by hyphens, {MAX_SLUG} characters at most"
        raise CaseError([Problem(f"cases/{slug}", 1, "", f"the slug {slug}", expected, repair)])
    if place.exists():
        expected = "a slug of its own"
        raise CaseError([Problem(f"cases/{slug}", 1, "", "a folder that is there", expected, "take another name")])
    work = root / ".cache"  # beside `cases`, which a running `make serve` watches
    work.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="new-", dir=work) as made:
        folder = Path(made, slug)
        folder.mkdir()
        for name, text in case_texts(slug, title, kind, free_number(root)).items():
            (folder / name).write_text(text, encoding="utf-8")
        load_case(folder)
        folder.rename(place)
    return place


def case_texts(slug: str, title: str, kind: str, number: int) -> dict[str, str]:
    """The files of a new case, by name."""
    sentence = " ".join(title.split()).removesuffix(".")
    quoted = yaml.safe_dump(sentence, allow_unicode=True, width=200).removesuffix("...\n").strip()
    source = SOURCES[kind]
    words = {"slug": slug, "title": quoted, "number": number, "modeline": MODELINE, "source": source, "kind": kind}
    return {name: TEMPLATES.get_template(name).render(words) for name in sorted({RECORD, "model.xml", source})}


def free_number(root: Path) -> int:
    """The smallest number that no case has, be the rest of its record as it may."""
    records = (path.read_text(encoding="utf-8") for path in (root / "cases").glob(f"*/{RECORD}"))
    taken = {int(number) for text in records for number in re.findall(r"^number: *(\d+)", text, re.MULTILINE)}
    return next(number for number in itertools.count(1) if number not in taken)
