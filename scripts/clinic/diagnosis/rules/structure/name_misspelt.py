"""A name has a word that is spelt like no other, and nearly like that of all its siblings.

Code and controllers find joints and bodies by their names. One letter that is missing in one of twenty names is an
error far away from the model: a joint that is not found, or is left out without a word.

Bad:

    <mujoco>
      <worldbody>
        <body name="index_link1" pos="0 0 1">
          <joint name="index_joint1" axis="0 1 0"/>
          <geom size="0.01"/>
          <body name="index_link2" pos="0 0 0.03">
            <joint name="index_join2" axis="0 1 0"/>
            <geom size="0.01"/>
          </body>
        </body>
        <body name="middle_link1" pos="0 0.05 1">
          <joint name="middle_joint1" axis="0 1 0"/>
          <geom size="0.01"/>
          <body name="middle_link2" pos="0 0 0.03">
            <joint name="middle_joint2" axis="0 1 0"/>
            <geom size="0.01"/>
          </body>
        </body>
        <body name="thumb_link1" pos="0 -0.05 1">
          <joint name="thumb_joint1" axis="0 1 0"/>
          <geom size="0.01"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -         <joint name="index_join2" axis="0 1 0"/>
    +         <joint name="index_joint2" axis="0 1 0"/>

The number: names with a word that differs by one letter, or by two neighbours exchanged, from a word of five letters
and more that stands in four and more of the names of its kind. It stands in no other name of the model, and begins with
the same letter. A plural is not told, nor is a word that is known, such as `waist` beside wrists.

When it is wrong: two words that happen to be so alike, or a name that your own code knows as it is.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator

from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "A name that is misspelt"
FAMILIES = ("wrong-numbers", "stuck")
UNPLANTED = "what a name is to be, only its siblings tell"

KINDS = ("body", "joint", "actuator", "sensor", "site")
LETTERS, OFTEN = 5, 4
OWN = {  # words that are alike, and right
       "waist", "wrist", "angle", "ankle", "plane", "plate", "black", "block", "track", "truck", "trunk", "spring",
       "string", "crank", "crane", "shelf", "shell", "shaft", "shift", "slider", "spider"}  # fmt: skip
WORD = re.compile(r"[a-z]+|[A-Z]+(?![a-z])|[A-Z][a-z]+")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Names with a word that is one letter off another that many of their kind have."""
    of = model.simulation
    everywhere = Counter(word for kind in KINDS for name in of.names(kind) for word in set(_words(name)))
    for kind in KINDS:
        common = Counter(word for name in of.names(kind) for word in set(_words(name)))
        for index, name in enumerate(of.names(kind)):
            for word in _words(name):
                meant = [other for other in common if common[other] >= OFTEN and _nearly(word, other)]
                if everywhere[word] > 1 or word in OWN or not meant:
                    continue
                says = f"{word} stands in this name alone, and {meant[0]} in {common[meant[0]]} others."
                value = _corrected(name, word, meant[0])
                probe = counted("names with a word that is nearly another", 1)
                at = model.element(kind, index)
                yield Suspect((of.name(kind, index),), "name", name, value, (), probe, 0, says, value, at=at)


def _corrected(name: str, word: str, meant: str) -> str:
    """A name with another word, which begins with a capital letter where the one did."""
    for wrong, right in ((word, meant), (word.capitalize(), meant.capitalize()), (word.upper(), meant.upper())):
        name = re.sub(rf"{wrong}(?![a-z])", right, name)
    return name


def _words(name: str) -> list[str]:
    return [word.lower() for word in WORD.findall(name)]


def _nearly(word: str, other: str) -> bool:
    """Whether one letter of another word is missing, is one too many, is another one, or two are swapped."""
    short, long = sorted((word, other), key=len)
    if word == other or word[:1] != other[:1] or len(other) < LETTERS or len(word) < LETTERS - 1 or long == f"{short}s":
        return False
    if len(short) == len(long):
        unlike = [at for at in range(len(short)) if short[at] != long[at]]
        swapped = len(unlike) == 2 and unlike[1] == unlike[0] + 1 and sorted(short) == sorted(long)
        return len(unlike) == 1 or swapped
    return any(long[:at] + long[at + 1 :] == short for at in range(len(long)))
