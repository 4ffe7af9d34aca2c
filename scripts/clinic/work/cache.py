"""A store of finished work, found again by the content that it was made from."""

from __future__ import annotations

import contextlib
import hashlib
import io
import json
import logging
import os
import platform
import re
import tempfile
import time
import zipfile
from collections.abc import Callable, Iterable
from functools import lru_cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path, PurePosixPath

Files = dict[str, bytes]
PACKAGE = Path(__file__).parent.parent
STOREYS = ("record", "engine", "work", "proof", "triage", "pages", "publish", "commands")
ENGINES = ("mujoco", "numpy", "matplotlib", "kiwisolver", "pillow", "av")
SETTINGS = ("MUJOCO_GL", "MUJOCO_EGL_DEVICE_ID", "PYOPENGL_PLATFORM", "LIBGL_ALWAYS_SOFTWARE", "GALLIUM_DRIVER")
ENTRY = re.compile(r"[0-9a-f]{32}\.bin")
CHECKSUM = hashlib.sha256().digest_size
EPOCH = (1980, 1, 1, 0, 0, 0)
ORPHANED = 3600.0
log = logging.getLogger("clinic")


class Cache:
    """Files kept under `folder`, one archive a key, behind its checksum. One that is not whole is made again.

    An archive comes into being by renaming, so that builds may share a folder and end at any moment.

    Attributes:
        missed: The keys that were asked for and are still not kept.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.missed: set[str] = set()

    def path(self, key: str) -> Path:
        """Where the archive of a key lies."""
        return self.folder / f"{key}.bin"

    def get(self, key: str) -> Files | None:
        """The files of a key, or None."""
        files = self._get(key)
        if files is None:
            self.missed.add(key)
        return files

    def _get(self, key: str) -> Files | None:
        try:
            whole = self.path(key).read_bytes()
        except OSError:
            return None
        checksum, packed = whole[:CHECKSUM], whole[CHECKSUM:]
        if _checksum(key, packed) != checksum:
            return None
        try:
            with zipfile.ZipFile(io.BytesIO(packed)) as archive:
                return {name: archive.read(name) for name in archive.namelist()}
        except Exception:  # zipfile has a dozen ways to say that this is no archive
            return None

    def put(self, key: str, files: Files) -> None:
        """Stores files under a key, all or nothing.

        Nothing is stored where the folder takes nothing, which is said once.
        """
        packed = io.BytesIO()
        with zipfile.ZipFile(packed, "w", zipfile.ZIP_STORED) as archive:
            for name, content in sorted(files.items()):
                archive.writestr(zipfile.ZipInfo(name, EPOCH), content)
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            self._write(key, _checksum(key, packed.getvalue()) + packed.getvalue())
            self.missed.discard(key)
        except OSError as error:
            say_unkept(self.folder, type(error).__name__)

    def remember(self, key: str, make: Callable[[], Files]) -> Files:
        """The files of a key, made and stored if they are not there."""
        files = self.get(key)
        if files is None:
            files = make()
            self.put(key, files)
        return files

    def entries(self) -> list[Path]:
        """Every archive."""
        return [path for path in self.folder.glob("*.bin") if ENTRY.fullmatch(path.name)]

    def tidy(self) -> None:
        """Removes what builds that were killed left half written: what has not changed for ORPHANED s."""
        for part in self.folder.glob("*.part"):
            with contextlib.suppress(OSError):
                if time.time() - part.stat().st_mtime > ORPHANED:
                    part.unlink()

    def _write(self, key: str, whole: bytes) -> None:
        handle, part = tempfile.mkstemp(dir=self.folder, suffix=".part")
        try:
            with open(handle, "wb") as file:
                file.write(whole)
            os.replace(part, self.path(key))
        except BaseException:
            with contextlib.suppress(OSError):
                os.unlink(part)
            raise


@lru_cache
def say_unkept(folder: Path, reason: str) -> None:
    """Says once that results are not kept; a strict build does not fail for it."""
    log.warning("%s takes no files (%s): results are not kept, and the next build makes them again", folder, reason)


def key_of(*parts: object, of: str) -> str:
    """A key for work that depends on `parts` and on its origin.

    Args:
        parts: As JSON takes them.
        of: The folder of the package that does the work.
    """
    text = json.dumps([*parts, origin(of)], sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:32]


def origin(folder: str = STOREYS[-1]) -> dict[str, str | None]:
    """What every result of a folder hangs on: the source of the package up to there, the engines, and how they draw."""
    settings = {name: os.environ.get(name) for name in SETTINGS}
    settings["PYOPENGL_PLATFORM"] = settings["PYOPENGL_PLATFORM"] or settings["MUJOCO_GL"]  # as MuJoCo will set it
    return {"clinic": source_digest(folder), **engines(), **settings}


@lru_cache
def source_digest(folder: str) -> str:
    """A digest of the package's files in a folder and in the storeys before it, for nothing later is imported there."""
    storey = PurePosixPath(folder).parts[0]
    return digest(
        (path.relative_to(PACKAGE).as_posix(), path.read_bytes())
        for place in (*STOREYS[: STOREYS.index(storey)], folder)
        for path in sorted((PACKAGE / place).rglob("*"))
        if path.is_file() and path.suffix != ".pyc"
    )


def digest(files: Iterable[tuple[str, bytes]]) -> str:
    """A digest of files by their names and contents, in their order."""
    made = hashlib.sha256()
    for name, content in files:
        made.update(f"{name}\0{len(content)}\0".encode())
        made.update(content)
    return made.hexdigest()


@lru_cache
def engines() -> dict[str, str]:
    """What runs and draws, with its version, as far as it is installed. Fonts come with the drawing libraries."""
    here = {"python": platform.python_version(), "machine": f"{platform.system()} {platform.machine()}"}
    for name in ENGINES:
        with contextlib.suppress(PackageNotFoundError):
            here[name] = version(name)
    return here


def _checksum(key: str, packed: bytes) -> bytes:
    return hashlib.sha256(f"{key}\0".encode() + packed).digest()
