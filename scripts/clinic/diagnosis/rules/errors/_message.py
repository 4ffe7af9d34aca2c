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
from clinic.engine.mjcf import newer_release

SECTIONS = {"sensor", "actuator", "tendon", "equality"}
SPOKEN = re.compile(r"([A-Za-z]+)_?(\d+)")
PLACE = re.compile(r"(?:Element|Object)(?: name =?)? ?'?([^',]*)'?(?:, id =? ?(-?\d+))?(?:, line =? ?(\d+))?")


def sentence(model: ReaderModel) -> str:
    """MuJoCo's first line, without `XML Error:`."""
    return re.sub(r"^(?:XML )?(?:Error: ?)+", "", model.error.strip().partition("\n")[0])


def meant(model: ReaderModel, *tags: str) -> list[Element]:
    """The elements that the message may mean, of these kinds where some are given: by line, else by name or number.

    What stands in an included file is at line 0.
    """
    places = list(PLACE.finditer(model.error.partition("\n")[2]))
    found = next((each for each in places[::-1] if each[1] or each[3]), next(iter(places), None))
    if model.source is None or not found:
        return []
    called, number, line = found.group(1), int(found.group(2) or -1), int(found.group(3) or -1)
    every = [each for each in model.source.root.walk() if not tags or each.tag in tags]
    kind = _of_kind(model, sentence(model))
    here = [each for each in every if each.line == line and each.file == model.source.main]
    if line == 0:
        here = [each for each in every if each.file != model.source.main and called in (each.tag, each.get("name"))]
    exact = [each for each in here if called and called in (each.tag, each.get("name"))]
    named = [each for each in every if called and each.get("name") == called]
    numbered = [] if called or tags else kind[number : number + 1] if number >= 0 else []
    if not exact and len(here) > 1 and called == "":
        here = [each for each in here if each in numbered] or here
    return exact or here or [each for each in named if each in kind] or named or numbered


def _of_kind(model: ReaderModel, said: str) -> list[Element]:
    """The elements of the kind that a sentence is about, in MuJoCo's order: `in sensor`, `in contact pair 0`."""
    assert model.source is not None
    words = re.findall(r"\bin (?:ball |contact )?(\w+)", said)[::-1] + re.findall(r"\b[a-z]+\b", said)
    for word in words:
        if word in SECTIONS or word == "constraint":
            return list(model.source.section("equality" if word == "constraint" else word))
        if word in ("geom", "joint", "site", "camera", "light") and not model.urdf:
            return model.source.of_bodies(word, *(("freejoint",) if word == "joint" else ()))
        if word in (
            "mesh",
            "texture",
            "material",
            "hfield",
            "pair",
            "exclude",
            "key",
            "frame",
            "numeric",
            "text",
            "tuple",
        ):
            return list(model.source.elements(word))
        if word == "flex":
            return list(model.source.elements("flexcomp", "flex"))
    return []


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


def newer(model: ReaderModel, element: Element) -> Suspect | None:
    """That a newer MuJoCo knows what this one does not: nothing is wrong with the model then."""
    said = newer_release(model.error, model.engine.version)
    says = f"{said} Leave it out to have the rest looked at with this one."
    return Suspect((told(element),), "", "", "", (), COMPILES, 0.0, says, level="hint", at=element) if said else None


def nearest(word: str, known: Iterable[str]) -> list[str]:
    """The known words that are most like this one, at most three."""
    words = dict.fromkeys(each for each in known if each and each != word)
    alike = {each.lower(): each for each in words}
    if word.lower() in alike:
        return [alike[word.lower()]]
    return difflib.get_close_matches(word, words, 3, 0.6) or _abbreviated(word, words)


def _abbreviated(word: str, known: Iterable[str]) -> list[str]:
    """The known word that this one abbreviates, or is abbreviated by, where it is one: j3 is joint3."""
    parts = SPOKEN.fullmatch(word)
    found = [(each, other) for each in known if (other := SPOKEN.fullmatch(each))]
    alike = [each for each, other in found if parts and other[2] == parts[2] and 1 in (len(other[1]), len(parts[1]))
             and other[1][0].lower() == parts[1][0].lower()]  # fmt: skip
    return alike if len(alike) == 1 else []


def folder_of(model: ReaderModel, element: Element) -> str:
    """Where files of this kind are looked for."""
    assert model.source is not None
    name = {"mesh": "meshdir", "texture": "texturedir"}.get(element.tag, "assetdir")
    written = {key: value for each in model.source.elements("compiler") for key, value in each.attributes.items()}
    return "" if element.tag == "include" else written.get(name, written.get("assetdir", ""))
