"""Makes MuJoCo say what it warns of and complains about, each time in a process of its own, which may crash or hang.

`python -m clinic.engine.provoke`, run by the Python that has a release installed, answers stdin's codes with its texts.
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Mapping

from clinic.engine import sandbox

SECONDS = 10.0
LINES = 6  # of a long message are kept
SCRIPT = """\
import os
import mujoco
import numpy as np

def load(xml, files=None):
    return mujoco.MjModel.from_xml_string(xml, files or {})

os.dup2(1, 2)
with open("code.py", encoding="utf-8") as file:
    code = file.read()
try:
    exec(compile(code, "code.py", "exec"), {"mujoco": mujoco, "np": np, "load": load})
except BaseException as error:
    print(f"{type(error).__name__}: {error}", flush=True)  # before what destructors say
"""


def provoke(codes: Mapping[str, str]) -> dict[str, str]:
    """What each piece of Python printed, to stdout and stderr alike, by its name.

    A piece has `mujoco`, `np` and `load(xml, files)`, which compiles a model. Where it ended by a signal, a crash or
    more than SECONDS, a last line says so: `ended by signal 11`.
    """
    said = {}
    for name, code in codes.items():
        done = sandbox.run([sys.executable, "script.py"], {"script.py": SCRIPT, "code.py": code}, SECONDS)
        ended = f"\nended by signal {-done.returncode}" if done.returncode < 0 else ""
        said[name] = tidied(done.stdout + ended)
    return said


def tidied(text: str) -> str:
    """The first LINES lines that are not empty, without addresses in memory."""
    lines = [line.rstrip() for line in re.sub(r"0x[0-9a-f]{6,}", "0x…", text).splitlines() if line.strip()]
    return "\n".join(lines[:LINES])


if __name__ == "__main__":
    print(json.dumps(provoke(json.load(sys.stdin))))
