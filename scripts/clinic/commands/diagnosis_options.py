"""What `clinic diagnose`, `clinic rules` and `clinic explain` read and print."""

from __future__ import annotations

import csv
import math
import sys
import zipfile
from collections.abc import Collection, Iterable, Mapping, Sequence
from pathlib import Path

from clinic.diagnosis.ignores import unknown
from clinic.diagnosis.rules import Rule, rules
from clinic.diagnosis.start import Start
from clinic.diagnosis.texts import decoded
from clinic.record.families import families, family_shares, likely_families

STDIN = "-"
DOUBT = 0.05  # the likelihood from which on another symptom is named beside the first


class OptionError(ValueError):
    """An option that cannot be taken, in a sentence."""


def start_of(keyframe: str | None, ctrl: Iterable[str], duration: float, seed: int) -> Start | None:
    """How the run begins, from the command's options; None where none is given.

    Raises:
        OptionError: If one cannot be taken.
    """
    single: dict[str, float] = {}
    series: list[tuple[float, Mapping[str, float]]] = []
    for each in ctrl:
        name, equals, value = each.partition("=")
        if equals:
            single[name] = _number(value, f"--ctrl {each}")
        else:
            series += _series(Path(each))
    if not math.isfinite(duration):
        raise OptionError(f"--duration {duration}: expected a time in s")
    start = Start(-1, single, tuple(sorted(series, key=lambda row: row[0])), duration, seed, keyframe or "")
    return None if start == Start() else start


def _number(value: object, said: str) -> float:
    try:
        number = float(str(value))
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise OptionError(f"{said}: {str(value or '')!r} is not a number")
    return number


def _series(path: Path) -> list[tuple[float, Mapping[str, float]]]:
    """Controls by time: a CSV or NPZ with a column `time` and one for each actuator."""
    said = f"--ctrl {path}"
    try:
        columns = _arrays(path) if path.suffix == ".npz" else _columns(path)
    except OSError as error:
        raise OptionError(f"{said}: {error.strerror or error}; expected name=value, a CSV or NPZ") from None
    except (ValueError, csv.Error, zipfile.BadZipFile) as error:
        found = "not a text in UTF-8" if isinstance(error, UnicodeDecodeError) else error
        raise OptionError(f"{said}: {found}; expected name=value, a CSV or NPZ") from None
    length = len(columns.get("time", ()))
    if len(columns) < 2 or not length:
        found = ", ".join(columns) or "none"
        raise OptionError(
            f"{said}: expected rows with a column `time`, in s, and one for each actuator; columns: {found}"
        )
    for name, column in columns.items():
        if len(column) != length:
            raise OptionError(f"{said}: {name} has {len(column)} values, time has {length}")
    numbers = {
        name: [_number(value, f"{said}, row {i}, {name}") for i, value in enumerate(column, 1)]
        for name, column in columns.items()
    }
    times = numbers.pop("time")
    return [(time, {name: column[i] for name, column in numbers.items()}) for i, time in enumerate(times)]


def _columns(path: Path) -> Mapping[str, Sequence[object]]:
    with path.open(newline="", encoding="utf-8-sig") as file:
        rows = list(csv.DictReader(file, restkey="beyond the last column", skipinitialspace=True))
    names = dict.fromkeys(name for row in rows for name in row)
    return {name.strip(): [row.get(name, 0) for row in rows] for name in names}


def _arrays(path: Path) -> Mapping[str, Sequence[object]]:
    import numpy as np

    with path.open("rb") as file:
        if not zipfile.is_zipfile(file):
            raise ValueError("not an NPZ")
        arrays = np.load(file)
        return {name: np.atleast_1d(arrays[name]).tolist() for name in arrays}


def read_source(model: str) -> str:
    """What is diagnosed: a path as it is, or what standard input holds.

    Raises:
        OptionError: If that is no XML.
    """
    if model != STDIN:
        return model
    try:
        text, _ = decoded(sys.stdin.buffer.read())
    except ValueError:
        raise OptionError("standard input: not a text in UTF-8") from None
    if not text.lstrip().startswith("<"):
        raise OptionError("standard input: no XML")
    return text


def family_of(symptom: str) -> tuple[str, list[str]]:
    """The family that a symptom names, or that its words speak of, and others that they may; empty for an empty one.

    Raises:
        OptionError: If there is none.
    """
    if not symptom or symptom in families():
        return symptom, []
    found = [name for name, share in family_shares(symptom).items() if share >= DOUBT]
    if not likely_families(symptom):
        raise OptionError(
            f"--symptom {symptom}: expected one of {', '.join(families())}, or what you see in your words"
        )
    return found[0], found[1:3]


def chosen_rules(select: Collection[str], ignore: Collection[str]) -> tuple[list[str], list[str]]:
    """The rules that are selected, and those that are not to be looked at; several may stand with commas in between.

    Raises:
        OptionError: If one is not known, with the nearest, or none is left.
    """
    select, ignore = ([rule for words in some for rule in words.split(",") if rule] for some in (select, ignore))
    for rule in (*select, *ignore):
        if rule not in rules():
            raise OptionError(unknown(rule))
    if not set(select or rules()) - set(ignore):
        raise OptionError(f"--ignore {','.join(ignore)}: no rule is left")
    return select, ignore


def rules_table() -> str:
    """All rules with their titles and symptoms, a line each."""
    width = max(map(len, rules()))
    return "\n".join(f"{rule.id:<{width}}  {rule.title} ({', '.join(rule.families)})" for rule in rules().values())


def explained(rule: Rule) -> str:
    """A rule's page as text."""
    case = f"\n\nCase: {rule.case} (clinic show {rule.case})" if rule.case else ""
    head = f"{rule.id}: {rule.title}\nSymptoms: {', '.join(rule.families)}. Since clinic {rule.since}."
    return f"{head}\n\n{rule.text}{case}"
