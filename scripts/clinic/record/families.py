"""The families of symptoms, from `families.toml` and `sayings.yaml`, and which of them a reader's words speak of."""

from __future__ import annotations

import math
import re
import tomllib
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import NamedTuple

import yaml

FOLDER = Path(__file__).parent
SUFFIX = re.compile(r"(?<=[a-z]{3})(?:ations?|ings?|ies|ed|es|s|ly|e|y)$")
DOUBLE = re.compile(r"([bdfglmnprtz])\1$")
STOP = re.compile(r"[.;!?](?:\s|$)")
NOT = {"no", "never", "cannot", "without", "unable", "fail", "nothing", "nobody", "barely"}
LEAST = 0.2  # the likelihood from which on a family is named
OFTEN = 4  # how often a stem stands somewhere, to be known
BESIDE = 0.4  # what a word counts that stands beside the symptom
SMOOTH = 0.3  # what is added to every count of a stem
VAGUE = 0.7  # how much less a stem counts that all families share alike
IDLE = """a an and are as at be been but by can did do does doing done for from had has have i if in is it its me my of
on or so that the their them there they this to was we were when while with you your mujoco simulation"""

StemCounts = dict[str, dict[str, float]]
"""How often each stem stands in what is said of each family."""


class Family(NamedTuple):
    """A symptom.

    Attributes:
        title: What is seen.
        first: What to measure first, as Markdown.
        words: What people call it.
        further: What they call it too; the page is not searched for these.
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
    read = tomllib.loads((FOLDER / "families.toml").read_text(encoding="utf-8"))
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
    """The names of the families of which the text may well speak, likeliest first."""
    return [name for name, share in family_shares(text).items() if share >= LEAST]


def family_shares(text: str, counts: StemCounts | None = None) -> dict[str, float]:
    """How likely the text speaks of each family, likeliest first; they sum to 1. Empty if it has no word of any.

    Each stem that people use for a symptom counts by the odds that it is of this family and of no other one: the
    complement naive Bayes of Rennie et al., *Tackling the Poor Assumptions of Naive Bayes Text Classifiers*, 2003. It
    counts the less, the more evenly families share it: by its entropy, as in the log-entropy weights of Dumais,
    *Improving the Retrieval of Information from External Sources*, 1991.
    """
    own = totals(counts) if counts else _own_totals()
    counts = counts or stem_counts()
    said = sorted({stem for stem in _stems(text) if stem in counts})
    if not said:
        return {}
    everything, smooth = sum(own.values()), SMOOTH * len(counts)
    odds = dict.fromkeys(own, 0.0)
    for users in (counts[stem] for stem in said):
        users_of_all = sum(users.values())
        shares = [count / users_of_all for count in users.values() if count]
        entropy = -sum(share * math.log(share, len(own)) for share in shares)
        for name, total in own.items():
            inside = (SMOOTH + users.get(name, 0)) / (total + smooth)
            outside = (SMOOTH + users_of_all - users.get(name, 0)) / (everything - total + smooth)
            odds[name] += (1 - VAGUE * entropy) * math.log(inside / outside)
    weights = {name: math.exp(value - max(odds.values())) for name, value in odds.items()}
    sum_of_all = sum(weights.values())
    return {name: weights[name] / sum_of_all for name in sorted(weights, key=lambda name: -round(odds[name], 9))}


def totals(counts: StemCounts) -> dict[str, float]:
    """How many stems are counted for each family."""
    return {name: sum(users.get(name, 0) for users in counts.values()) for name in families()}


@cache
def _own_totals() -> dict[str, float]:
    return totals(stem_counts())


@cache
def stem_counts() -> StemCounts:
    """How often each stem stands in what people say of each family; what stands beside a symptom counts BESIDE."""
    counts: StemCounts = {}
    for name, family in families().items():
        count_stems(counts, name, (family.title, name, *family.words, *family.further, *sayings()[name]))
        count_stems(counts, name, family.context, BESIDE)
    return {stem: users for stem, users in counts.items() if sum(users.values()) >= OFTEN}


def count_stems(counts: StemCounts, family: str, phrases: Iterable[str], weight: float = 1.0) -> None:
    """Adds to the counts the stems of a family's phrases, each stem once a phrase."""
    for stem in (stem for phrase in phrases for stem in sorted(set(_stems(phrase)))):
        users = counts.setdefault(stem, {})
        users[family] = round(users.get(family, 0.0) + weight, 1)


@cache
def sayings() -> dict[str, list[str]]:
    """What people wrote when they asked, by the family that it speaks of."""
    read: dict[str, list[str]] = yaml.safe_load((FOLDER / "sayings.yaml").read_text(encoding="utf-8"))
    return read


def _stems(text: str) -> list[str]:
    """The words of a text without endings, in order; idle ones are left out, and `not` stands for every no.

    What is denied follows as a pair: `not mov`.
    """
    said, denied = [], []
    for clause in STOP.split(re.sub(r"n['\u2019]t\b", " not", text.lower())):
        words = (word for word in re.findall(r"[a-z0-9_]+", clause) if word not in IDLE.split())
        stems = [DOUBLE.sub(r"\1", SUFFIX.sub("", word)) for word in words]
        stems = ["not" if stem in NOT else stem for stem in stems]
        said += stems
        denied += [f"not {stem}" for gap in (1, 2) for no, stem in zip(stems, stems[gap:], strict=False) if no == "not"]
    return said + denied
