"""The package's files: which of them a module's work hangs on."""

from __future__ import annotations

import ast
import shutil
from pathlib import Path

import pytest
from clinic.cache import LOADED
from clinic.exhibit import BESIDE, MODULES
from clinic.sources import PACKAGE, Sources, digest, source_digest
from project import run, write_project

IGNORED = shutil.ignore_patterns("__pycache__")
KINDS = [MODULES.get(kind, kind) for kind in ("evidence", "sweeps", "robustness", "film", "pictures", "plots")]
OPENED = """
import os, sys
from pathlib import Path
opened = set()

def hear(event, said):
    if event == "open" and isinstance(said[0], str | bytes):
        opened.add(os.fsdecode(said[0]))
    if event == "subprocess.Popen":  # programs are named by their files or, after -m, as modules
        opened.update(f"{package}/{part[7:]}.py" if part[:7] == "clinic." else part for part in said[1])

from clinic import cache
from clinic.case import load_cases
from clinic.exhibit import all_exhibits
package = Path(cache.__file__).resolve().parent
cache.source_digest = lambda: cache.LOADED  # else every file is read to see whether it has changed
sys.addaudithook(hear)
all_exhibits(load_cases(Path("cases")), cache.Cache(Path("elsewhere")))
for path in {Path(path).resolve() for path in opened}:
    if path.is_relative_to(package):
        name = path.relative_to(package)
        print(name.parent.parent / f"{name.name.split('.')[0]}.py" if "__pycache__" in name.parts else name)
"""


def imported(name: str, sources: Sources) -> set[str]:
    """The files that a file of the package imports, by Python's own grammar."""
    found = set()
    for node in ast.walk(ast.parse(sources.contents[name])):
        if isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{name}:{node.lineno} imports relatively: write `from clinic.x import y`"
            found |= {node.module or "", *(f"{node.module}.{alias.name}" for alias in node.names)}
        elif isinstance(node, ast.Import):
            own = [alias.name for alias in node.names if alias.name.split(".")[0] == "clinic"]
            assert not own, f"{name}:{node.lineno} imports {own}: write `from clinic.x import y`"
    paths = [module.removeprefix("clinic").strip(".").replace(".", "/") for module in found if module[:6] == "clinic"]
    return {file for path in paths for file in (f"{path}.py", f"{path}/__init__.py") if file in sources.contents}


def test_every_import_counts() -> None:
    sources = Sources()
    files = [name for name in sources.contents if name.endswith(".py") and not name.startswith("templates/")]
    named = {name: imported(name, sources) for name in files}
    for name in files:
        behind = sources.modules(name.removesuffix(".py").removesuffix("/__init__").replace("/", "."))
        assert name in behind
        assert set().union(*(named[known] for known in behind)) <= behind, name


def test_a_module_hangs_on_what_it_imports_and_on_no_more() -> None:
    sources = Sources()
    assert {"film.py", "simulate.py", "record.py", "__init__.py"} <= sources.modules("film")
    assert {"triage/__init__.py", "triage/steps.py"} <= sources.modules("triage.table")
    for module in KINDS:
        assert not {"pages.py", "site.py", "laws.py", "cli.py"} & sources.modules(module), module
    assert "film.py" not in sources.modules("sweep")


@pytest.mark.parametrize("module", [*KINDS, "lookalike", "messages", "triage.table"])
def test_the_digest_follows_what_is_behind_the_module_alone(module: str) -> None:
    sources = Sources()
    before, behind = sources.behind(module, *BESIDE), sources.modules(module) | {f"{name}.py" for name in BESIDE}
    for name in sources.contents:
        changed = Sources()
        changed.contents[name] += b"\n"
        assert (changed.behind(module, *BESIDE) != before) == (name in behind), name


def test_what_makes_exhibits_reads_no_other_file_of_the_package(tmp_path: Path) -> None:
    done = run(write_project(tmp_path), "-c", OPENED)
    assert done.returncode == 0, done.stderr
    sources = Sources()
    known = sources.modules("exhibit") | {f"{name}.py" for name in BESIDE}
    found = set(done.stdout.split())
    assert {"plots.py", "mjcf.py", "confine.py"} <= found
    assert found <= known, "results hang on it: import it, or name it in BESIDE"


def test_digest_follows_names_and_contents() -> None:
    def of(**files: str) -> str:
        return digest((name, text.encode()) for name, text in files.items())

    assert of(a="1", b="2") == of(a="1", b="2")
    assert len({of(a="1", b="2"), of(a="12", b=""), of(a="2", b="1"), of(c="1", b="2")}) == 4


def test_source_digest_follows_every_file_of_the_package(tmp_path: Path) -> None:
    package = shutil.copytree(PACKAGE, tmp_path / "clinic", ignore=IGNORED)
    assert source_digest(package) == source_digest() == LOADED
    digests = {LOADED}
    files = [path for path in sorted(package.rglob("*")) if path.is_file()]
    for path in files:
        content = path.read_bytes()
        path.write_bytes(content + b"\n")
        digests.add(source_digest(package))
        path.write_bytes(content)
    (package / "triage" / "checks.py").write_bytes((package / "checks.py").read_bytes())
    digests.add(source_digest(package))
    assert len(digests) == len(files) + 2


def test_source_digest_leaves_out_what_is_no_source(tmp_path: Path) -> None:
    package = shutil.copytree(PACKAGE, tmp_path / "clinic", ignore=IGNORED)
    (package / "__pycache__").mkdir()
    for name in ("__pycache__/cache.cpython-311.pyc", ".cache.py.swp", "cache.py~"):
        (package / name).write_bytes(b"")
    assert source_digest(package) == LOADED
