"""The package's own files as this process found them, and which of them the work of a module hangs on."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterable
from functools import cached_property, lru_cache
from pathlib import Path, PurePosixPath

PACKAGE = Path(__file__).parent
SCRAP = re.compile(r"^\.|~$|\.pyc$")
IMPORT = re.compile(rf"^ *from {PACKAGE.name}(?:\.([\w.]+))? import (\([^)]*\)|.*)$", re.MULTILINE)
NAME = re.compile(r"\w+")
INIT = "__init__.py"


class Sources:
    """The files of a package, read when this is made.

    Attributes:
        contents: The files by their paths below the package.
    """

    def __init__(self, package: Path = PACKAGE) -> None:
        found = [path for path in package.rglob("*") if path.is_file() and not SCRAP.search(path.name)]
        self.contents = {path.relative_to(package).as_posix(): path.read_bytes() for path in sorted(found)}

    @cached_property
    def digest(self) -> str:
        """A digest of all files."""
        return self._digest(set(self.contents))

    @lru_cache  # noqa: B019 (there is one for a process)
    def behind(self, module: str, *alone: str) -> str:
        """A digest of a module and of all that it imports, wherever and however far, and of other files alone.

        Args:
            module: Without the package's name: `film`, `triage.table`.
            alone: Modules whose own text counts, and not what they import.
        """
        return self._digest(self.modules(module) | {f"{name}.py" for name in alone})

    def modules(self, module: str) -> set[str]:
        """The files of a module and of all that it imports."""
        found: set[str] = set()
        wanted = [self._file(module)]
        while wanted:
            name = wanted.pop()
            if name is None or name in found:
                continue
            found |= {name, *(f"{folder}/{INIT}".removeprefix("./") for folder in PurePosixPath(name).parents)}
            wanted += self._imports(name)
        return found

    def _imports(self, name: str) -> list[str | None]:
        """The files that a file's imports name: `from clinic.a import b` is about a, and a.b where there is one."""
        made = []
        for place, names in IMPORT.findall(self.contents[name].decode()):
            made += [self._file(place), *(self._file(f"{place}.{one}".strip(".")) for one in NAME.findall(names))]
        return made

    def _file(self, module: str) -> str | None:
        path = module.replace(".", "/")
        return next((name for name in (f"{path}.py", f"{path}/{INIT}") if name in self.contents), None)

    def _digest(self, names: set[str]) -> str:
        return digest((name, self.contents[name]) for name in sorted(names))


def source_digest(package: Path = PACKAGE) -> str:
    """A digest of the package's files, as they are now."""
    return Sources(package).digest


def digest(files: Iterable[tuple[str, bytes]]) -> str:
    """A digest of files by their names and contents, in their order."""
    made = hashlib.sha256()
    for name, content in files:
        made.update(f"{name}\0{len(content)}\0".encode())
        made.update(content)
    return made.hexdigest()
