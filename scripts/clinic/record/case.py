"""A case: its folder, read and validated, with every problem reported at once.

The stages, in order; each needs the one before, but for what is sound of a record with mistakes:

1. the folder: its name, its `case.yaml`, plain text files only (`folder.py`);
2. the YAML: parses, no key twice (`yaml_lines.py`);
3. the record: the fields' types and rules (`fields.py`, in words: `field_errors.py`);
4. the files: those the record names exist, nothing else lies in the folder; and the references: names used in checks,
   expressions and the run exist, ids are unique.

Edits are checked when variants are made, signal paths once a model is compiled, fields of prose when these are filled.
"""

from __future__ import annotations

import itertools
import json
import math
import re
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

import yaml
from pydantic import ValidationError

from clinic.record.claims import CLAIMS, Claims, read_claims
from clinic.record.closed_forms import MODEL_NUMBERS
from clinic.record.expression import ExpressionError, names, parse
from clinic.record.field_errors import field_problems
from clinic.record.fields import Record
from clinic.record.folder import INSTRUMENT, RECORD, folder_problems
from clinic.record.parts import WARNINGS
from clinic.record.problem import CaseError, Problem, article, closest, listed
from clinic.record.salvage import Salvage, salvage
from clinic.record.signal import ExpressionSignal, PathSignal, StartsSignal
from clinic.record.sweep import Prediction
from clinic.record.yaml_lines import Lines, Where, dotted, read_yaml, yaml_problem

SCALED = re.compile(r"(?:[mck]m|[mµ]s|[mk]N|g|deg|°)(?![A-Za-z])")
GENERATED_FILES = ("evidence.json", "playground.json")


@dataclass(frozen=True)
class Case:
    """A validated record with its folder.

    Args:
        slug: The folder's name: the case's id and URL.
        record: The validated `case.yaml`.
        texts: The files of the folder that the runs read, by name.
        lines: Where each field of the record stands, for error messages.
        claims: What shows each sentence of the record; None without a `claims.yaml`.
        claim_lines: Where each field of that stands.
    """

    slug: str
    record: Record
    texts: dict[str, str]
    lines: Lines
    claims: Claims | None = None
    claim_lines: Lines | None = None

    @property
    def text(self) -> str:
        """The broken model's or script's text."""
        return self.texts[self.record.source]

    @property
    def lacking(self) -> dict[str, str]:
        """What grade A asks for and the case is without, with what is not known for want of each."""
        return self.record.lacking | ({} if self.claims is not None else {CLAIMS: "what shows each of its sentences"})

    @property
    def rank(self) -> tuple[float, str]:
        """Its place among all: by number, those without one last."""
        return self.record.number or math.inf, self.slug

    @property
    def file(self) -> str:
        """The record's path as shown to the author."""
        return f"cases/{self.slug}/{RECORD}"

    def problem(self, where: Where, found: str, expected: str, repair: str, quoted: str = "") -> Problem:
        """A problem at the field `where` of this case's record, and there at the words `quoted`, if given."""
        line = self.lines.holding(where, quoted) if quoted else self.lines.at(where)
        return Problem(self.file, line, dotted(where), found, expected, repair)

    def claim_problem(self, where: Where, found: str, expected: str, repair: str) -> Problem:
        """A problem at the field `where` of this case's claims."""
        line = self.claim_lines.at(where) if self.claim_lines else 1
        return Problem(f"cases/{self.slug}/{CLAIMS}", line, dotted(where), found, expected, repair)


def load_case(folder: Path) -> Case:
    """Reads and validates one case.

    Raises:
        CaseError: With all problems of the record and its files.
    """
    reading = read_case(folder)
    if reading.case is None or reading.problems:
        raise CaseError(reading.problems)
    return reading.case


class Reading(NamedTuple):
    """A case as far as it can be read.

    Attributes:
        case: None if too little can be; else it has stand-ins for what is wrong with its record.
        problems: All that is wrong with the record and its files.
        salvage: The sound part of a record with mistakes.
    """

    case: Case | None
    problems: list[Problem]
    salvage: Salvage | None = None

    def own(self, problems: Iterable[Problem]) -> list[Problem]:
        """Those problems that are not of a stand-in."""
        return [*problems] if self.salvage is None else self.salvage.own(problems)


