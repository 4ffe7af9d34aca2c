"""A store of finished work, found again by the content that it was made from."""

from __future__ import annotations

import hashlib
import io
import json
import os
import tempfile
import zipfile
from collections.abc import Callable, Iterable
from importlib.metadata import version
from pathlib import Path

Files = dict[str, bytes]
ENGINES = ("mujoco", "numpy", "matplotlib", "pillow")
CHECKSUM = hashlib.sha256().digest_size
EPOCH = (1980, 1, 1, 0, 0, 0)


class Cache:
    """Files kept under `folder`, one archive a key, behind its checksum. One that is not whole is made again."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def path(self, key: str) -> Path:
        """Where the archive of a key lies."""
        return self.folder / f"{key}.bin"

    def get(self, key: str) -> Files | None:
        """The files of a key, or None."""
        try:
            whole = self.path(key).read_bytes()
        except OSError:
            return None
        checksum, packed = whole[:CHECKSUM], whole[CHECKSUM:]
        if hashlib.sha256(packed).digest() != checksum:
            return None
        with zipfile.ZipFile(io.BytesIO(packed)) as archive:
            return {name: archive.read(name) for name in archive.namelist()}

    def put(self, key: str, files: Files) -> None:
        """Stores files under a key, all or nothing."""
        self.folder.mkdir(parents=True, exist_ok=True)
        packed = io.BytesIO()
        with zipfile.ZipFile(packed, "w", zipfile.ZIP_STORED) as archive:
            for name, content in sorted(files.items()):
                archive.writestr(zipfile.ZipInfo(name, EPOCH), content)
        with tempfile.NamedTemporaryFile(dir=self.folder, suffix=".part", delete=False) as part:
            part.write(hashlib.sha256(packed.getvalue()).digest() + packed.getvalue())
        os.replace(part.name, self.path(key))

    def remember(self, key: str, make: Callable[[], Files]) -> Files:
        """The files of a key, made and stored if they are not there."""
        files = self.get(key)
        if files is None:
            files = make()
            self.put(key, files)
        return files


def key_of(*parts: object) -> str:
    """A key for work that depends on `parts`, on this package's source and on the engines' versions."""
    text = json.dumps([*parts, source_digest(), {name: version(name) for name in ENGINES}], sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:32]


def source_digest() -> str:
    """A digest of the package's own files."""
    return digest(sorted(path for path in Path(__file__).parent.rglob("*") if path.suffix in (".py", ".j2")))


def digest(paths: Iterable[Path]) -> str:
    """A digest of the files' names and contents."""
    made = hashlib.sha256()
    for path in paths:
        content = path.read_bytes()
        made.update(f"{path.name}\0{len(content)}\0".encode())
        made.update(content)
    return made.hexdigest()
