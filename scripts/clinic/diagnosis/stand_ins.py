"""Boxes in the place of meshes that are not there, and grey in that of pictures, so that the rest can be looked at."""

from __future__ import annotations

import os
import posixpath
import re
from collections.abc import Collection, Iterator, Mapping
from itertools import product

from clinic.diagnosis.edit import Edit, apply, delete, remove_attribute, replace, set_attribute
from clinic.diagnosis.engine import Compiled, CompileError, Engine
from clinic.diagnosis.source import Element, asset_name, read_source

SIZE = 0.04  # m, the edge of a box: about a finger's or a small motor's
FLAT = {"builtin": "flat", "rgb1": "0.5 0.5 0.5", "width": "8", "height": "8"}
ASSETS = ("mesh", "texture", "hfield", "skin")


class StandIns:
    """An engine that compiles models whose meshes and pictures are missing, or cannot be read.

    Args:
        engine: What compiles the texts.
        size: The edge of the boxes, in m.
        absent: The files, as they are written, that something stands in for from the beginning.

    Attributes:
        absent: The same, with those that the engine complained of, and what is beside them and not there.
        shapes: Whether one of them is a mesh or a height field.
    """

    def __init__(self, engine: Engine, size: float = SIZE, absent: Collection[str] = ()) -> None:
        self.engine, self.version, self.size, self.shapes = engine, engine.version, size, False
        self.absent = set(absent)

    def compile(self, main: str, files: Mapping[str, str]) -> Compiled:
        """Compiles a model as `Engine.compile` does, once something stands in for each file that it complains of."""
        texts, source = {"": main, **files}, read_source({"": main, **files})
        elements = [each for each in source.root.walk() if named_files(each)] if source else []
        while True:
            filled = [each for each in elements if self.absent.intersection(named_files(each).values())]
            self.shapes = any(each.tag in ("mesh", "hfield") for each in filled)
            try:
                made = apply(texts, [edit for each in filled for edit in self._edits(each)])
                return self.engine.compile(made.pop(""), made)
            except CompileError as error:
                new = self._missing(str(error), {file for each in elements for file in named_files(each).values()})
                if not new - self.absent:
                    raise
                self.absent |= new

    def told(self) -> str:
        """What is said of it to a reader."""
        if not self.shapes:
            return "What else is told was measured with grey in its place."
        box = f"a box of {1000 * self.size:g} mm in the place of each mesh"
        return f"What else is told was measured with {box}; rules about contacts, masses and shapes were not tried."

    def _missing(self, error: str, files: Collection[str]) -> set[str]:
        """The files that an error speaks of, and those of the same folder that are not there either."""
        new = set[str]()
        for path in re.findall(r"'([^']+)'", error):
            for file in meant_by(path, files):
                new.add(file)
                if path.endswith(bare(file)):
                    folder = path.removesuffix(bare(file))
                    new |= {each for each in files if not self._there(folder + bare(each))}
        return new

    def _there(self, path: str) -> bool:
        given = getattr(self.engine, "assets", {})
        return path in given or posixpath.basename(path) in given or os.path.exists(path)

    def _edits(self, element: Element) -> Iterator[Edit]:
        """What makes of an asset with files one without."""
        named = named_files(element)
        if element.tag == "skin":
            yield delete(element)
        elif "filename" in named:
            yield replace(element, f'<box size="{self.size} {self.size} {self.size}"/>')
        else:
            corners = product((-self.size / 2, self.size / 2), repeat=3)
            box = {"vertex": " ".join(f"{each:g}" for corner in corners for each in corner), "scale": "1 1 1"}
            written = {"mesh": box, "texture": FLAT, "hfield": {"nrow": "2", "ncol": "2"}}[element.tag]
            yield from (remove_attribute(element, name) for name in (*named, "content_type", "gridsize", "gridlayout"))
            yield from (set_attribute(element, *each) for each in written.items())
            if not element.get("name"):
                yield set_attribute(element, "name", asset_name(element))


def named_files(element: Element) -> dict[str, str]:
    """The files of an asset by the attributes that name them: `file`, `fileright`, or `filename` in URDF."""
    named = {name: value for name, value in element.attributes.items() if name.startswith("file")}
    return named if element.tag in ASSETS else {}


def meant_by(path: str, files: Collection[str]) -> list[str]:
    """Those of some files, as they are written, that a path is of; by the name alone where no folder fits."""
    whole = [each for each in files if bare(each) and f"/{path}".endswith(f"/{bare(each)}")]
    return whole or [each for each in files if posixpath.basename(each) == posixpath.basename(path)]


def bare(file: str) -> str:
    """A file's path without what is resolved before it is looked for: `package://`, `./`, `../`."""
    return re.sub(r"^(?:\w+://|\.{1,2}/)+", "", file)
