"""The engine of a page: MuJoCo's JavaScript binding, seen from Pyodide."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

from clinic.diagnosis.diagnose import examine, in_turn
from clinic.diagnosis.edit import apply
from clinic.diagnosis.engine import Compiled, CompileError, Contact
from clinic.diagnosis.finding import ending
from clinic.diagnosis.rules import rules
from clinic.diagnosis.texts import read_texts

FATAL = ("RuntimeError", "RangeError")  # JavaScript's, after which the module cannot be trusted


class BrowserModel:
    """A compiled model; `js` is a `CompiledModel` of docs/playground/diagnosis/engine.js."""

    def __init__(self, js: Any, to_js: Any) -> None:
        self.js, self.to_js, self.out_of_memory = js, to_js, False

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
        self.out_of_memory = False
        self.js.reset(key)

    def forward(self) -> None:
        with self._bounded():
            self.js.forward()

    def step(self, count: int = 1) -> None:
        with self._bounded():
            self.js.step(count)

    @contextmanager
    def _bounded(self) -> Iterator[None]:
        """Where MuJoCo's memory does not hold what a step needs, the run is over, and ends in a warning."""
        try:
            yield
        except Exception as error:
            if type(error).__name__ != "JsException" or "MuJoCo Error" not in str(error):
                raise
            self.out_of_memory = True

    def contacts(self) -> list[Contact]:
        made = []
        for one, two, distance, x, y, z, nx, ny, nz, force in self.js.contacts().to_py():
            made.append(Contact((int(one), int(two)), distance, (x, y, z), (nx, ny, nz), force))
        return made

    def mass_diagonal(self) -> list[float]:
        return [float(number) for number in self.js.mass_diagonal().to_py()]

    def warnings(self) -> dict[str, int]:
        over = {"CNSTRFULL": 1, "BADQACC": 1} if self.out_of_memory else {}
        return over | {str(name): int(number) for name, number in self.js.warnings().to_py()}


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
            if type(error).__name__ != "JsException" or getattr(error, "name", "") in FATAL:
                raise
            said = re.sub(r"^Error: (?:MuJoCo Error: )?(?:Loading error: )?", "", str(error))
            raise CompileError(said) from None


def diagnose(
    engine: BrowserEngine,
    text: str,
    name: str,
    read: Callable[[str], str | None],
    tell: Callable[[str, str, float], None],
    symptom: str = "",
    died: Mapping[str, str] | None = None,
) -> str:
    """Diagnoses a model, and gives what the page shows as JSON: the public contract, and what is made of it.

    Args:
        engine: What compiles and runs it.
        text: The model.
        name: What to call it.
        read: Gives the text of a file by its path from the model's folder; None where there is none.
        tell: Is called before a rule is tried: its id, its title, and which share of the rules is done.
        symptom: The family of symptoms that the reader sees.
        died: Rules that failed before, each with the clinic's own mistake, or nothing where the engine ended.
    """

    turns = {ill: in_turn(each for each in rules().values() if each.of_errors == ill) for ill in (True, False)}

    def trying(said: str) -> None:
        if rule := rules().get(said):
            alike = turns[rule.of_errors]
            tell(rule.id, rule.title, alike.index(rule) / len(alike))

    texts = read_texts(text, name, read)
    made = ending(examine(engine, texts, symptom=symptom, ignore=died or (), tell=trying), died or {}, name)

    def changed(after: Mapping[str, str]) -> dict[str, str]:
        return {file: new for file, new in after.items() if new != texts[file]}

    shown = {
        "data": made.data(),
        "text": made.text(),
        "diff": made.diff(),
        "texts": texts,
        "mended": changed(made.fixed),
        "edited": [changed(apply(texts, each.edit)) for each in (*made.causes, *made.hints)],
        "titles": {rule.id: rule.title for rule in rules().values()},
    }
    return json.dumps(shown)


def _numbers(value: Any) -> Sequence[float]:
    if isinstance(value, (int, float)):
        return [float(value)]
    read = value.to_py()
    return read.tolist() if hasattr(read, "tolist") else [float(number) for number in read]
