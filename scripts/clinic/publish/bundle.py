"""The browser's parts: the playground's modules bundled, and the engine, as files of the site."""

from __future__ import annotations

import gzip
import io
import subprocess
import tempfile
import zipfile
from pathlib import Path

from clinic.engine import node
from clinic.work.cache import Cache, Files, key_of
from clinic.work.task import log_missing_once

FOLDER = "javascripts/playground"
START = f"{FOLDER}/start.js"  # which a site without Node's packages does not have
STYLE = "docs/stylesheets/playground.css"
BUNDLER = "scripts/bundle.mjs"
ENGINE = "node_modules/@mujoco/mujoco/mujoco.wasm"
PYODIDE = "node_modules/pyodide"
PYTHON = ("pyodide.asm.mjs", "pyodide.asm.wasm")
LIBRARY = "python_stdlib.zip"
CODECS = ("__init__", "aliases", "ascii", "cp437", "latin_1", "utf_8", "utf_8_sig")  # of all that Python knows
UNUSED = (  # of the library, by the rules
    "_pydatetime _pydecimal _pyio _pyrepl argparse bdb cmd configparser csv ctypes dbm doctest email filecmp fractions "
    "ftplib getopt gettext graphlib html http imaplib ipaddress mailbox mimetypes modulefinder multiprocessing netrc "
    "optparse pdb pickletools platform plistlib poplib pprint profile pstats pyclbr pydoc pydoc_data sched shelve "
    "smtplib socketserver sqlite3 statistics symtable sysconfig tabnanny tarfile timeit trace turtle unittest urllib "
    "uuid venv wave webbrowser wsgiref xmlrpc zipapp zoneinfo"
)
DIAGNOSIS = "javascripts/diagnosis"
INSTALLED = "node_modules/.package-lock.json"
TABLES = ("scripts/clinic/engine/since.json", "scripts/clinic/proof/task.json")  # which the modules import
CUSTOM_SECTION = 0
HEADER = 8  # bytes: WebAssembly's mark and version


def playground_files(root: Path, cache: Cache) -> Files:
    """The playground's files by their path in the site; without Node or its packages a loader that does nothing.

    Raises:
        RuntimeError: If the modules do not bundle, with what the bundler says.
    """
    if node.launcher() and (root / ENGINE).is_file():
        modules = sorted((root / "docs/playground").rglob("*.js"))
        sources = [*modules, *(root / path for path in (STYLE, BUNDLER, INSTALLED, *TABLES)), Path(__file__)]
        key = key_of("playground", [[path.name, path.read_text(encoding="utf-8")] for path in sources], of="record")
        made = cache.remember(key, lambda: _bundle(root))
        return {f"{FOLDER}/{name}": content for name, content in made.items()}
    cache.incomplete = True
    log_missing_once("no playground: Node or its packages are not installed; run `make setup`")
    return {f"{FOLDER}/loader.js": b"// This site was built without Node: no playground, and no search.\n"}


def diagnosis_files(root: Path, cache: Cache) -> Files:
    """Python for the page, its standard library and the rules, by their path in the site; none without the packages."""
    folder = root / PYODIDE
    if not folder.is_dir():
        return {}
    installed = (root / INSTALLED).read_text(encoding="utf-8")
    key = key_of("python", installed, Path(__file__).read_text(encoding="utf-8"), of="record")
    made = cache.remember(key, lambda: _python(folder))
    package = Path(__file__).parents[1]
    bench = package / "diagnosis" / "bench"
    every = [path for kind in ("py", "toml") for path in sorted((package / "diagnosis").rglob(f"*.{kind}"))]
    needed = [package / "engine" / name for name in ("__init__.py", "mjcf.py", "since.json")]
    rules = [*(path for path in every if not path.is_relative_to(bench)), *needed]
    files = {f"clinic/{path.relative_to(package).as_posix()}": path.read_bytes() for path in rules}
    made |= {"clinic.zip": _zip({"clinic/__init__.py": (package / "__init__.py").read_bytes(), **files})}
    return {f"{DIAGNOSIS}/{name}": content for name, content in made.items()}


def strip_custom_sections(wasm: bytes) -> bytes:
    """The WebAssembly module without names and debugging data, which are half of it and which nothing reads."""
    kept, at = [wasm[:HEADER]], HEADER
    while at < len(wasm):
        size, body = _leb128(wasm, at + 1)
        if wasm[at] != CUSTOM_SECTION:
            kept.append(wasm[at : body + size])
        at = body + size
    return b"".join(kept)


def _bundle(root: Path) -> Files:
    with tempfile.TemporaryDirectory(prefix="clinic-") as folder:
        command = [str(node.launcher()), BUNDLER, folder]
        done = subprocess.run(command, cwd=root, check=False, capture_output=True, text=True)
        if done.returncode:
            raise RuntimeError(f"{BUNDLER} failed:\n{done.stderr.strip()}")
        made = {path.name: path.read_bytes() for path in sorted(Path(folder).iterdir())}
    engine = strip_custom_sections((root / ENGINE).read_bytes())
    return {**made, "mujoco.wasm.gz": gzip.compress(engine, compresslevel=9, mtime=0)}


def _python(folder: Path) -> Files:
    """Pyodide, gzipped for hosts that do not compress, and its library without what the rules have no use for."""
    made = {f"{name}.gz": gzip.compress((folder / name).read_bytes(), compresslevel=9, mtime=0) for name in PYTHON}
    with zipfile.ZipFile(folder / LIBRARY) as archive:
        used = {name: archive.read(name) for name in archive.namelist() if _used(name)}
    return {**made, LIBRARY: _zip(used)}


def _used(name: str) -> bool:
    top, _, rest = name.partition("/")
    if top == "encodings":
        return rest.removesuffix(".py") in CODECS
    return top.removesuffix(".py") not in UNUSED.split()


def _zip(files: Files) -> bytes:
    """A zip of files, whose entries have the same date always."""
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, content in files.items():
            archive.writestr(zipfile.ZipInfo(name), content, zipfile.ZIP_DEFLATED, 9)
    return packed.getvalue()


def _leb128(data: bytes, at: int) -> tuple[int, int]:
    """An unsigned number, seven bits a byte, the lowest first, and where it ends."""
    end = at
    while data[end] & 0x80:
        end += 1
    return sum((byte & 0x7F) << 7 * k for k, byte in enumerate(data[at : end + 1])), end + 1
