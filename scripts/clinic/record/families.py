"""The families of symptoms, from `families.toml`, and which of them a reader's words speak of."""

from __future__ import annotations

import math
import re
import tomllib
from collections import Counter
from functools import cache
from pathlib import Path
from typing import NamedTuple

SUFFIX = re.compile(r"(?<=[a-z]{3})(?:ations?|ings?|ies|ed|es|s|ly|e|y)$")
DOUBLE = re.compile(r"([bdfglmnprtz])\1$")
NOT = {"no", "never", "cannot", "without", "unable", "fail", "nothing", "nobody", "barely"}
PART = 0.5  # what the nearest phrase counts that the text has in part
BESIDE = 0.4  # what a word counts that stands beside the symptom
IDLE = """a an and are as at be been but by can did do does doing done for from had has have i if in is it its me my of
on or so that the their them there they this to was we were when while with you your mujoco simulation"""


class Family(NamedTuple):
    """A symptom.

    Attributes:
        title: What is seen.
        first: What to measure first, as Markdown.
        words: What people call it.
        further: What they call it too, by which the search finds no page.
        context: What they name beside it, which other symptoms have too.
        probe: Python lines that measure a model at its start, or in a short run, for the expressions of its cases; they
            have `model`, `data` after `mj_forward`, `mujoco` and `np`.
    """

    title: str
    first: str
    words: tuple[str, ...]
    further: tuple[str, ...]
    context: tuple[str, ...]
    probe: str


@cache
def families() -> dict[str, Family]:
    """All families by name, in the order of the file."""
    read = tomllib.loads((Path(__file__).parent / "families.toml").read_text(encoding="utf-8"))
    return {
        name: Family(
            each["title"],
            each["first"],
            tuple(each["words"]),
            tuple(each["further"]),
            tuple(each.get("context", ())),
            each.get("probe", ""),
        )
        for name, each in read.items()
    }


def likely_families(text: str) -> list[str]:
    """The names of the families that the text speaks of, likeliest first.

    A phrase of a family counts when the text has all its words, each word once, and more where fewer families have it.
    """
    called, beside, rarity = _vocabulary()
    said = set(_stems(text))
    scores = {}
    for name in called:
        whole = set().union(*(phrase for phrase in called[name] if phrase <= said))
        near = set().union(*(phrase for phrase in beside[name] if phrase <= said)) - whole
        part = max(len(phrase & said) / len(phrase) for phrase in called[name])
        score = sum(rarity[stem] for stem in whole) + BESIDE * sum(rarity[stem] for stem in near) + part * PART
        scores[name] = round(score, 9)  # equal ones stay equal, in whatever order they are summed
    return sorted((name for name in scores if scores[name] > PART / 2), key=lambda name: -scores[name])


@cache
def _vocabulary() -> tuple[dict[str, list[set[str]]], dict[str, list[set[str]]], dict[str, float]]:
    """The stems of the phrases of every family, those beside it, and how telling each stem is."""
    called = {name: _phrases(name, *family.words, *family.further) for name, family in families().items()}
    beside = {name: _phrases(*family.context) for name, family in families().items()}
    count = Counter(stem for name in called for stem in set().union(*called[name], *beside[name]))
    return called, beside, {stem: math.log(1 + len(called) / users) for stem, users in count.items()}


def _phrases(*phrases: str) -> list[set[str]]:
    return [stems for phrase in phrases if (stems := set(_stems(phrase)))]


def _stems(text: str) -> list[str]:
    """The words of a text without endings, in order; idle ones are left out, and `not` stands for every no."""
    words = re.findall(r"[a-z0-9_]+", re.sub(r"n['\u2019]t\b", " not", text.lower()))
    stems = (DOUBLE.sub(r"\1", SUFFIX.sub("", word)) for word in words if word not in IDLE.split())
    return ["not" if stem in NOT else stem for stem in stems]
