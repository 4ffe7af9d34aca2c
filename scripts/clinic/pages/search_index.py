"""What the search reads: a document for every case, symptom, message and page, in scripts that run from a file too."""

from __future__ import annotations

import html
import json
import re
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path, PurePosixPath

import yaml

from clinic.pages.cases import FOLDER, CasePage
from clinic.pages.messages import Message
from clinic.record.families import Family, Weights, family_weights
from clinic.record.prose import FIELD
from clinic.work.cache import Files

FILE = "javascripts/search/index.js"
ANSWERS = "javascripts/search/answers.js"
SYNONYMS = Path(__file__).with_name("synonyms.toml")
NOUGHT = 80  # the letter that adds nothing; those 45 below and above it are printed too
HEAD = re.compile(r"\A---\n(.*?)^---\n", re.DOTALL | re.MULTILINE)
HEADING = re.compile(r"^#+ (.*?)(?: \{[^}]*\})?$", re.MULTILINE)

Document = dict[str, str]


def search_files(
    shown: Iterable[CasePage], families: Mapping[str, Family], messages: Iterable[Message], pages: Files
) -> Files:
    """The search's index, and apart from it the text of the answers, for who asks for them.

    Args:
        shown: The cases that have a page.
        families: The symptoms.
        messages: What MuJoCo says.
        pages: The other pages' Markdown by path; what is not Markdown is left out.
    """
    shown = list(shown)
    documents = [
        *(_case(one) for one in shown),
        *_families(families),
        *map(_message, messages),
        *_pages(pages),
    ]
    answers = {_answer_at(one.case.slug): _answer(one) for one in shown}
    index = {
        "documents": packed(documents),
        "synonyms": synonyms(),
        "families": {"families": [*families], **packed_weights(family_weights())},
    }
    return {FILE: _script("clinicIndex", index), ANSWERS: _script("clinicAnswers", answers)}


def packed(documents: Iterable[Document]) -> dict[str, object]:
    """By kind, what all addresses begin and end with, the names of the fields, and a row of each document.

    A row is the rest of the address, then the fields; docs/playground/search.js reads it.
    """
    kinds: dict[str, list[Document]] = {}
    for document in documents:
        kinds.setdefault(document["kind"], []).append(document)
    made: dict[str, object] = {}
    for kind, those in kinds.items():
        fields = [*dict.fromkeys(name for document in those for name in document if name not in ("kind", "at"))]
        before = _beginning([document["at"] for document in those])
        rests = [document["at"].removeprefix(before) for document in those]
        after = _beginning([rest[::-1] for rest in rests])[::-1]
        rows = [
            [rest.removesuffix(after), *(document.get(name, "") for name in fields)]
            for rest, document in zip(rests, those, strict=True)
        ]
        made[kind] = {"around": [before, after], "fields": fields, "rows": rows}
    return made


def packed_weights(weights: Weights) -> dict[str, object]:
    """The stems in one text, and by family a text with a letter for what each of them adds.

    docs/playground/search/families.js reads it.
    """
    columns = zip(*weights.stems.values(), strict=True)
    letters = ["".join(chr(NOUGHT + weight) for weight in column) for column in columns]
    return {"prior": weights.prior, "stems": " ".join(weights.stems), "adds": letters}


def _beginning(texts: list[str]) -> str:
    """What all texts begin with: as far as the first and the last in order are alike."""
    low, high = min(texts), max(texts)
    return low[: next((k for k, (a, b) in enumerate(zip(low, high, strict=False)) if a != b), len(low))]


def synonyms() -> list[list[str]]:
    """Groups of words and phrases that mean the same to who searches."""
    groups: list[list[str]] = tomllib.loads(SYNONYMS.read_text(encoding="utf-8"))["groups"]
    return groups


def _case(one: CasePage) -> Document:
    record = one.case.record
    words = "; ".join([*record.phrases, *record.tags])
    at, family = _answer_at(one.case.slug), record.family or ""
    return {"kind": "case", "at": at, "title": record.title, "words": words, "text": one.symptom, "family": family}


def _answer(one: CasePage) -> str:
    record = one.case.record
    return FIELD.sub("", " ".join([record.diagnosis, record.cause, record.fix, record.lesson]))


def _answer_at(slug: str) -> str:
    """Where a case tells its answer: who searches has a simulation to mend."""
    return f"{FOLDER.format(slug=slug)}/index.html#answer"


def _families(families: Mapping[str, Family]) -> Iterator[Document]:
    for name, family in families.items():
        yield {
            "kind": "symptom",
            "at": f"symptoms/{name}.html",
            "title": family.title,
            "words": "; ".join(family.words),
            "context": "; ".join(family.context),
            "text": "",
            "family": name,
        }


def _message(message: Message) -> Document:
    words = "\n".join([message.says or "", *message.older])
    title, text = (part.replace("`", "") for part in (message.title, message.meaning))
    made = {"kind": "message", "at": f"messages.html#{message.id}", "title": title, "words": words, "text": text}
    return made | ({"case": _answer_at(message.case)} if message.case else {})


def _pages(pages: Files) -> Iterator[Document]:
    """Each page by its title and description, found by its headings too."""
    for path, content in pages.items():
        if not path.endswith(".md") or path.startswith("symptoms/"):
            continue
        text = content.decode()
        head = HEAD.match(text)
        meta = yaml.load(head[1], yaml.CSafeLoader) if head else {}
        headings = HEADING.findall(text)
        title = meta.get("title") or next(iter(headings), path)
        kind = "rule" if path.startswith("rules/") and PurePosixPath(path).stem != "index" else "page"
        words = "" if kind == "rule" else "; ".join(headings[1:])
        at = path.removesuffix(".md") + ".html"
        text = html.unescape(meta.get("description", ""))
        yield {"kind": kind, "at": at, "title": title, "words": words, "text": text}


def _script(name: str, content: object) -> bytes:
    text = json.dumps(content, ensure_ascii=False, separators=(",", ":"))
    return f"globalThis.{name} = {text};\n".encode()
