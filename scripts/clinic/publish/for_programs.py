"""What the site has for programs: `llms.txt`, which names every page, and a feed of the cases."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from html import escape, unescape
from typing import NamedTuple

import yaml

from clinic.pages.search_index import HEAD, HEADING
from clinic.pages.text.addresses import site
from clinic.record.case import Case
from clinic.work.cache import Files

LLMS, FEED = "llms.txt", "feed.xml"
SAYS = """# MuJoCo Debugging Clinic

> Broken MuJoCo simulations, each with its symptom, diagnosis, cause, repair, and the remedies that do not help. Every
> number was measured while the site was built, by running the broken and the repaired model.

Every page lies as Markdown beside the HTML: `index.md` beside `index.html`. A case's `evidence.json` holds all that was
measured, its `case.yaml` the record, its `claims.yaml` what shows each sentence.
`rules.json` lists the rules of `clinic diagnose`.
"""
SECTIONS = {
    "Start here": ("index", "symptoms", "messages", "triage", "rules/index", "programs", "words", "about"),
    "Symptoms": ("symptoms/",),
    "Cases": ("cases/",),
    "Rules of clinic diagnose": ("rules/",),
}
REST = "More"


class Line(NamedTuple):
    """A page: its path, title and description, as text."""

    path: str
    title: str
    description: str


def lines(files: Files) -> list[Line]:
    """Every page among the files."""
    made = []
    for path, content in sorted(files.items()):
        if path.endswith(".md"):
            text = content.decode()
            head = HEAD.match(text)
            meta = yaml.load(head[1], yaml.CSafeLoader) if head else {}
            title = meta.get("title") or next(iter(HEADING.findall(text)), path)
            made.append(Line(path, unescape(title), unescape(meta.get("description") or "")))
    return made


def llms_text(pages: Iterable[Line]) -> str:
    """A list of all pages in Markdown, by sections; with absolute addresses where the site's own is known."""
    left = {page.path.removesuffix(".md"): page for page in pages}
    parts = [SAYS]
    for heading, begins in {**SECTIONS, REST: ("",)}.items():
        names = [
            name
            for begin in begins
            for name in list(left)
            if name == begin or (begin[-1:] in ("/", "") and name.startswith(begin))
        ]
        rows = [_row(left.pop(name)) for name in names]
        if rows:
            parts.append("\n".join([f"## {heading}\n", *rows, ""]))
    return "\n".join(parts)


def feed(pages: Iterable[Line], cases: Mapping[str, Case]) -> str | None:
    """The cases as RSS, the newest, which has the highest number, first; None where the site's address is not known."""
    if not (base := site()):
        return None
    by_path = {page.path: page for page in pages}
    own = [(case, by_path.get(f"cases/{slug}/index.md")) for slug, case in cases.items() if case.record.number]
    items = [
        f"<item><title>{escape(page.title)}</title><link>{base}cases/{case.slug}/index.html</link>"
        f"<guid>{base}cases/{case.slug}/index.html</guid><description>{escape(page.description)}</description></item>"
        for case, page in sorted(own, key=lambda each: -(each[0].record.number or 0))
        if page is not None
    ]
    head = (
        f"<title>MuJoCo Debugging Clinic</title><link>{base}</link>"
        "<description>New cases: broken MuJoCo simulations with their cause and repair, measured</description>"
    )
    return "\n".join(
        ['<?xml version="1.0" encoding="UTF-8"?>', '<rss version="2.0"><channel>', head, *items, "</channel></rss>", ""]
    )


def _row(page: Line) -> str:
    description = f": {' '.join(page.description.split())}" if page.description else ""
    return f"- [{page.title}]({site()}{page.path}){description}"
