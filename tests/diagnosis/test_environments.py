"""`clinic.diagnose` on the models of other people's environments, as their users would call it."""

from __future__ import annotations

import os
import subprocess
import sys

from clinic.diagnosis.bench.healthy import FOLDER
from clinic.diagnosis.process import diagnose

ANT = """
import clinic
import gymnasium

env = gymnasium.make("Ant-v5").unwrapped
found = clinic.diagnose((env.model, env.fullpath))
print(found.file, [each.rule for each in found.causes], "model-changed" in {each.rule for each in found.hints})
"""


def test_a_gymnasium_environment(root):
    path = os.pathsep.join([str(root / FOLDER), *filter(None, sys.path)])
    command = [sys.executable, "-W", "ignore", "-c", ANT]
    done = subprocess.run(command, capture_output=True, text=True, check=False, env={**os.environ, "PYTHONPATH": path})
    assert done.stdout == "ant.xml [] False\n", done.stderr


def test_a_dm_control_text_with_its_assets(root):
    suite = root / FOLDER / "dm_control" / "suite"
    assets = {f"./common/{path.name}": path.read_bytes() for path in (suite / "common").glob("*.xml")}
    text = (suite / "cartpole.xml").read_text()
    found = diagnose(text, assets=assets)
    assert not found.error
    assert not found.causes
    assert diagnose(text).error  # without them it does not compile
