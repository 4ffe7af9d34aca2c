"""A case: its folder, read and validated, with every problem reported at once.

The stages, in order; each needs the one before:

1. the folder: its name, its `case.yaml`, plain files only (`folder.py`);
2. the YAML: parses, no aliases, no key twice;
3. the record: the fields' types and rules (`record.py`);
4. the files: the model or script and `files` exist, nothing else lies in the folder;
5. the references: names used in checks, expressions and the run exist, ids are unique;
6. the words: what the page would not show as it stands (`wording.py`).

What needs the compiled model (edits, signal paths) is checked in `variant.py` and `signals.py`.
"""

from __future__ import annotations

import itertools
import json
import re
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from pydantic import ValidationError

from clinic.record.expression import ExpressionError, names, parse
from clinic.record.field_errors import field_problems
from clinic.record.fields import Check, ExpressionSignal, PathSignal, Record, StartsSignal
from clinic.record.folder import RECORD, folder_problems
from clinic.record.parts import WARNINGS
from clinic.record.predictions import MODEL_NUMBERS
from clinic.record.problem import CaseError, Problem, article, closest, listed
from clinic.record.wording import word_problems
from clinic.record.yaml_lines import Lines, Where, YamlError, dotted, read_yaml

SCALED = re.compile(r"(?:[mck]m|[mµ]s|[mk]N|g|deg|°)(?![A-Za-z])")
MOST_POINTS = 1000
MOST_POINTS_OF_A_SCRIPT = 200
LIKE = 0.8
PUBLISHED = (RECORD, "evidence.json", "playground.json")


@dataclass(frozen=True)
class Case:
    """A validated record with its folder.

    Args:
        slug: The folder's name: the case's id and URL.
        record: The validated `case.yaml`.
        texts: Every other file of the folder, by name.
        lines: Where each field of the record stands, for error messages.
    """

    slug: str
    record: Record
    texts: dict[str, str]
    lines: Lines

    @property
    def text(self) -> str:
        """The broken model's or script's text."""
        return self.texts[self.record.source]

    @property
    def file(self) -> str:
        """The record's path as shown to the author."""
        return f"cases/{self.slug}/{RECORD}"

    def problem(self, where: Where, found: str, expected: str, repair: str, quoted: str = "") -> Problem:
        """A problem at the field `where` of this case's record, and there at the words `quoted`, if given."""
        line = self.lines.holding(where, quoted) if quoted else self.lines.at(where)
        return Problem(self.file, line, dotted(where), found, expected, repair)


def load_case(folder: Path) -> Case:
    """Reads and validates one case.

    Raises:
        CaseError: With all problems found by the first stage that found any.
    """
    if problems := list(folder_problems(folder)):
        raise CaseError(problems)
    texts = {path.name: path.read_text(encoding="utf-8") for path in sorted(folder.iterdir())}
    return _validated(folder.name, texts.pop(RECORD), tuple(texts.items()))


@lru_cache(2048)
def _validated(slug: str, text: str, texts: tuple[tuple[str, str], ...]) -> Case:
    """The case of a folder with these texts: a served site reads every case at every save."""
    file = f"cases/{slug}/{RECORD}"
    try:
        data, lines = read_yaml(text)
    except YamlError as error:
        raise CaseError([Problem(file, error.line, "", error.found, error.expected, error.repair)]) from None
    try:
        record = Record.model_validate_json(json.dumps(data, default=str))
    except ValidationError as error:
        raise CaseError(field_problems(file, lines, error.errors(), data)) from None
    case = Case(slug, record, dict(texts), lines)
    words = (case.problem(*told, quoted=told[1]) for told in word_problems(record))
    if problems := [*_file_problems(case), *_reference_problems(case), *words]:
        raise CaseError(problems)
    return case


def load_cases(root: Path) -> list[Case]:
    """Reads every folder of `root`, sorted by number.

    Raises:
        CaseError: With the problems of all cases, and those between cases.
    """
    cases, problems = read_cases(root)
    if problems:
        raise CaseError(problems)
    return cases


