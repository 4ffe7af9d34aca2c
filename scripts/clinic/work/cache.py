"""The build cache: finished work on disk, found again by a digest of what it was made from."""

from __future__ import annotations

import hashlib
import json
import logging
import os
import platform
import zipfile
from collections.abc import Callable
from contextlib import suppress
from functools import lru_cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path, PurePosixPath

Files = dict[str, bytes]
PACKAGE = Path(__file__).parent.parent
STOREYS = ("record", "engine", "work", "proof", "triage", "diagnosis", "pages", "publish", "commands")
ENGINES = ("mujoco", "numpy", "matplotlib", "kiwisolver", "pillow", "av")
SETTINGS = ("MUJOCO_GL", "MUJOCO_EGL_DEVICE_ID", "LIBGL_ALWAYS_SOFTWARE", "GALLIUM_DRIVER")
log = logging.getLogger("clinic")


class Cache:
    """Files kept under `folder`, one zip archive a key.

    An archive comes into being by renaming, so that builds may share a folder and end at any moment.

    Attributes:
        incomplete: Whether something could not be made on this machine, and was left out.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.incomplete = False

    def path(self, key: str) -> Path:
        """Where the archive of a key lies."""
        return self.folder / f"{key}.zip"

    def get(self, key: str) -> Files | None:
        """The files of a key; None if it has none, or a damaged archive."""
        try:
            with zipfile.ZipFile(self.path(key)) as archive:
                return {name: archive.read(name) for name in archive.namelist()}
        except (OSError, zipfile.BadZipFile):
            return None

    def put(self, key: str, files: Files) -> None:
        """Stores files under a key; where the folder takes nothing, this is said once."""
        part = self.folder / f"{key}.{os.getpid()}.part"
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            with zipfile.ZipFile(part, "w") as archive:
                for name, content in files.items():
                    archive.writestr(name, content)
            os.replace(part, self.path(key))
        except OSError as error:
            log_cache_unwritable(self.folder, type(error).__name__)
            with suppress(OSError):
                part.unlink()

    def remember(self, key: str, make: Callable[[], Files]) -> Files:
        """The files of a key, made and stored if they are not there."""
        if (files := self.get(key)) is None:
            files = make()
            self.put(key, files)
        return files


@lru_cache
def log_cache_unwritable(folder: Path, reason: str) -> None:
    """Logs once that results are not kept."""
    log.warning("%s takes no files (%s): results are not kept, and the next build makes them again", folder, reason)


def key_of(*parts: object, of: str) -> str:
    """A key for work of the package's folder `of` that depends on `parts`, as JSON takes them, and `dependencies`."""
    return hashlib.sha256(json.dumps([*parts, dependencies(of)], sort_keys=True).encode()).hexdigest()[:32]


def dependencies(folder: str = STOREYS[-1]) -> dict[str, str | None]:
    """What every result of a folder depends on: the source of the package up to there, the engines, how they draw."""
    return {"clinic": source_digest(folder), **engines(), **{name: os.environ.get(name) for name in SETTINGS}}


@lru_cache
def source_digest(folder: str) -> str:
    """A digest of the package's files in a folder and in the storeys before it, for nothing later is imported there."""
    made, storey = hashlib.sha256(), PurePosixPath(folder).parts[0]
    for place in (*STOREYS[: STOREYS.index(storey)], folder):
        for path in sorted((PACKAGE / place).rglob("*")):
            if path.is_file() and path.suffix != ".pyc":
                made.update(path.relative_to(PACKAGE).as_posix().encode() + b"\0" + path.read_bytes())
    return made.hexdigest()


@lru_cache
def engines() -> dict[str, str]:
    """What runs and draws, with its version, as far as it is installed. Fonts come with the drawing libraries."""
    here = {"python": platform.python_version(), "machine": f"{platform.system()} {platform.machine()}"}
    for name in ENGINES:
        with suppress(PackageNotFoundError):
            here[name] = version(name)
    return here
