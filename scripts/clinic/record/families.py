"""The families of symptoms, from `families.toml` and `sayings.yaml`, and which of them a reader's words speak of."""

from __future__ import annotations

import math
import re
import tomllib
from collections import Counter
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import yaml

FOLDER = Path(__file__).parent
SUFFIX = re.compile(r"(?<=[a-z]{3})(?:ations?|ings?|ies|ed|es|s|ly|e|y)$")
DOUBLE = re.compile(r"([bdfglmnprtz])\1$")
STOP = re.compile(r"[.;!?](?:\s|$)")
NOT = {"no", "never", "cannot", "without", "unable", "fail", "nothing", "nobody", "barely"}
LEAST = 0.2  # the likelihood from which on a family is named
OFTEN = 4  # how often a stem stands somewhere, to be known
RIDGE = 1.0  # what keeps weights small
LITTLE, MOST = 2, 45  # weights up to the one are left out, beyond the other cut off
SHARP = 12.0  # how much a score tells: with it, sayings that are left out find their family likeliest
UNIT = 40.0  # weights are whole numbers, of fortieths
NO_MEANING = """a an and are as at be been but by can did do does doing done for from had has have i if in is it its
me my of on or so that the their them there they this to was we were when while with you your mujoco simulation"""
IDLE = frozenset(NO_MEANING.split())


class Weights(NamedTuple):
    """What a text's stems say of its family: all by family, in the order of `families()`, in fortieths.

    Attributes:
        prior: What is said without a word.
        stems: What each stem adds.
    """

    prior: list[int]
    stems: dict[str, list[int]]


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
    probe: str = ""


@cache
def families() -> dict[str, Family]:
    """All families by name, in the order of the file."""
    read: dict[str, dict[str, Any]] = tomllib.loads((FOLDER / "families.toml").read_text(encoding="utf-8"))
    listed = ("words", "further", "context")
    return {name: Family(**each | {key: tuple(each[key]) for key in listed}) for name, each in read.items()}


def likely_families(text: str) -> list[str]:
    """The names of the families of which the text may well speak, likeliest first."""
    return [name for name, share in family_shares(text).items() if share >= LEAST]


def family_shares(text: str, weights: Weights | None = None) -> dict[str, float]:
    """How likely the text speaks of each family, likeliest first; they sum to 1. Empty if it has no word of any."""
    weights = weights or family_weights()
    said = [weights.stems[stem] for stem in sorted({*_stems(text)}) if stem in weights.stems]
    if not said:
        return {}
    sums = [sum(each) / math.sqrt(len(said)) for each in zip(*said, strict=True)]
    scores = [SHARP / UNIT * (prior + each) for prior, each in zip(weights.prior, sums, strict=True)]
    odds = [math.exp(score - max(scores)) for score in scores]
    shares = {name: each / sum(odds) for name, each in zip(families(), odds, strict=True)}
    return {name: shares[name] for name in sorted(shares, key=lambda name: -round(shares[name], 9))}


@cache
def family_weights() -> Weights:
    """The weights that all titles, words and sayings of the families give."""
    return weights_of(
        (name, phrase)
        for name, family in families().items()
        for phrase in (family.title, name, *family.words, *family.further, *sayings()[name])
    )


def weights_of(phrases: Iterable[tuple[str, str]]) -> Weights:
    """The weights that tell phrases of the families apart, given with the name of theirs.

    A phrase is a vector of length 1 with as much of each of its stems. The weights are those of least squares towards
    1 for its family and 0 for the others: Rifkin, Yeo and Poggio, *Regularized Least-Squares Classification*, 2003.
    """
    import numpy as np

    known = [(name, {*_stems(phrase)}) for name, phrase in phrases]
    often = Counter(stem for _, stems in known for stem in stems)
    column = {stem: place for place, stem in enumerate(sorted(stem for stem in often if often[stem] >= OFTEN))}
    place = {name: number for number, name in enumerate(families())}
    prior = np.bincount([place[name] for name, _ in known], minlength=len(place)) / len(known)
    together, wanted = RIDGE * np.eye(len(column)), np.zeros((len(column), len(place)))
    for name, stems in known:
        said = [column[stem] for stem in stems if stem in column]
        together[np.ix_(said, said)] += 1 / max(1, len(said))
        wanted[said] -= prior / math.sqrt(max(1, len(said)))
        wanted[said, place[name]] += 1 / math.sqrt(max(1, len(said)))
    solved = np.linalg.solve(together, wanted)
    rounded = np.clip(np.rint(UNIT * solved), -MOST, MOST).astype(int)
    rounded[abs(rounded) <= LITTLE] = 0
    return Weights(np.rint(UNIT * prior).astype(int).tolist(), dict(zip(column, rounded.tolist(), strict=True)))


@cache
def sayings() -> dict[str, list[str]]:
    """What people wrote when they asked, by the family that it speaks of."""
    read: dict[str, list[str]] = yaml.load((FOLDER / "sayings.yaml").read_text(encoding="utf-8"), yaml.CSafeLoader)
    return read


def _stems(text: str) -> list[str]:
    """The words of a text without endings, in order; idle ones are left out, and `not` stands for every no.

    What is denied follows as a pair: `not_mov`.
    """
    said, denied = [], []
    for clause in STOP.split(re.sub(r"n['\u2019]t\b", " not", text.lower())):
        words = (word for word in re.findall(r"[a-z0-9_]+", clause) if word not in IDLE)
        stems = [DOUBLE.sub(r"\1", SUFFIX.sub("", word)) for word in words]
        stems = ["not" if stem in NOT else stem for stem in stems]
        said += stems
        denied += [f"not_{stem}" for gap in (1, 2) for no, stem in zip(stems, stems[gap:], strict=False) if no == "not"]
    return said + denied