def read_cases(root: Path) -> tuple[list[Case], list[Problem]]:
    """The cases of `root` that can be read, sorted by number, and the problems of all, those between cases included."""
    cases: list[Case] = []
    problems: list[Problem] = []
    for path in sorted(root.iterdir()):
        if not path.is_dir():
            problems.append(
                Problem(
                    f"cases/{path.name}", 1, "", "a file", "only folders, one a case", "move it into a case's folder"
                )
            )
            continue
        try:
            cases.append(load_case(path))
        except CaseError as error:
            problems += error.problems
    problems += _relation_problems(cases, {path.name for path in root.iterdir()})
    return sorted(cases, key=lambda case: case.record.number), problems


def _file_problems(case: Case) -> Iterator[Problem]:
    record = case.record
    named: dict[str, Where] = {record.source: ("model" if record.model else "script",)}
    named |= {name: ("files", index) for index, name in enumerate(record.files)}
    for name, where in named.items():
        if name not in case.texts:
            there = f"a file of the folder: {listed(case.texts)}"
            yield case.problem(where, f"{name}, which does not exist", there, "correct the name, or add the file")
    for index, name in enumerate(record.files):
        if name in PUBLISHED:
            expected = "a name that the site does not use itself"
            yield case.problem(("files", index), f"{name}, which stands beside the page", expected, "rename the file")
    for name in case.texts.keys() - named.keys():
        yield Problem(
            f"cases/{case.slug}/{name}",
            1,
            "",
            "a file that the record does not name",
            f"{RECORD} and the files it names: {listed(named)}",
            "name it under `files`, or delete it",
        )


def _reference_problems(case: Case) -> Iterator[Problem]:
    record = case.record
    for where, check in checks_of(record):
        if check.signal not in record.signals:
            yield case.problem((*where, "signal"), *_unknown(check.signal, record.signals, "signal"))
    paths = [name for name, signal in record.signals.items() if isinstance(signal, PathSignal)]
    for name, signal in record.signals.items():
        scaled = isinstance(signal, PathSignal) and not signal.path.startswith(("printed(", "model."))
        if scaled and SCALED.match(signal.unit):
            told = "the unit that MuJoCo computes in, such as m, rad, s, kg, N"
            repair = "write it; convert in prose, `{{ broken.x.final | mm }}`, or by `expr`"
            yield case.problem(("signals", name, "unit"), signal.unit, told, repair)
        if isinstance(signal, StartsSignal) and signal.holds.signal in record.signals.keys() - set(paths):
            yield case.problem(
                ("signals", name, "holds", "signal"), *_unknown(signal.holds.signal, paths, "path signal")
            )
        if isinstance(signal, ExpressionSignal):
            try:
                unknown = sorted(names(parse(signal.expr)) - set(paths))
            except ExpressionError as error:
                yield case.problem(("signals", name, "expr"), signal.expr, str(error), "write plain arithmetic")
                continue
            for word in unknown:
                yield case.problem(("signals", name, "expr"), *_unknown(word, paths, "path signal"))
    yield from _sweep_problems(case)
    seen = {"broken"}
    for kind, remedies in (("fixes", record.fixes), ("refuted", record.refuted)):
        for index, remedy in enumerate(remedies):
            if remedy.id in seen:
                yield case.problem(
                    (kind, index, "id"), f"{remedy.id}, which is taken", "an id used once; not broken", "rename it"
                )
            seen.add(remedy.id)
    for index, name in enumerate(record.warnings):
        if name not in WARNINGS:
            yield case.problem(("warnings", index), *_unknown(name, WARNINGS, "MuJoCo warning"))
    if record.picture.scene is not None and record.picture.scene not in case.texts:
        yield case.problem(("picture", "scene"), *_unknown(record.picture.scene, case.texts, "file"))


