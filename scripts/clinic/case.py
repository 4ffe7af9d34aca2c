"""A case: its folder, read and validated, with every problem reported at once.

The stages, in order; each needs the one before:

1. the folder: its name, its `case.yaml`, plain files only;
2. the YAML: parses, no aliases, no key twice;
3. the record: the fields' types and rules (`record.py`);
4. the files: the model or script and `files` exist, nothing else lies in the folder;
5. the references: names used in checks, expressions and the run exist, ids are unique.

What needs the compiled model (edits, signal paths) is checked in `variant.py` and `signals.py`.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from clinic import record as schema
from clinic.expression import ExpressionError, names, parse
from clinic.problem import CaseError, Problem, closest, listed
from clinic.record import Check, ExpressionSignal, PathSignal, Record, StartsSignal
from clinic.signals import WARNINGS
from clinic.yamlmap import Lines, Where, YamlProblem, read_yaml

RECORD = "case.yaml"
SLUG = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*")
SIGNALS: dict[str, type[BaseModel]] = {
    "path": schema.PathSignal,
    "expr": schema.ExpressionSignal,
    "fraction_of_starts": schema.StartsSignal,
    "image_row": schema.RowSignal,
}
MODELS: dict[str | int, type[BaseModel]] = {
    "run": schema.RunSpec,
    "checks": schema.Checks,
    "broken": schema.Check,
    "fixed": schema.Check,
    "holds": schema.Check,
    "fixes": schema.Fix,
    "refuted": schema.Refuted,
    "edits": schema.Edit,
    "picture": schema.Picture,
}
PATTERNS = {
    "^[a-z][a-z0-9]*(?:-[a-z0-9]+)*$": "lower-case words joined by hyphens",
    "^[a-z][a-z0-9_]*$": "a lower-case word; underscores allowed",
    "^[A-Za-z0-9_-]+\\.[a-z]+$": "a plain file name with an ending",
}


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

    def problem(self, where: Where, found: str, expected: str, repair: str) -> Problem:
        """A problem at the field `where` of this case's record."""
        return Problem(self.file, self.lines.at(where), dotted(where), found, expected, repair)


def dotted(where: Where) -> str:
    """`("fixes", 0, "id")` as `fixes[0].id`."""
    text = ""
    for part in where:
        text += f"[{part}]" if isinstance(part, int) else f".{part}" if text else part
    return text


def load_case(folder: Path) -> Case:
    """Reads and validates one case.

    Raises:
        CaseError: With all problems found by the first stage that found any.
    """
    slug, file = folder.name, f"cases/{folder.name}/{RECORD}"
    if problems := list(_folder_problems(folder)):
        raise CaseError(problems)
    try:
        data, lines = read_yaml((folder / RECORD).read_text(encoding="utf-8"))
    except YamlProblem as error:
        raise CaseError([Problem(file, error.line, "", error.found, error.expected, error.repair)]) from None
    try:
        record = Record.model_validate_json(json.dumps(data, default=str))
    except ValidationError as error:
        raise CaseError(_field_problems(file, lines, error.errors(), data)) from None
    texts = {
        path.name: path.read_text(encoding="utf-8") for path in sorted(folder.iterdir()) if path.name != RECORD
    }
    case = Case(slug, record, texts, lines)
    if problems := [*_file_problems(case), *_reference_problems(case)]:
        raise CaseError(problems)
    return case


def load_cases(root: Path) -> list[Case]:
    """Reads every folder of `root`, sorted by number.

    Raises:
        CaseError: With the problems of all cases, and those between cases.
    """
    cases: list[Case] = []
    problems: list[Problem] = []
    for path in sorted(root.iterdir()):
        if not path.is_dir():
            problems.append(
                Problem(f"cases/{path.name}", 1, "", "a file", "only folders, one a case", "move it into a case's folder")
            )
            continue
        try:
            cases.append(load_case(path))
        except CaseError as error:
            problems += error.problems
    problems += _relation_problems(cases, {path.name for path in root.iterdir()})
    if problems:
        raise CaseError(problems)
    return sorted(cases, key=lambda case: case.record.number)


def _folder_problems(folder: Path) -> Iterator[Problem]:
    place = f"cases/{folder.name}"
    if not SLUG.fullmatch(folder.name):
        yield Problem(
            place, 1, "", f"a folder named {folder.name}", "lower-case words joined by hyphens", "rename the folder"
        )
    if not (folder / RECORD).is_file():
        yield Problem(place, 1, "", f"no {RECORD}", f"a {RECORD} in every folder of cases/", "add it, or remove the folder")
    for path in sorted(folder.iterdir()):
        if path.is_symlink() or not path.is_file():
            kind = "a symbolic link" if path.is_symlink() else "a folder"
            yield Problem(f"{place}/{path.name}", 1, "", kind, "plain files", "put the file itself into the case's folder")
            continue
        try:
            path.read_text(encoding="utf-8")
        except UnicodeDecodeError:
            yield Problem(
                f"{place}/{path.name}", 1, "", "bytes that are not UTF-8", "text in UTF-8", "save the file as UTF-8"
            )


