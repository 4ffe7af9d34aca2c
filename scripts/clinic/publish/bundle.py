"""The browser's parts: the playground's modules bundled, and the engine, as files of the site."""

from __future__ import annotations

import gzip
import logging
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from clinic.work.cache import Cache, Files, digest

FOLDER = "javascripts/playground"
LOADER = "docs/playground/loader.js"
STYLE = "docs/stylesheets/playground.css"
BUNDLER = "scripts/bundle.mjs"
ENGINE = "node_modules/@mujoco/mujoco/mujoco.wasm"
CUSTOM_SECTION = 0
WASM_HEADER = b"\0asm\x01\0\0\0"
log = logging.getLogger("mkdocs.clinic")


class UnavailableError(RuntimeError):
    """Node or a package is not installed; the message says which."""


def parts(root: Path) -> Files:
    """The playground's files by their path in the site; without Node or its packages the loader alone."""
    loader = f"{FOLDER}/loader.js"
    try:
        made = bundled(root)
    except UnavailableError as error:
        log.log(logging.WARNING if os.environ.get("CI") else logging.INFO, "no playground: %s", error)
        return {loader: (root / LOADER).read_bytes()} if (root / LOADER).is_file() else {}
    return {f"{FOLDER}/{name}": content for name, content in made.items()}


def has_playground(made: Files) -> bool:
    """Whether the files of `parts` hold more than the loader."""
    return f"{FOLDER}/start.js" in made


def bundled(root: Path) -> Files:
    """The bundled modules and the engine by name, kept in `.cache/playground` by content.

    Raises:
        UnavailableError: If Node or a package is missing.
        RuntimeError: If the modules do not bundle, with what the bundler says.
    """
    for needed in (ENGINE, "node_modules/esbuild"):
        if not (root / needed).exists():
            raise UnavailableError(f"{needed} is not there; run `make setup`")
    sources = [
        *sorted((root / "docs/playground").rglob("*.js")),
        root / STYLE,
        root / BUNDLER,
        root / "package-lock.json",
    ]
    cache = Cache(root / ".cache" / "playground")
    key = digest((path.name, path.read_bytes()) for path in [*sources, Path(__file__)])[:32]
    return cache.remember(key, lambda: _bundle(root))


def node() -> str:
    """The path of Node: the environment's own, or the system's.

    Raises:
        UnavailableError: If there is none.
    """
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
    found = shutil.which("node", path=path)
    if found is None:
        raise UnavailableError("node is not installed; run `make setup`")
    return found


def strip_custom_sections(wasm: bytes) -> bytes:
    """The module without its custom sections: names and debugging data, which nothing at run time reads.

    Raises:
        ValueError: If the bytes are no WebAssembly module.
    """
    if not wasm.startswith(WASM_HEADER):
        raise ValueError("not a WebAssembly module of version 1")
    kept, at = [WASM_HEADER], len(WASM_HEADER)
    while at < len(wasm):
        size, body = _leb128(wasm, at + 1)
        if wasm[at] != CUSTOM_SECTION:
            kept.append(wasm[at : body + size])
        at = body + size
    return b"".join(kept)


def _bundle(root: Path) -> Files:
    program = node()
    with tempfile.TemporaryDirectory(prefix="clinic-") as folder:
        done = subprocess.run([program, BUNDLER, folder], cwd=root, check=False, capture_output=True, text=True)
        if done.returncode:
            raise RuntimeError(f"{BUNDLER} failed:\n{done.stderr.strip()}")
        made = {path.name: path.read_bytes() for path in sorted(Path(folder).iterdir())}
    engine = strip_custom_sections((root / ENGINE).read_bytes())
    return {**made, "mujoco.wasm.gz": gzip.compress(engine, compresslevel=9, mtime=0)}


def _leb128(data: bytes, at: int) -> tuple[int, int]:
    """An unsigned number and where it ends."""
    value = shift = 0
    while True:
        byte = data[at]
        at += 1
        value |= (byte & 0x7F) << shift
        shift += 7
        if not byte & 0x80:
            return value, at
