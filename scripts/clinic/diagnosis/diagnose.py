"""From a reader's model to its causes."""

from __future__ import annotations

import os
from collections.abc import Callable, Collection, Iterable
from pathlib import Path

from clinic.diagnosis.engine import Engine
from clinic.diagnosis.finding import Diagnosis, Finding
from clinic.diagnosis.judge import Judged, judge, order, suspects_of, without_rivals
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules import Rule, rules
from clinic.diagnosis.simulation import Start
from clinic.diagnosis.source import Source, SourceError


def examine(
    engine: Engine,
    texts: dict[str, str],
    *,
    symptom: str = "",
    start: Start | None = None,
    select: Collection[str] = (),
    ignore: Collection[str] = (),
    tell: Callable[[str], None] = lambda _: None,
) -> Diagnosis:
    """Diagnoses a model, given as texts; what it names besides is found from the current folder.

    Args:
        engine: What compiles and runs it.
        texts: The model's text by its name, then those that it includes (`source.read_texts`).
        symptom: The family of symptoms that the reader sees; its causes come first.
        start: Keyframe and controls; where left out, the model's start, and then its first keyframe.
        select: Rules to try; all where empty.
        ignore: Rules not to try.
        tell: Is called with what is being done, in a few words.
    """
    try:
        source = Source(texts)
    except SourceError:
        source = None
    found: list[Judged] = []
    tried: list[Rule] = []
    for begin in [start] if start else [Start(), Start(key=0)]:
        model = ReaderModel(engine, texts, source, begin)
        if begin.key >= 0 and not model.error and model.simulation.count("key") <= begin.key:
            break
        tried = [rule for rule in _wanted(select, ignore) if rule.of_errors == bool(model.error)]
        found = _judged(model, tried, tell)
        if model.error or any(each.level == "cause" for each in found):
            break
    found = order(found, (symptom,) if symptom else ())
    named = {each.rule.id for each in found}
    file = next(iter(texts))
    findings = [_finding(each, file) for each in found]
    return Diagnosis(
        engine.version,
        file,
        tuple(each for each in findings if each.level == "cause"),
        tuple(each for each in findings if each.level == "hint"),
        tuple(rule.id for rule in tried if rule.id not in named),
    )


def _judged(model: ReaderModel, tried: Iterable[Rule], tell: Callable[[str], None]) -> list[Judged]:
    found: list[Judged] = []
    for rule in tried:
        tell(rule.title)
        for suspect in suspects_of(model, rule, tell):
            judged = judge(model, rule, suspect)
            if judged is not None:
                found.append(judged)
    return without_rivals(found)


def _wanted(select: Collection[str], ignore: Collection[str]) -> Iterable[Rule]:
    return [rule for name, rule in rules().items() if name not in ignore and (not select or name in select)]


def _finding(judged: Judged, file: str) -> Finding:
    suspect = judged.suspect
    first = suspect.edits[0] if suspect.edits else None
    return Finding(
        rule=judged.rule.id,
        title=judged.rule.title,
        level=judged.level,
        elements=suspect.elements,
        file=first.file if first else file,
        line=first.line if first else None,
        attribute=suspect.attribute,
        now=suspect.now,
        value=suspect.value,
        edit=suspect.edits,
        probe=suspect.probe.title,
        unit=suspect.probe.unit,
        before=judged.before,
        after=judged.after,
        says=suspect.says,
        healthy=suspect.healthy,
    )


def diagnose_here(path: Path | str, **options: object) -> Diagnosis:
    """Diagnoses a model file in this process.

    Raises:
        OSError: If the file cannot be read.
    """
    from clinic.diagnosis.native import NativeEngine
    from clinic.diagnosis.source import read_texts

    path = Path(path).absolute()
    before = Path.cwd()
    os.chdir(path.parent)
    try:
        texts = read_texts(path.read_text(encoding="utf-8"), path.name, _read)
        return examine(NativeEngine(), texts, **options)  # type: ignore[arg-type]
    finally:
        os.chdir(before)


def _read(name: str) -> str | None:
    try:
        return Path(name).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError):
        return None
