"""Other releases of MuJoCo: each in an environment of its own, below `.cache/releases`, asked what cases do there."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from clinic.engine import node
from clinic.engine.provoke import provoke
from clinic.pages.messages import LOCK as HEARD
from clinic.pages.messages import Heard, Message, codes_of, listen, load_messages, read_heard
from clinic.proof.experiments import measure_case
from clinic.proof.releases import (
    LOCK,
    Behaviour,
    Lock,
    Locked,
    differences,
    differing,
    files_digest,
    lock_text,
    on_releases,
    read_lock,
    release_problems,
)
from clinic.record.case import Case, load_case, read_cases
from clinic.record.checkout import cache_folder, folders, project_root
from clinic.record.problem import Problem
from clinic.work.cache import Cache
from clinic.work.parallel import jobs

PYTHON: tuple[str, ...] = ("3.3.7", "3.4.0", "3.5.0", "3.6.0", "3.7.0", "3.8.1", "3.9.0", "3.10.0", "3.11.0", "3.12.0")
PYTHON += ("3.13.0", "3.14.0", "3.15.0", "3.16.0", "3.17.0", "4.0.0")  # the last patch of each minor release since 3.3
NPM = ("3.9.0", "3.10.0", "3.12.0", "3.13.0", "3.14.0")
WHOLE = "whole"


def measure(root: Path, cases: Sequence[Case], releases: Iterable[str] = PYTHON) -> Lock:
    """What the cases do on every release: those of the Python binding, or of the JavaScript one for its cases.

    Raises:
        RuntimeError: If an environment cannot be made or the cases do not run in it.
    """
    wanted = list(releases)
    python = [case.slug for case in cases if case.record.language == "python"]
    javascript = [case.slug for case in cases if case.record.language == "javascript"]
    asked = [(python_environment, release, python) for release in wanted if python]
    asked += [(npm_environment, release, javascript) for release in wanted if javascript and release in NPM]
    with ThreadPoolExecutor(jobs()) as pool:
        answers = list(pool.map(lambda each: _ask(root, each[0](root, each[1]), each[2]), asked))
    seen: dict[str, dict[str, dict[str, Behaviour]]] = {case.slug: {} for case in cases}
    for answer in answers:
        for slug, (release, variants) in answer.items():
            seen[slug][release] = {name: Behaviour.model_validate(one) for name, one in variants.items()}
    return {case.slug: Locked(files=files_digest(case), releases=seen[case.slug]) for case in cases}


def compare(root: Path, slugs: Sequence[str], releases: Sequence[str]) -> Iterator[Problem]:
    """What cases do otherwise on releases than here, where `older` does not say so.

    Raises:
        RuntimeError: If an environment cannot be made or the cases do not run in it.
    """
    cases = [load_case(folder) for folder in folders(root, slugs)]
    for slug, locked in measure(root, cases, releases).items():
        case = next(case for case in cases if case.slug == slug)
        evidence = measure_case(case, Cache(cache_folder(root)), ())
        yield from release_problems(case, differing(evidence.model_copy(update={"releases": locked.releases})))


def write_lock(root: Path, measured: Lock, slugs: Iterable[str]) -> None:
    """Writes the lock file: what was measured now, and the rest of the cases as they stand there."""
    kept = {slug: locked for slug, locked in read_lock(root).items() if slug in set(slugs)}
    (root / LOCK).write_text(lock_text(kept | measured), encoding="utf-8")


def python_environment(root: Path, release: str) -> tuple[list[str], Path]:
    """The Python that has a release of MuJoCo and this package, and where it is to run."""
    folder = root / ".cache" / "releases" / release
    python = folder / "bin" / "python"
    if not (folder / WHOLE).exists():
        shutil.rmtree(folder, ignore_errors=True)
        project = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]
        others = [need for need in project["dependencies"] if not need.startswith("mujoco")]
        _run([_uv(), "venv", "--quiet", "--python", sys.executable, str(folder)], root)
        _run([_uv(), "pip", "install", "--quiet", "--python", str(python), f"mujoco=={release}", *others], root)
        _run([_uv(), "pip", "install", "--quiet", "--python", str(python), "--no-deps", "--editable", str(root)], root)
        (folder / WHOLE).touch()
    return [str(python)], root


def npm_environment(root: Path, release: str) -> tuple[list[str], Path]:
    """The same for a release of the JavaScript binding."""
    folder = root / ".cache" / "releases" / f"npm-{release}"
    if not (folder / WHOLE).exists():
        folder.mkdir(parents=True, exist_ok=True)
        npm = shutil.which("npm", path=os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]]))
        if npm is None:
            raise RuntimeError("npm is not installed; run `make setup`")
        _run([npm, "install", "--silent", "--no-save", "--prefix", str(folder), f"{node.MUJOCO}@{release}"], folder)
        (folder / WHOLE).touch()
    return [sys.executable], folder


def listen_to(root: Path, messages: Sequence[Message]) -> Heard:
    """What the releases say otherwise, when the messages are provoked there.

    Raises:
        RuntimeError: If an environment cannot be made or nothing can be provoked in it.
    """
    codes = codes_of(messages)
    with ThreadPoolExecutor(jobs()) as pool:
        pythons = (python_environment(root, release)[0][0] for release in PYTHON)
        return listen(messages, dict(zip(PYTHON, pool.map(lambda each: provoke(codes, each), pythons), strict=True)))


def _known(case: Case) -> bool:
    wanted = NPM if case.record.language == "javascript" else PYTHON
    return on_releases(case).keys() >= {*wanted}


def _ask(root: Path, environment: tuple[list[str], Path], slugs: list[str]) -> dict[str, tuple[str, dict[str, object]]]:
    command, folder = environment
    said = _run([*command, "-m", "clinic.proof.releases", str(root / "cases"), *slugs], folder)
    answer: dict[str, tuple[str, dict[str, object]]] = json.loads(said)
    return answer


def _uv() -> str:
    return shutil.which("uv", path=os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])) or "uv"


def _run(command: list[str], folder: Path) -> str:
    done = subprocess.run(command, cwd=folder, check=False, capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(f"{Path(command[0]).name} {command[1]} failed: {done.stderr.strip()[-500:]}")
    return done.stdout


def stale(lock: Lock, measured: Lock) -> Iterator[str]:
    """What the lock file says otherwise than was measured now."""
    for slug, locked in measured.items():
        for release, seen in locked.releases.items():
            known = lock[slug].releases.get(release, {}) if slug in lock else {}
            yield from (f"{slug} on {release}: {told}" for told in differences(seen, known))


def main() -> None:
    """Writes the lock files, of the cases that have changed since or of all with `--all`.

    With `--check` measures all, says where the files are stale, and ends with 1 if they are.
    """
    root, messages = project_root(), load_messages()
    cases, _ = read_cases(root / "cases")
    asked = cases if {"--all", "--check"} & {*sys.argv} else [case for case in cases if not _known(case)]
    measured, heard = measure(root, asked), listen_to(root, messages)
    if "--check" not in sys.argv:
        write_lock(root, measured, [case.slug for case in cases])
        (root / HEARD).write_text(f"{heard.model_dump_json(indent=1)}\n", encoding="utf-8")
        return
    told = list(stale(read_lock(root), measured))
    told += [f"{HEARD} says otherwise"] if read_heard(root, messages) != heard else []
    if told:
        sys.exit("\n".join([*told, "a lock is stale: run `make releases` and commit it"]))


if __name__ == "__main__":
    main()
