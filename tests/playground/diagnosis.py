"""Diagnoses the models in the JSON file named as the argument, texts by name, in this process's MuJoCo; prints JSON."""

from __future__ import annotations

import json
import os
import sys
import tempfile
from pathlib import Path

from clinic.diagnosis.diagnose import examine
from clinic.diagnosis.native import NativeEngine

models = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
with tempfile.TemporaryDirectory() as folder:
    alone = Path(folder, "around", "model")  # a rule looks for files around it
    alone.mkdir(parents=True)
    os.chdir(alone)
    found = {name: examine(NativeEngine(), {"model.xml": text}).data() for name, text in models.items()}
    os.chdir("/")
print(json.dumps(found))
