"""What MuJoCo says against a text: the sentence, and the elements that it may mean."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.probes.compiled import COMPILES
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect

PLACE = re.compile(r"(?:Element|Object)(?: name =?)? ?'?([^',]*)'?(?:, id =? ?(-?\d+))?(?:, line =? ?(\d+))?")


def sentence(model: ReaderModel) -> str:
    """MuJoCo's first line, without `XML Error:`."""
    return re.sub(r"^(?:XML )?(?:Error: ?)+", "", model.error.strip().partition("\n")[0])


def meant(model: ReaderModel, *tags: str) -> list[Element]:
    """The elements that the message may mean, of these kinds where some are given: by line, else by name."""
    if model.source is None:
        return []
    found = PLACE.search(model.error.partition("\n")[2])
    every = [each for each in model.source.root.walk() if not tags or each.tag in tags]
    if not found:
        return []
    called, line = found.group(1), int(found.group(3) or -1)
    here = [each for each in every if each.line == line]
    exact = [each for each in here if called and called in (each.tag, each.get("name"))]
    named = [each for each in every if called and each.get("name") == called]
    return exact or here or named


def told(element: Element) -> str:
    """`<joint name="elbow">`; of an inertia, which has no name, whose it is: `<inertial> of body "hand"`."""
    if element.get("name"):
        return f'<{element.tag} name="{element.get("name")}">'
    around = element.parent
    while around is not None and not around.get("name"):
        around = around.parent
    owned = element.tag in ("inertial", "inertia", "mass", "sphere", "cylinder", "box") and around is not None
    return f"<{element.tag}>" + (f' of {around.tag} "{around.get("name")}"' if owned and around else "")


def mends(
    element: Element, edits: Iterable[Edit], says: str, *, attribute: str = "", now: str = "", value: str = ""
) -> Suspect:
    """A suspect whose edits make the text compile."""
    return Suspect((told(element),), attribute, now, value, tuple(edits), COMPILES, 0.0, says)


def nearest(word: str, known: Iterable[str]) -> list[str]:
    """The known words that are most like this one, at most three."""
    words = dict.fromkeys(each for each in known if each and each != word)
    alike = {each.lower(): each for each in words}
    if word.lower() in alike:
        return [alike[word.lower()]]
    return difflib.get_close_matches(word, words, 3, 0.6)
