"""MuJoCo's MUJOCO_LOG.TXT: no process of the clinic leaves one behind."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

SAYS = "<mujoco><worldbody><body><freejoint/><geom size='1' user='nan'/></body></worldbody></mujoco>"
STEPPED = f"""
import mujoco
def say(_=0):
    import clinic.engine.simulate
    model = mujoco.MjModel.from_xml_string({SAYS!r})
    data = mujoco.MjData(model)
    data.qvel[:] = 1e30
    mujoco.mj_step(model, data)
"""
LISTENED = """
from clinic.engine.simulate import captured_messages
with captured_messages() as messages:
    say()
assert len(messages) == 2, messages
"""
WORKERS = """
import joblib
joblib.Parallel(n_jobs=2)(joblib.delayed(say)(k) for k in range(4))
"""


def left_behind(folder: Path, *command: str) -> tuple[str, bool]:
    """What is said on stderr, and whether there is a log then."""
    done = subprocess.run([sys.executable, *command], cwd=folder, check=False, capture_output=True, text=True)
    assert "Traceback" not in done.stderr, done.stderr
    return done.stderr, (folder / "MUJOCO_LOG.TXT").exists()


def test_mujoco_left_alone_writes_one(tmp_path: Path) -> None:
    alone = STEPPED.replace("import clinic.engine.simulate", "pass")
    assert left_behind(tmp_path, "-c", f"{alone}\nsay()")[1]


@pytest.mark.parametrize(
    "code",
    [
        pytest.param("say()", id="this-process"),
        pytest.param(f"{LISTENED}\nsay()", id="after-listening"),
        pytest.param(WORKERS, id="workers"),
    ],
)
def test_the_clinic_writes_none(tmp_path: Path, code: str) -> None:
    said, log = left_behind(tmp_path, "-c", f"{STEPPED}\n{code}")
    assert re.findall(r"(XML contains a 'NaN'|huge value in QVEL)", said)
    assert not log


def test_triage_writes_none(tmp_path: Path) -> None:
    (tmp_path / "model.xml").write_text(SAYS, encoding="utf-8")
    assert not left_behind(tmp_path, "-m", "clinic", "triage", "model.xml")[1]


def test_tests_write_none(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    exec(f"{STEPPED}\nsay()", {})
    assert not list(tmp_path.iterdir())
