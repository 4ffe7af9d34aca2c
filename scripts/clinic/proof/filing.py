"""Where a case is filed: its tags, family and phrases are words of its own, and what it names as related is."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from clinic.record.case import Case
from clinic.record.families import family_shares
from clinic.record.problem import Problem, listed

LIKELY = 4  # families of which a phrase may speak
SPOKEN = 0.1  # how likely a title or phrase speaks of its case's family
COMMON = "mujoco the a an of in on to is and or not no with for from after before when how which without by at it its"
TOPICS = {"orientation": ("axis", "quat", "euler"), "units": ("radian", "degree")}
"""Other words of the record that a tag stands for; the section of a model that bears its name is one always."""


def filing_problems(known: Mapping[str, Case]) -> Iterator[Problem]:
    """Tags, families and phrases that are not a case's own, and relatives that have nothing in common with it."""
    said = {slug: _stems(" ".join([_opening(case), *_bodies(case)])) for slug, case in known.items()}
    heads = {slug: _stems(_opening(case)) for slug, case in known.items()}
    for slug, case in known.items():
        yield from _unsaid(case, said[slug])
        for index, phrase in enumerate(case.record.phrases):
            wanted = _stems(phrase)
            others = {key: heads[key] for key, other in known.items() if phrase not in other.record.phrases}
            own = _stems(" ".join([case.record.title, *_but(case, index), *_bodies(case)]))
            nearer = [other for other, words in others.items() if wanted <= words and not wanted <= own]
            if nearer and "not" not in phrase.split() and case.record.family not in [*family_shares(phrase)][:LIKELY]:
                lacking = listed(sorted(wanted - own))
                expected = f"words of this case, which nowhere has: {lacking}"
                found = f"{phrase}: {listed(nearer)} has all of its words"
                yield case.problem(("phrases", index), found, expected, "move it there, or correct it")
        for index, other in enumerate(case.record.see):
            if other in known and not _related(case, known[other]):
                expected = "a case that shares a tag or a family, or names this one"
                yield case.problem(("see", index), other, expected, "remove it, or name what they have in common")


def _unsaid(case: Case, said: set[str]) -> Iterator[Problem]:
    """Tags, and a family of a case that has its claims, of which the record's own words say nothing."""
    for index, tag in enumerate(case.record.tags):
        if tag == "code" and case.record.run is not None:
            expected = "a case with a script"
            yield case.problem(("tags", index), tag, expected, "remove the tag")
        elif tag != "code" and not (_stems(tag.replace("-", " ")) <= said or _topic(case, tag, said)):
            expected = "a topic that the title, the phrases, the prose or an edit names"
            yield case.problem(("tags", index), f"{tag}, of which the case does not speak", expected, "correct the tag")
    family = case.record.family
    told = [family_shares(text) for text in (case.record.title, *case.record.phrases)]
    likely = dict.fromkeys(name for shares in told for name, share in shares.items() if share >= SPOKEN)
    if family is not None and case.claims is not None and family not in likely:
        expected = f"what the title and the phrases speak of, as {listed([*likely])}"
        yield case.problem(("family",), family, expected, "correct it, or add how readers say it")


def _topic(case: Case, tag: str, said: set[str]) -> bool:
    words = {stem for word in TOPICS.get(tag, ()) for stem in _stems(word)}
    return bool(words & said) or any(f"<{tag}>" in text for text in case.texts.values())


def _related(case: Case, other: Case) -> bool:
    here, there = case.record, other.record
    shared = {*here.tags} & {*there.tags}
    return bool(shared) or here.family == there.family is not None or case.slug in there.see


def _opening(case: Case) -> str:
    return " ".join([case.record.title, case.record.symptom, *case.record.phrases])


def _but(case: Case, index: int) -> list[str]:
    return [phrase for place, phrase in enumerate(case.record.phrases) if place != index]


def _bodies(case: Case) -> list[str]:
    record = case.record
    edits = [edit.replace for remedy in (*record.fixes, *record.refuted) for edit in remedy.edits]
    titles = [remedy.title for remedy in (*record.fixes, *record.refuted)]
    prose = [record.symptom, record.diagnosis, record.cause, record.fix, record.lesson]
    return [*prose, *titles, *(remedy.why for remedy in record.refuted), *edits]


def _stems(text: str) -> set[str]:
    """The words of a text by their beginnings, so that forms of one word are one."""
    words = re.findall(r"[a-z]+", text.lower())
    return {word[:5] if len(word) > 6 else word.removesuffix("s")[:5] for word in words if word not in COMMON.split()}
