"""The wheel as a user has it: light, with the cases inside, and of use outside of a checkout."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import zipfile
from email.message import Message
from email.parser import Parser
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
BASE = {"joblib", "latex2mathml", "mujoco>=3.4", "numpy", "packaging", "pydantic", "pyyaml", "rich", "typer"}
SITE = ("av", "jinja2", "matplotlib", "mkdocs", "mkdocs_gen_files", "material", "PIL")
MODEL = "<mujoco><worldbody><body><freejoint/><geom size='.1'/></body></worldbody></mujoco>"


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> zipfile.ZipFile:
    folder = tmp_path_factory.mktemp("wheel")
    command = [sys.executable, "-m", "hatchling", "build", "--target", "wheel", "--directory", str(folder)]
    subprocess.run(command, cwd=ROOT, check=True, capture_output=True)
    return zipfile.ZipFile(next(folder.glob("*.whl")))


@pytest.fixture(scope="module")
def installed(wheel: zipfile.ZipFile, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel's files, beside a module that hides what only the extra `site` brings."""
    folder = tmp_path_factory.mktemp("installed")
    wheel.extractall(folder)
    hide = f"import sys\nfor name in {SITE}:\n    sys.modules[name] = None\n"
    (folder / "sitecustomize.py").write_text(hide, encoding="utf-8")
    return folder


def clinic(installed: Path, place: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Runs the command in a folder outside of any checkout."""
    environment = {**os.environ, "PYTHONPATH": str(installed), "CLINIC_CACHE": str(place / "cache"), "CLINIC_JOBS": "1"}
    return subprocess.run(
        [sys.executable, "-P", "-m", "clinic", *arguments],
        cwd=place,
        env=environment,
        check=False,
        capture_output=True,
        text=True,
    )


def metadata(wheel: zipfile.ZipFile) -> Message:
    (name,) = (name for name in wheel.namelist() if name.endswith(".dist-info/METADATA"))
    return Parser().parsestr(wheel.read(name).decode())


def test_a_user_gets_what_triage_needs_and_keeps_his_mujoco(wheel: zipfile.ZipFile) -> None:
    needed = [line for line in metadata(wheel).get_all("Requires-Dist", []) if "extra ==" not in line]
    assert {line if line.startswith("mujoco") else line.partition(">=")[0] for line in needed} == BASE


def test_what_builds_the_site_is_an_extra(wheel: zipfile.ZipFile) -> None:
    lines = metadata(wheel).get_all("Requires-Dist", [])
    assert any(line.startswith("mkdocs-material") and line.endswith("extra == 'site'") for line in lines)
    assert "mujoco>=4.0; extra == 'site'" in lines


def test_every_file_of_the_package_and_of_the_cases_is_in_it(wheel: zipfile.ZipFile) -> None:
    packed = {name for name in wheel.namelist() if name.startswith("clinic/")}
    package, cases = ROOT / "scripts" / "clinic", ROOT / "cases"
    files = [("clinic", path.relative_to(package)) for path in package.rglob("*")]
    files += [("clinic/cases", path.relative_to(cases)) for path in cases.rglob("*")]
    wanted = {f"{top}/{path.as_posix()}" for top, path in files if path.suffix and "__pycache__" not in path.parts}
    assert packed == wanted


def test_cases_are_listed_and_shown_without_a_checkout(installed: Path, tmp_path: Path) -> None:
    listed = clinic(installed, tmp_path, "list", "--json")
    assert {row["case"] for row in json.loads(listed.stdout)} == {path.name for path in (ROOT / "cases").iterdir()}
    shown = clinic(installed, tmp_path, "show", "box-falls-through-floor", "--answer")
    assert shown.returncode == 0, shown.stderr
    assert "Diagnosis" in shown.stdout
    assert "{{" not in shown.stdout


def test_a_model_is_examined_without_a_checkout(installed: Path, tmp_path: Path) -> None:
    (tmp_path / "model.xml").write_text(MODEL, encoding="utf-8")
    done = clinic(installed, tmp_path, "triage", "model.xml")
    assert done.returncode == 0, done.stderr
    assert [line[:2] for line in done.stdout.splitlines()] == [f"{n}." for n in range(1, 7)]


def test_a_model_is_diagnosed_without_a_checkout(installed: Path, tmp_path: Path) -> None:
    (tmp_path / "model.xml").write_text(MODEL.replace("size=", "colour='1 0 0 1' size="), encoding="utf-8")
    done = clinic(installed, tmp_path, "diagnose", "model.xml")
    assert done.returncode == 1, done.stderr
    assert "unknown-attribute" in done.stdout


@pytest.mark.parametrize("arguments", [("build", "--out", "site"), ("check",)])
def test_what_needs_more_says_so_in_a_sentence(installed: Path, tmp_path: Path, arguments: tuple[str, ...]) -> None:
    (tmp_path / "cases").mkdir()
    (tmp_path / "pyproject.toml").touch()
    done = clinic(installed, tmp_path, *arguments)
    assert done.returncode == 1
    assert done.stderr.endswith("is not installed; this needs a checkout, set up by `make setup`\n")
    assert done.stderr.count("\n") == 1


def test_an_engine_that_is_too_old_is_named_in_a_sentence(installed: Path, tmp_path: Path) -> None:
    told = tmp_path / "old" / "mujoco-3.3.7.dist-info"
    told.mkdir(parents=True)
    (told / "METADATA").write_text("Metadata-Version: 2.1\nName: mujoco\nVersion: 3.3.7\n", "utf-8")
    done = clinic(Path(f"{tmp_path / 'old'}{os.pathsep}{installed}"), tmp_path, "triage", "model.xml")
    assert done.returncode == 1
    assert done.stderr == "clinic: MuJoCo 3.3.7 is too old; this needs 3.4 or newer: pip install -U mujoco\n"
