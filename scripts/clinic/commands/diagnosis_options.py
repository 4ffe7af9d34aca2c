"""What `clinic diagnose`, `clinic rules` and `clinic explain` read and print."""

from __future__ import annotations

import csv
import difflib
from collections.abc import Iterable, Mapping
from pathlib import Path

from clinic.diagnosis.rules import Rule, rules
from clinic.diagnosis.simulation import Start
from clinic.record.families import families, likely_families


class OptionError(ValueError):
    """An option that cannot be taken, in a sentence."""


def start_of(keyframe: str | None, ctrl: Iterable[str], duration: float, seed: int, model: str) -> Start | None:
    """How the run begins, from the command's options; None where none is given.

    Raises:
        OptionError: If one cannot be taken.
    """
    single: dict[str, float] = {}
    series: list[tuple[float, Mapping[str, float]]] = []
    for each in ctrl:
        name, equals, value = each.partition("=")
        if equals:
            try:
                single[name] = float(value)
            except ValueError:
                raise OptionError(f"--ctrl {each}: {value!r} is not a number") from None
        else:
            series += _series(Path(each))
    if keyframe is None and not single and not series and duration == 2.0 and not seed:
        return None
    return Start(_key(keyframe, model), single, tuple(sorted(series, key=lambda row: row[0])), duration, seed)


def _key(keyframe: str | None, model: str) -> int:
    """The number of a keyframe, by its name or number."""
    if keyframe is None:
        return -1
    if keyframe.isdigit():
        return int(keyframe)
    from clinic.diagnosis.diagnose import read_file
    from clinic.diagnosis.source import read_source, read_texts

    text, beside = read_file(model), Path(model).parent
    source = read_source(read_texts(text, model, lambda name: read_file(str(beside / name)))) if text else None
    names = [key.get("name") for key in source.section("keyframe")] if source else []
    if keyframe not in names:
        raise OptionError(
            f"--keyframe {keyframe}: the model has {', '.join(filter(None, names)) or 'none with a name'}"
        )
    return names.index(keyframe)


def _series(path: Path) -> list[tuple[float, Mapping[str, float]]]:
    """Controls by time: a CSV or NPZ with a column `time` and one for each actuator."""
    try:
        if path.suffix == ".npz":
            import numpy as np

            with np.load(path) as arrays:
                columns = {name: arrays[name].tolist() for name in arrays}
        else:
            with path.open(newline="", encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            columns = {name: [float(row[name]) for row in rows] for name in (rows[0] if rows else {})}
        times = columns.pop("time")
    except OSError as error:
        raise OptionError(f"--ctrl {path}: {error.strerror or error}; expected name=value, a CSV or NPZ") from None
    except KeyError:
        raise OptionError(f"--ctrl {path}: no column `time`, in s, beside those of the actuators") from None
    except (ValueError, TypeError) as error:
        raise OptionError(f"--ctrl {path}: {error}") from None
    return [(time, {name: column[i] for name, column in columns.items()}) for i, time in enumerate(times)]


def family_of(symptom: str) -> str:
    """The family that a symptom names, or that its words speak of; empty for an empty one.

    Raises:
        OptionError: If there is none.
    """
    if not symptom or symptom in families():
        return symptom
    if not (found := likely_families(symptom)):
        raise OptionError(
            f"--symptom {symptom}: expected one of {', '.join(families())}, or what you see in your words"
        )
    return found[0]


def check_rules(chosen: Iterable[str]) -> None:
    """Whether rules are known.

    Raises:
        OptionError: If one is not; it names the nearest.
    """
    for rule in chosen:
        if rule not in rules():
            raise OptionError(unknown(rule))


def unknown(rule: str) -> str:
    """That a rule is unknown, with the nearest that is known."""
    near = difflib.get_close_matches(rule, rules(), 1)
    return f"no rule is called {rule}" + (f"; {near[0]} is" if near else "; `clinic rules` lists them")


def rules_table() -> str:
    """All rules with their titles, by the folder that they lie in."""
    width = max(map(len, rules()))
    return "\n".join(f"{rule.id:<{width}}  {rule.title} ({', '.join(rule.families)})" for rule in rules().values())


def explained(rule: Rule) -> str:
    """A rule's page as text."""
    case = f"\n\nCase: {rule.case} (clinic show {rule.case})" if rule.case else ""
    head = f"{rule.id}: {rule.title}\nSymptoms: {', '.join(rule.families)}. Since clinic {rule.since}."
    return f"{head}\n\n{rule.text}{case}"
