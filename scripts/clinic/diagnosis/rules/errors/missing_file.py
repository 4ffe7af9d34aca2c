"""A file that the model names is not where it says.

`Error opening file` names what was looked for. The folder is put together from `meshdir` (or `texturedir`, `assetdir`)
and `file`, from the folder of the main model on. Upper and lower case, an ending, a folder too much or too few, and
`package://` addresses of a URDF are the usual mistakes.

Bad:

    <mujoco>
      <asset>
        <texture name="wood" type="2d" file="textures/wood.png"/>
      </asset>
      <worldbody>
        <geom name="box" type="box" size="0.1 0.1 0.1"/>
      </worldbody>
    </mujoco>

Good:

    -     <texture name="wood" type="2d" file="textures/wood.png"/>
    +     <texture name="wood" type="2d" builtin="flat" width="8" height="8" rgb1="0.5 0.3 0.1"/>

The number: none; a file of that name is looked for below the model's folder and the one around it, then one with
nearly that name that nothing else uses. Where there is none, this is a hint that says which file is missing.

When it is wrong: several files may have the same name; the one with the most folders in common is taken. A name
that is nearly the same may be another file.
"""

from __future__ import annotations

import difflib
import os
import posixpath
import re
from collections.abc import Collection, Iterator, Sequence
from functools import cache

from clinic.diagnosis.edit import Edit, set_attribute
from clinic.diagnosis.probes.compiled import COMPILES
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._message import folder_of, mends, sentence, told
from clinic.diagnosis.source import Element
from clinic.diagnosis.stand_ins import meant_by
from clinic.diagnosis.suspect import Suspect

TITLE = "A file that is not there"
FAMILIES = ("will-not-compile",)

MESSAGE = re.compile(r".*(?:opening file|resource not found[^']*|file not found[^']*|could not open[^']*) ?'([^']+)'")
NEARLY = 0.7  # of the letters
MOST = 20_000  # files that are looked at
DEPTH = 4  # folders


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Every file of the model that is elsewhere below its folder; the first that is nowhere."""
    found = MESSAGE.match(sentence(model))
    if not found or model.source is None:
        return
    named = [each for each in model.source.root.walk() if any(name.startswith("file") for name in each.attributes)]
    base = posixpath.basename(found.group(1))
    written = {value: each for each in named for name, value in each.attributes.items() if name.startswith("file")}
    ill = [written[each] for each in meant_by(found.group(1), written)]
    if not ill:
        return
    if (folder := _folder_of_all(model, ill[0])) is not None:
        yield folder
        return
    edits = [edit for element in named for edit in _moved(model, element, _called(_file(element)))]
    first = ill[0]
    if not any(each.start == first.start for each in edits):
        nearly = _nearly_called(base, {posixpath.basename(_file(each)) for each in named})
        guessed = edits + [edit for element in ill for edit in _moved(model, element, nearly)]
        edits = guessed if nearly and model.measured(COMPILES, guessed) == 0 else edits
    if any(each.start == first.start for each in edits) or _directory(model) in {each.start for each in edits}:
        edits.sort(key=lambda each: each.start != first.start)
        says = f"{found.group(1)} is not there; {edits[0].value} is."
        edits = list(dict.fromkeys(edits))
        yield mends(first, edits, says, attribute=edits[0].attribute, now=_file(first), value=edits[0].value)
    else:
        says = f"{found.group(1)} is not there, and no file called {base} below the model's folder."
        yield Suspect((told(first),), "file", _file(first), "", (), COMPILES, 0.0, says, level="hint", at=first)


def _file(element: Element) -> str:
    return element.get("file") or element.get("filename")


def _directory(model: ReaderModel) -> int:
    assert model.source is not None
    compiler = model.source.root.first("compiler")
    return compiler.start if compiler else -1


def _folder_of_all(model: ReaderModel, element: Element) -> Suspect | None:
    """The `meshdir` under which the file is, where `strippath` leaves nothing of the folders that are written."""
    assert model.source is not None
    for compiler in model.source.elements("compiler"):
        there = _called(_file(element))
        if compiler.get("strippath") != "true" or not there:
            continue
        folder = posixpath.dirname(min(there, key=len)) or "."
        edits = (set_attribute(compiler, "meshdir", folder),)
        now = compiler.get("meshdir")
        if folder != now and (model.measured(COMPILES, edits) == 0 or not model.urdf):
            says = f"strippath drops the folders of {_file(element)}, and the meshes are in {folder!r}."
            return mends(compiler, edits, says, attribute="meshdir", now=now or "left out", value=folder)
    return None


def _moved(model: ReaderModel, element: Element, there: Sequence[str]) -> list[Edit]:
    """The edit that points at the likeliest of some paths; none where the element's own exists, or there is no path."""
    file, folder = _file(element), folder_of(model, element)
    if not there or os.path.exists(posixpath.join(folder, file)):
        return []
    parts = set(file.split("/"))
    best = max(there, key=lambda path: (len(parts & set(path.split("/"))), -len(path)))
    attribute = "file" if "file" in element.attributes else "filename"
    return [set_attribute(element, attribute, posixpath.relpath(best, folder or "."))]


def _called(file: str) -> list[str]:
    """The paths of the files of that name, or else of that name but for case."""
    base, files = posixpath.basename(file.replace("\\", "/")), _files(os.getcwd())
    return files.get(base) or [path for name in files if name.lower() == base.lower() for path in files[name]]


def _nearly_called(base: str, used: Collection[str]) -> list[str]:
    """The paths of the file of the same kind whose name is most like this one, of those that are not used."""
    stem, ending = posixpath.splitext(base)
    files = _files(os.getcwd())
    kin = {posixpath.splitext(name)[0]: name for name in files if name.endswith(ending) and name not in used}
    return [path for like in difflib.get_close_matches(stem, kin, 1, NEARLY) for path in files[kin[like]]]


@cache
def _files(around: str) -> dict[str, list[str]]:
    """The files below the current folder, `around`, and below the one around that, by their names."""
    made: dict[str, list[str]] = {}
    seen = 0
    for top in (".", ".."):
        for folder, inner, names in os.walk(top):
            inner[:] = [name for name in inner if not name.startswith(".")]
            if folder.count("/") > DEPTH:
                inner.clear()
            for name in names:
                made.setdefault(name, []).append(posixpath.normpath(posixpath.join(folder, name)))
            seen += len(names)
            if seen > MOST:
                return made
    return made
