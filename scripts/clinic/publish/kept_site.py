"""A finished site, kept under all that it was made from; an unchanged one is found without importing what makes it.

It hangs on the files below INPUTS, on the installed packages and Node, and on what `cache.origin` names.
"""

from __future__ import annotations

import json
import os
import stat
import sys
from collections import defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path, PurePosixPath

from clinic.engine import node
from clinic.record.problem import Problem
from clinic.work.cache import Cache, Files, key_of

INPUTS = ("cases", "docs", "scripts/bundle.mjs", "CONTRIBUTING.md", "package-lock.json")
INSTALLED = "node_modules/.package-lock.json"
LARGE = 2**24  # bytes
LIST = "site.json"
Navigation = list[dict[str, object]]
Stamp = tuple[str, int, int, int]


@dataclass(frozen=True)
class Site:
    """What there is to publish; a case in error has a page that says so.

    Attributes:
        files: Every generated file, by its path below the documentation folder.
        navigation: As MkDocs takes it.
        problems: All problems of all cases, and every claim that the runs do not bear out.
    """

    files: Files
    navigation: Navigation
    problems: tuple[Problem, ...] = ()

    @property
    def sectioned(self) -> bool:
        """Whether a section of the navigation has sections: there are many cases."""
        sections = (
            entry
            for part in self.navigation
            for entries in part.values()
            if isinstance(entries, list)
            for entry in entries
        )
        return any(isinstance(entries, list) for entry in sections for entries in entry.values())


def finished(root: Path, cache: Cache, make: Callable[[Path, Cache], Site]) -> Site:
    """The site that was made from the same inputs before, or else the one that `make` gives.

    This one is kept if nothing is wrong with it, all that it was made from is kept, and no input changed meanwhile.
    """
    before = list(stamps(root))
    key = key_of_site(root)
    if (kept := kept_site(cache, key)) is not None:
        return kept
    cache.missed.clear()
    made = make(root, cache)
    if not made.problems and not cache.missed and list(stamps(root)) == before:
        _put(cache, key, made)
    return made


def key_of_site(root: Path) -> str:
    """The key of everything that the site hangs on, as it is now."""
    return key_of("site", [(stamp[0], _content(root, stamp)) for stamp in stamps(root)], packages(), of="publish")


def kept_site(cache: Cache, key: str) -> Site | None:
    """The site that was kept under the key."""
    listed = cache.get(key)
    if listed is None:
        return None
    known = json.loads(listed[LIST])
    files: Files = {}
    for part in known["parts"]:
        if (found := cache.get(part)) is None:
            return None
        files |= found
    return Site({name: files[name] for name in known["order"]}, known["navigation"])


def stamps(root: Path) -> Iterator[Stamp]:
    """Every input with its kind, size in bytes and time in ns; those of a folder are 0."""
    found = [root / name for name in INPUTS]
    for path in found:
        if path.is_dir() and not path.is_symlink():
            found += sorted(path.iterdir())
    installed = node.modules()
    found += [root / INSTALLED, *([installed.parent / INSTALLED] if installed else []), *map(Path, node.found())]
    for path in found:
        if os.path.lexists(path):
            seen = path.lstat()
            sized = (0, 0) if stat.S_ISDIR(seen.st_mode) else (seen.st_size, seen.st_mtime_ns)
            yield os.path.relpath(path, root), stat.S_IFMT(seen.st_mode), *sized


def packages() -> list[str]:
    """The installed packages with their versions: `numpy-2.4.0.dist-info`."""
    return sorted({path.name for place in sys.path for path in Path(place).glob("*.dist-info")})


def _content(root: Path, stamp: Stamp) -> object:
    """What a build can read there; of a large file its size and time."""
    name, kind, size, time = stamp
    if kind == stat.S_IFLNK:
        return os.readlink(root / name)
    if kind == stat.S_IFREG and size <= LARGE:
        return sha256((root / name).read_bytes()).hexdigest()
    return kind, size, time


def _put(cache: Cache, key: str, made: Site) -> None:
    """Keeps the files by folder, each folder under its content: an edit of one case adds that case alone."""
    folders: dict[PurePosixPath, Files] = defaultdict(dict)
    for name, content in made.files.items():
        folders[PurePosixPath(name).parent][name] = content
    parts = []
    for files in folders.values():
        part = key_of("part", {name: sha256(content).hexdigest() for name, content in files.items()}, of="record")
        cache.remember(part, lambda files=files: files)  # type: ignore[misc]
        parts.append(part)
    known = {"parts": parts, "order": list(made.files), "navigation": made.navigation}
    cache.put(key, {LIST: json.dumps(known).encode()})
