"""Boxes in the place of meshes that are not there, and grey in that of pictures, so that the rest can be looked at."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator, Mapping

from clinic.diagnosis.edit import Edit, apply, delete, remove_attribute, replace, set_attribute
from clinic.diagnosis.engine import Compiled, CompileError, Engine
from clinic.diagnosis.source import Element, read_source

SIZE = 0.04  # m, the edge of a box: about a finger's or a small motor's
EDGES = (-SIZE / 2, SIZE / 2)
BOX = " ".join(f"{x} {y} {z}" for x in EDGES for y in EDGES for z in EDGES)
WRITTEN = {  # what an asset without its file has instead
    "mesh": {"vertex": BOX, "scale": "1 1 1"},
    "texture": {"builtin": "flat", "rgb1": "0.5 0.5 0.5", "width": "8", "height": "8"},
    "hfield": {"nrow": "2", "ncol": "2"},
}
ASSETS = (*WRITTEN, "skin")


class StandIns:
    """An engine that compiles models whose meshes and pictures are missing, or cannot be read.

    Attributes:
        absent: The names, without folders, of the files that something stands in for so far.
    """

    def __init__(self, engine: Engine) -> None:
        self.engine, self.version = engine, engine.version
        self.absent: set[str] = set()

    def compile(self, main: str, files: Mapping[str, str]) -> Compiled:
        """Compiles a model as `Engine.compile` does, once something stands in for each file that it complains of."""
        texts, source = {"": main, **files}, read_source({"": main, **files})
        elements = [each for each in source.root.walk() if _files(each)] if source else []
        while True:
            edits = [edit for each in elements if self.absent & _files(each) for edit in _filled(each)]
            try:
                filled = apply(texts, edits)
                return self.engine.compile(filled.pop(""), filled)
            except CompileError as error:
                quoted = {posixpath.basename(each) for each in re.findall(r"'([^']+)'", str(error))}
                new = quoted & {file for each in elements for file in _files(each)} - self.absent
                if not new:
                    raise
                self.absent |= new

    def told(self) -> str:
        """What is said of it to a reader."""
        others = len(self.absent) - 1
        more = f"So it is with {others} more. " if others else ""
        return f"{more}What follows was measured with a box of {1000 * SIZE:g} mm in the place of each such mesh."


def _naming(element: Element) -> list[str]:
    """The attributes of an asset that name files: `file`, `fileright`, or `filename` in URDF."""
    return [name for name in element.attributes if name.startswith("file")] if element.tag in ASSETS else []


def _files(element: Element) -> set[str]:
    """The names, without folders, of the files of an asset."""
    return {posixpath.basename(element.get(name)) for name in _naming(element)}


def _filled(element: Element) -> Iterator[Edit]:
    """What makes of an asset with files one without."""
    named = _naming(element)
    if element.tag == "skin":
        yield delete(element)
    elif "filename" in named:
        yield replace(element, f'<box size="{SIZE} {SIZE} {SIZE}"/>')
    else:
        yield from (remove_attribute(element, name) for name in (*named, "content_type", "gridsize", "gridlayout"))
        yield from (set_attribute(element, *each) for each in WRITTEN[element.tag].items())
        if not element.get("name"):
            yield set_attribute(element, "name", posixpath.splitext(posixpath.basename(element.get("file")))[0])