def _sweep_problems(case: Case) -> Iterator[Problem]:
    record = case.record
    variants = ["broken", *(remedy.id for remedy in [*record.fixes, *record.refuted])]
    points, most = 0, MOST_POINTS if record.model else MOST_POINTS_OF_A_SCRIPT
    for name, sweep in record.sweep.items():
        where: Where = ("sweep", name)
        before, points = points, points + sweep.size
        if before <= most < points:
            kind = "of a model" if record.model else "of a script, which runs as a process at each"
            found = f"{points} points" + (f", with {before} of the sweeps before" if before else "")
            expected, repair = f"{most} points at most in all sweeps {kind}", "take fewer numbers, further apart"
            yield case.problem((*where, "vary"), found, expected, repair)
        if sweep.outcome.signal not in record.signals:
            yield case.problem((*where, "outcome", "signal"), *_unknown(sweep.outcome.signal, record.signals, "signal"))
        if sweep.base not in variants:
            yield case.problem((*where, "base"), *_unknown(sweep.base, variants, "variant"))
        single = [key for key, s in record.signals.items() if isinstance(s, PathSignal | ExpressionSignal)]
        known = [*(parameter.name for parameter in sweep.vary), *single, *MODEL_NUMBERS]
        places: list[tuple[Where, str]] = [(("prediction", "expr"), sweep.prediction.expr)]
        places += [(("rivals", index, "expr"), rival.expr) for index, rival in enumerate(sweep.rivals)]
        for place, expr in places:
            try:
                unknown = sorted(names(parse(expr)) - set(known))
            except ExpressionError as error:
                yield case.problem((*where, *place), expr, str(error), "write plain arithmetic")
                continue
            for word in unknown:
                yield case.problem((*where, *place), *_unknown(word, known, "name that a prediction can read"))


def checks_of(record: Record) -> Iterator[tuple[Where, Check]]:
    """Every check of the record with its path, the ones inside signals included."""
    for kind in ("broken", "fixed"):
        for index, check in enumerate(getattr(record.checks, kind)):
            yield ("checks", kind, index), check
    for index, trial in enumerate(record.trials):
        for kind in ("broken", "fixed"):
            for k, check in enumerate(getattr(trial.checks, kind, None) or []):
                yield ("trials", index, "checks", kind, k), check
    for name, signal in record.signals.items():
        if isinstance(signal, StartsSignal):
            yield ("signals", name, "holds"), signal.holds


def _unknown(word: str, known: Iterable[str], kind: str) -> tuple[str, str, str]:
    known = list(known)
    guess = closest(word, known)
    return (
        f"{word}, which is no {kind}",
        f"{article(kind)}: {listed(known, 30)}",
        f"write {guess}" if guess else "correct the name",
    )


def _relation_problems(cases: list[Case], slugs: set[str]) -> Iterator[Problem]:
    yield from _tag_problems(cases)
    users: dict[int, list[str]] = defaultdict(list)
    for case in cases:
        users[case.record.number].append(case.slug)
    free = next(n for n in itertools.count(1) if n not in users)
    for case in cases:
        number = case.record.number
        if others := [slug for slug in users[number] if slug != case.slug]:
            found, repair = f"{number}, the number of {listed(others)}", f"let the newer take {free}"
            yield case.problem(("number",), found, "a number of its own", repair)
        for index, slug in enumerate(case.record.see):
            if slug == case.slug or slug not in slugs:
                others = sorted(slugs - {case.slug})
                this = (f"{slug}, this very case", f"a case: {listed(others, 30)}", "remove it")
                yield case.problem(("see", index), *(this if slug == case.slug else _unknown(slug, others, "case")))


def _tag_problems(cases: list[Case]) -> Iterator[Problem]:
    """Any word is a tag, but one that a single case has is no misspelling of one that several have."""
    users = Counter(tag for case in cases for tag in case.record.tags)
    shared = [tag for tag, count in users.items() if count > 1]
    for case in cases:
        for index, tag in enumerate(case.record.tags):
            if users[tag] == 1 and (guess := closest(tag, shared, LIKE)):
                found, wanted = (
                    f"{tag}, which no other case has",
                    f"a topic: {listed(sorted(shared), 30)}, or a new one",
                )
                yield case.problem(("tags", index), found, wanted, f"write {guess}")