def read_case(folder: Path) -> Reading:
    """Reads one case, and goes on to its files and references when its record has mistakes."""
    if problems := list(folder_problems(folder)):
        return Reading(None, problems)
    texts = {path.name: path.read_text(encoding="utf-8") for path in sorted(folder.iterdir())}
    file, text = f"cases/{folder.name}/{RECORD}", texts.pop(RECORD)
    claimed = texts.pop(CLAIMS, None)
    part = None
    try:
        data, lines = read_yaml(text)
        record = Record.model_validate_json(json.dumps(data, default=str))
    except (yaml.MarkedYAMLError, yaml.reader.ReaderError) as error:
        return Reading(None, [yaml_problem(file, text, error)])
    except ValidationError as error:
        problems, part = list(field_problems(file, lines, error.errors(), data)), salvage(data, error.errors())
        if part is None:
            return Reading(None, problems)
        record = part.record
    case = Case(folder.name, record, texts, lines)
    if claimed is not None:
        claims, claim_lines, wrong = read_claims(f"cases/{folder.name}/{CLAIMS}", claimed)
        case, problems = replace(case, claims=claims, claim_lines=claim_lines), problems + wrong
    reading = Reading(case, problems, part)
    return reading._replace(problems=problems + reading.own([*_file_problems(case), *_reference_problems(case)]))


def read_cases(root: Path) -> tuple[list[Case], list[Problem]]:
    """The cases of `root` that can be read, sorted by number, and the problems of all, those between cases included."""
    cases: list[Case] = []
    problems: list[Problem] = []
    for path in sorted(root.iterdir()):
        try:
            cases.append(load_case(path))
        except CaseError as error:
            problems += error.problems
    problems += _relation_problems(cases, {path.name for path in root.iterdir()})
    return sorted(cases, key=lambda case: case.rank), problems


def _file_problems(case: Case) -> Iterator[Problem]:
    record = case.record
    named: dict[str, Where] = {record.source: ("model" if record.model else "script",)}
    named |= {name: ("files", index) for index, name in enumerate(record.files)}
    for name, where in named.items():
        if name not in case.texts:
            there = f"a file of the folder: {listed(case.texts)}"
            yield case.problem(where, f"{name}, which does not exist", there, "correct the name, or add the file")
        if name in GENERATED_FILES:
            expected = "a name that the site does not use itself"
            yield case.problem(where, f"{name}, which stands beside the page", expected, "rename the file")
    expected = f"{RECORD}, {CLAIMS} and the files that the record names: {listed(named)}"
    extra = {INSTRUMENT} if record.script else set()
    for name in case.texts.keys() - named.keys() - extra:
        found, repair = "a file that the record does not name", "name it under `files`, or delete it"
        yield Problem(f"cases/{case.slug}/{name}", 1, "", found, expected, repair)


def _reference_problems(case: Case) -> Iterator[Problem]:
    """Names that nothing bears, ids taken twice, and what is wrong with signals and sweeps."""
    record = case.record
    taken = ["broken"]
    for kind in ("fixes", "refuted"):
        for index, remedy in enumerate(getattr(record, kind)):
            if remedy.id in taken:
                found, expected = f"{remedy.id}, which is taken", "an id used once; not broken"
                yield case.problem((kind, index, "id"), found, expected, "rename it")
            taken.append(remedy.id)
    for kind in ("broken", "fixed"):
        for index, check in enumerate(getattr(record.checks, kind)):
            yield from _unknown(case, ("checks", kind, index, "signal"), [check.signal], record.signals, "signal")
        for k, trial in enumerate(record.trials):
            for index, check in enumerate(getattr(trial.checks, kind, None) or []):
                place: Where = ("trials", k, "checks", kind, index, "signal")
                yield from _unknown(case, place, [check.signal], record.signals, "signal")
    for index, name in enumerate(record.warnings):
        yield from _unknown(case, ("warnings", index), [name], WARNINGS, "MuJoCo warning")
    if record.picture.scene is not None:
        yield from _unknown(case, ("picture", "scene"), [record.picture.scene], list(case.texts), "file")
    for joint, shown in record.picture.shows.items():
        yield from _unknown(case, ("picture", "shows", joint), [shown], record.signals, "signal")
    yield from _signal_problems(case)
    yield from _sweep_problems(case, taken)


