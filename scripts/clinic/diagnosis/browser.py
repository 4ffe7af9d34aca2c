"""The engine of a page: MuJoCo's JavaScript binding, seen from Pyodide."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

from clinic.diagnosis.engine import Compiled, CompileError, Contact


class BrowserModel:
    """A compiled model; `js` is a `CompiledModel` of docs/playground/diagnosis/engine.js."""

    def __init__(self, js: Any, to_js: Any) -> None:
        self.js, self.to_js = js, to_js

    def count(self, kind: str) -> int:
        return int(self.js.count(kind))

    def name(self, kind: str, index: int) -> str:
        return str(self.js.name(kind, index))

    def model(self, field: str) -> Sequence[float]:
        return _numbers(self.js.field("model", field))

    def data(self, field: str) -> Sequence[float]:
        return _numbers(self.js.field("data", field))

    def write(self, field: str, values: Sequence[float], start: int = 0) -> None:
        self.js.write("data", field, self.to_js([float(value) for value in values]), start)

    def write_model(self, field: str, values: Sequence[float], start: int = 0) -> None:
        self.js.write("model", field, self.to_js([float(value) for value in values]), start)

    def reset(self, key: int = -1) -> None:
        self.js.reset(key)

    def forward(self) -> None:
        self.js.forward()

    def step(self, count: int = 1) -> None:
        self.js.step(count)

    def contacts(self) -> list[Contact]:
        made = []
        for one, two, distance, x, y, z, nx, ny, nz, force in self.js.contacts().to_py():
            made.append(Contact((int(one), int(two)), distance, (x, y, z), (nx, ny, nz), force))
        return made

    def mass_diagonal(self) -> list[float]:
        return [float(number) for number in self.js.mass_diagonal().to_py()]

    def warnings(self) -> dict[str, int]:
        return {str(name): int(number) for name, number in self.js.warnings().to_py()}


class BrowserEngine:
    """The page's engine; `js` is a `DiagnosisEngine`, `to_js` Pyodide's."""

    def __init__(self, js: Any, to_js: Any) -> None:
        self.js, self.to_js, self.version = js, to_js, str(js.version)

    def compile(self, main: str, files: Mapping[str, str]) -> Compiled:
        try:
            return BrowserModel(
                self.js.compile(main, self.to_js([[name, text] for name, text in files.items()])), self.to_js
            )
        except Exception as error:
            if type(error).__name__ != "JsException":
                raise
            said = re.sub(r"^Error: (?:MuJoCo Error: )?(?:Loading error: )?", "", str(error))
            raise CompileError(said) from None


def _numbers(value: Any) -> Sequence[float]:
    if isinstance(value, (int, float)):
        return [float(value)]
    read = value.to_py()
    return read.tolist() if hasattr(read, "tolist") else [float(number) for number in read]
