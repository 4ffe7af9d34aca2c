"""The pages for contributors, followed by a machine: their quick commands are run, in order, in a copy."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
import yaml
from clinic.record.checkout import cache_folder

pytestmark = pytest.mark.xdist_group("contributing")
PAGES = ("CONTRIBUTING.md", "docs/contribute/add-a-case.md", "docs/contribute/work-on-the-code.md")
FENCE = re.compile(r"^ *```(?P<kind>[\w ]+)?\n(?P<code>.*?)^ *```$", re.MULTILINE | re.DOTALL)
PARTS = ("cases", "docs", "scripts", "tests", "pyproject.toml", "Makefile", ".gitignore")
CLUSTER = ("dask ", "MUJOCO_GL=egl dask ", "CLINIC_DASK=")
NOT_HERE = ("git clone", "make ", "bash .ci/run", "clinic view", "cd ", *CLUSTER)
"""What is slow, opens a window, or belongs to a fresh clone or a cluster; each is asked for in a test of its own."""


def written(root: Path) -> str:
    return "\n".join((root / page).read_text(encoding="utf-8") for page in PAGES)


def commands(root: Path) -> list[str]:
    fences = [match["code"] for match in FENCE.finditer(written(root)) if match["kind"] == "sh"]
    return [line.partition("  #")[0].strip() for code in fences for line in code.splitlines() if line.strip()]


@pytest.fixture(scope="module")
def environment(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """A user of a name of their own, without a display."""
    home = tmp_path_factory.mktemp("home")
    (home / ".gitconfig").write_text("[user]\nname = An Author\nemail = author@example.org\n", encoding="utf-8")
    (home / ".bashrc").touch()
    kept = {name: value for name, value in os.environ.items() if "DISPLAY" not in name and not name.startswith("GIT_")}
    return kept | {"HOME": str(home)}


@pytest.fixture(scope="module")
def copy(root: Path, tmp_path_factory: pytest.TempPathFactory, environment: dict[str, str]) -> Iterator[Path]:
    """A clone as `make setup` leaves it, with this environment in place of a new one."""
    made = tmp_path_factory.mktemp("clone") / "clinic"
    made.mkdir()
    for name in PARTS:
        source = root / name
        (shutil.copytree if source.is_dir() else shutil.copy)(source, made / name)
    (made / ".venv").symlink_to(sys.prefix)
    for command in (["git", "init", "--quiet"], ["git", "add", "."], ["git", "commit", "--quiet", "--message", "All"]):
        subprocess.run(command, cwd=made, env=environment, check=True)
    yield made
    shutil.rmtree(made)


@pytest.fixture(scope="module")
def followed(root: Path, copy: Path, environment: dict[str, str]) -> list[tuple[str, int, str]]:
    """Every quick command with its exit code and what it said, run in one shell after the other."""
    done = []
    for command in commands(root):
        if not command.startswith(NOT_HERE):
            own = environment | {"PYTHONPATH": str(copy / "scripts"), "CLINIC_CACHE": str(cache_folder(root))}
            script = f"source .venv/bin/activate\n{command}\nexit"  # or this shell would become the command
            run = subprocess.run(["bash", "-c", script], cwd=copy, env=own, check=False, capture_output=True, text=True)
            done.append((command, run.returncode, run.stdout + run.stderr))
    return done


def test_every_quick_command_succeeds(followed: list[tuple[str, int, str]]) -> None:
    assert len(followed) > 10
    failed = [f"$ {command}\n{said}" for command, code, said in followed if code]
    assert not failed, "\n".join(failed)


def test_the_road_ends_with_a_commit_of_the_new_folder_alone(
    copy: Path, environment: dict[str, str], followed: list[tuple[str, int, str]]
) -> None:
    show = ["git", "show", "--name-only", "--format=", "HEAD"]
    changed = subprocess.run(show, cwd=copy, env=environment, check=True, capture_output=True, text=True).stdout
    (slug,) = {shlex.split(command)[2] for command, *_ in followed if command.startswith("clinic new")}
    assert changed.split() == [f"cases/{slug}/case.yaml", f"cases/{slug}/model.xml"]
    state = ["git", "status", "--porcelain"]
    left = subprocess.run(state, cwd=copy, env=environment, check=True, capture_output=True, text=True).stdout
    assert left.replace("?? .venv\n", "") == ""


def test_viewing_opens_the_viewer_or_says_that_there_is_no_display(
    root: Path, copy: Path, environment: dict[str, str], followed: list[tuple[str, int, str]]
) -> None:
    own = environment | {"PYTHONPATH": str(copy / "scripts")}
    seen = [command for command in commands(root) if command.startswith("clinic view")]
    assert seen
    for command in seen:
        words = [sys.executable, "-m", *shlex.split(command)]
        run = subprocess.run(words, cwd=copy, env=own, check=False, capture_output=True, text=True)
        assert (run.returncode, run.stderr[:24]) == (1, "clinic: no display here:")


def test_every_other_command_is_known(root: Path) -> None:
    targets = [command.split()[1] for command in commands(root) if command.startswith("make ")]
    assert {"setup", "serve", "audit"} <= set(targets)
    subprocess.run(["make", "--dry-run", *targets], cwd=root, check=True, capture_output=True)
    other = {command for command in commands(root) if command.startswith(NOT_HERE)}
    asked = ("make ", "clinic view", *CLUSTER)
    known = {"bash .ci/run"}
    assert {command for command in other if not command.startswith(asked)} == known
    subprocess.run(["bash", "-n", ".ci/run"], cwd=root, check=True)


def test_commands_in_the_text_are_there(root: Path) -> None:
    text = FENCE.sub("", written(root))
    done = subprocess.run([sys.executable, "-m", "clinic", "--help"], check=True, capture_output=True, text=True)
    for name in re.findall(r"`clinic ([\w-]+)", text):
        assert re.search(rf"^│ {name} ", done.stdout, re.MULTILINE), name
    subprocess.run(["make", "--dry-run", *set(re.findall(r"`make (\w+)`", text))], cwd=root, check=True)


def test_hooks_check_what_make_lint_checks(root: Path) -> None:
    hooks = yaml.safe_load((root / ".pre-commit-config.yaml").read_text(encoding="utf-8"))["repos"][0]["hooks"]
    dry = ["make", "--dry-run", "--no-print-directory", "lint"]  # a test that make runs is told of no folder
    made = subprocess.run(dry, cwd=root, check=True, capture_output=True, text=True).stdout
    checks = made.splitlines()[-len(hooks) :]
    assert [hook["entry"].rstrip("'").split()[-2:] for hook in hooks] == [check.split()[-2:] for check in checks]