def _signal_problems(case: Case) -> Iterator[Problem]:
    """Names that no signal bears where one is computed from others, units that the numbers do not have."""
    signals = case.record.signals
    paths = [name for name, signal in signals.items() if isinstance(signal, PathSignal)]
    for name, signal in signals.items():
        if isinstance(signal, StartsSignal):
            place = ("signals", name, "holds", "signal")
            yield from _unknown(case, place, [signal.holds.signal], paths, "path signal")
        if isinstance(signal, ExpressionSignal):
            yield from _misread(case, ("signals", name, "expr"), signal.expr, paths, "path signal")
        computed = isinstance(signal, PathSignal) and not signal.path.startswith(("printed(", "model."))
        if computed and SCALED.match(signal.unit):
            expected = "the unit that MuJoCo computes in, such as m, rad, s, kg, N"
            repair = "write it; convert in prose, `{{ broken.x.final | mm }}`, or by `expr`"
            yield case.problem(("signals", name, "unit"), signal.unit, expected, repair)


def _sweep_problems(case: Case, variants: list[str]) -> Iterator[Problem]:
    """Names that nothing bears in what a sweep varies, measures and predicts."""
    record = case.record
    numbers = [key for key, s in record.signals.items() if isinstance(s, PathSignal | ExpressionSignal)]
    for name, sweep in record.sweep.items():
        place: Where = ("sweep", name, "outcome", "signal")
        yield from _unknown(case, place, [sweep.outcome.signal], record.signals, "signal")
        yield from _unknown(case, ("sweep", name, "base"), [sweep.base], variants, "variant")
        known = [*(parameter.name for parameter in sweep.vary), *numbers, *MODEL_NUMBERS]
        forms: dict[Where, Prediction] = {("prediction",): sweep.prediction}
        forms |= {("rivals", index): rival for index, rival in enumerate(sweep.rivals)}
        for where, form in forms.items():
            place = ("sweep", name, *where, "expr")
            yield from _misread(case, place, form.expr, known, "name that a prediction can read")


def _misread(case: Case, where: Where, expr: str, known: Iterable[str], kind: str) -> Iterator[Problem]:
    """What is wrong with arithmetic over known names."""
    try:
        yield from _unknown(case, where, sorted(names(parse(expr))), known, kind)
    except ExpressionError as error:
        yield case.problem(where, expr, str(error), "write plain arithmetic")


def _unknown(case: Case, where: Where, words: Iterable[str], known: Iterable[str], kind: str) -> Iterator[Problem]:
    """A problem for every word that is none of those known."""
    known = list(known)
    for word in words:
        if word not in known:
            guess = closest(word, known)
            repair = f"write {guess}" if guess else "correct the name"
            yield case.problem(where, f"{word}, which is no {kind}", f"{article(kind)}: {listed(known, 30)}", repair)


def _relation_problems(cases: list[Case], slugs: set[str]) -> Iterator[Problem]:
    """Numbers taken twice, relatives that do not exist, and tags that misspell another."""
    users: dict[int, list[str]] = defaultdict(list)
    for case in cases:
        if case.record.number is not None:
            users[case.record.number].append(case.slug)
    free = next(n for n in itertools.count(1) if n not in users)
    tags = Counter(tag for case in cases for tag in case.record.tags)
    shared = sorted(tag for tag, count in tags.items() if count > 1)
    for case in cases:
        number, others = case.record.number, sorted(slugs - {case.slug})
        if number and (same := [slug for slug in users[number] if slug != case.slug]):
            found, repair = f"{number}, the number of {listed(same)}", f"let the newer take {free}"
            yield case.problem(("number",), found, "a number of its own", repair)
        for index, slug in enumerate(case.record.see):
            yield from _unknown(case, ("see", index), [slug], others, "case besides this one")
        for index, tag in enumerate(case.record.tags):
            if tags[tag] == 1 and (guess := closest(tag, shared, likeness=0.8)):
                found, expected = f"{tag}, which no other case has", f"a topic: {listed(shared, 30)}, or a new one"
                yield case.problem(("tags", index), found, expected, f"write {guess}")