def _field_problems(file: str, lines: Lines, errors: Sequence[ErrorDetails], data: Any) -> Iterator[Problem]:
    seen: set[Where] = set()
    for error in errors:
        where, tag = _where(error["loc"], data)
        if error["type"] == "missing":
            where = (*where, error["loc"][-1])
        if where in seen:
            continue
        seen.add(where)
        found, expected, repair = _explained(error, where, tag)
        yield Problem(file, lines.at(where), dotted(where), found, expected, repair)


def _where(loc: Where, data: Any) -> tuple[Where, str]:
    """The part of pydantic's location that stands in the file, and the last part that does not."""
    where: Where = ()
    tag = ""
    for part in loc:
        if (isinstance(data, dict) and part in data) or (isinstance(data, list) and isinstance(part, int)):
            data, where = data[part], (*where, part)  # type: ignore[index]
        else:
            tag = str(part)
    return where, tag


def _explained(error: ErrorDetails, where: Where, tag: str) -> tuple[str, str, str]:
    message = str(error.get("ctx", {}).get("error", error["msg"]))
    match error["type"]:
        case "value_error" if message.count("||") == 2:
            found, expected, repair = message.split("||")
            return found, expected, repair
        case "extra_forbidden":
            known = list(_model_at(where[:-1], tag).model_fields)
            guess = closest(str(where[-1]), known)
            repair = f"write `{guess}`" if guess else "remove the key"
            return f"the unknown key `{where[-1]}`", f"one of {listed(known, 30)}", repair
        case "missing":
            return "nothing", f"the field `{where[-1]}`", f"add `{where[-1]}:`"
        case "union_tag_not_found" | "union_tag_invalid":
            return (
                _shown(error["input"]),
                "one of `path`, `expr`, `measure: fraction_of_starts`, `measure: image_row`",
                "say where the number comes from",
            )
        case "string_pattern_mismatch":
            return _shown(error["input"]), PATTERNS[error["ctx"]["pattern"]], "rename it"
    if where[:2] == ("run", "ctrl"):
        message = "a number, or a list of [time, value] pairs"
    return _shown(error["input"]), message[0].lower() + message[1:], "correct the value"


def _model_at(where: Where, tag: str) -> type[BaseModel]:
    """The class of the mapping at `where`."""
    if len(where) == 2 and where[0] == "signals":
        return SIGNALS[tag]
    for part in reversed(where):
        if part in MODELS:
            return MODELS[part]
    return Record


def _shown(value: Any) -> str:
    text = json.dumps(value, default=str, ensure_ascii=False)
    return text if len(text) <= 60 else text[:57] + "..."


def _file_problems(case: Case) -> Iterator[Problem]:
    record = case.record
    named = {record.source: ("model" if record.model else "script",)}
    named |= {name: ("files", index) for index, name in enumerate(record.files)}
    for name, where in named.items():
        if name not in case.texts:
            there = f"a file of the folder: {listed(case.texts)}"
            yield case.problem(where, f"{name}, which does not exist", there, "correct the name, or add the file")
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
        if isinstance(signal, ExpressionSignal):
            try:
                unknown = sorted(names(parse(signal.expr)) - set(paths))
            except ExpressionError as error:
                yield case.problem(("signals", name, "expr"), signal.expr, str(error), "write plain arithmetic")
                continue
            for word in unknown:
                yield case.problem(("signals", name, "expr"), *_unknown(word, paths, "path signal"))
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


def checks_of(record: Record) -> Iterator[tuple[Where, Check]]:
    """Every check of the record with its path, the ones inside signals included."""
    for kind in ("broken", "fixed"):
        for index, check in enumerate(getattr(record.checks, kind)):
            yield ("checks", kind, index), check
    for name, signal in record.signals.items():
        if isinstance(signal, StartsSignal):
            yield ("signals", name, "holds"), signal.holds


def _unknown(word: str, known: Iterable[str], kind: str) -> tuple[str, str, str]:
    known = list(known)
    guess = closest(word, known)
    return f"{word}, which is no {kind}", f"a {kind}: {listed(known, 30)}", f"write {guess}" if guess else "correct the name"


def _relation_problems(cases: list[Case], slugs: set[str]) -> Iterator[Problem]:
    numbers: dict[int, str] = {}
    for case in cases:
        number = case.record.number
        if number in numbers:
            free = next(n for n in range(1, 10_000) if n not in {c.record.number for c in cases})
            yield case.problem(
                ("number",), f"{number}, the number of {numbers[number]}", "a number of its own", f"take {free}"
            )
        numbers.setdefault(number, case.slug)
        for index, slug in enumerate(case.record.see):
            if slug not in slugs or slug == case.slug:
                yield case.problem(("see", index), *_unknown(slug, sorted(slugs - {case.slug}), "other case"))
