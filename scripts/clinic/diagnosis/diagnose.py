"""From a reader's model to its causes."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from clinic.diagnosis.edit import Edit, apply
from clinic.diagnosis.engine import MESH, CompileError, Engine
from clinic.diagnosis.errors import mended
from clinic.diagnosis.finding import Diagnosis, finding_of
from clinic.diagnosis.ignores import Ignores
from clinic.diagnosis.judge import Judged, grouped, judge, order, suspects_of, without_consequences, without_rivals
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules import Rule, rules
from clinic.diagnosis.simulation import Start
from clinic.diagnosis.source import decoded, read_source, read_texts
from clinic.diagnosis.stand_ins import StandIns
from clinic.diagnosis.suspect import Suspect

LIMIT = 20.0  # s for a start, after which no further rule is tried
OF_SHAPES = {"contact", "mass", "parts-coincide"}  # rules, by area or id, that boxes in the place of meshes mislead
OTHER = 3.0  # times the boxes' size: what is told is the same with these


def examine(
    engine: Engine,
    texts: dict[str, str],
    *,
    symptom: str = "",
    start: Start | None = None,
    select: Collection[str] = (),
    ignore: Collection[str] = (),
    tell: Callable[[str], None] = lambda _: None,
    limit: float = LIMIT,
) -> Diagnosis:
    """Diagnoses a model, given as texts; what it names besides is found from the current folder.

    Args:
        engine: What compiles and runs it.
        texts: The model's text by its name, then those that it includes (`source.read_texts`).
        symptom: The family of symptoms that the reader sees; its causes come first.
        start: Keyframe and controls; where left out, the model's start, and then its first keyframe.
        select: Rules to try; all where empty.
        ignore: Rules not to try.
        tell: Is called with the id of each rule before it is tried.
        limit: How long rules are tried for each start, in s.

    Raises:
        StartError: If the model compiles and does not have the start.
    """
    model = ReaderModel(engine, texts, read_source(texts), start or Start())
    ignores = Ignores(model)
    wanted = [rule for name, rule in rules().items() if name not in ignore and (not select or name in select)]
    tried, error = [rule for rule in wanted if rule.of_errors == bool(model.error)], model.error
    families = (symptom,) if symptom else ()
    fixed: Mapping[str, str]
    if error:
        found, left = mended(model, tried, tell)
        found, fixed = grouped(found), left.texts
        if isinstance(left.engine, StandIns) and not left.error and left.texts == model.texts:
            model = ReaderModel(left.engine, left.texts, left.source, start or Start())
            others = [rule for rule in wanted if not rule.of_errors]
            behind, fixed, also = _behind(model, others, ignores, start, tell, limit)
            found = [replace(each, suspect=_with(each.suspect, left.engine.told())) for each in found]
            found += order(grouped(behind), families)
            tried += also
    else:
        found, fixed, tried, model = _from_starts(model, tried, ignores, start, tell, limit)
        found = order(grouped(found), families)
    named = {each.rule.id for each in found}
    findings = [*(finding_of(each, model) for each in found), *ignores.findings({rule.id for rule in tried}, named)]
    kept = [each for each in findings if not each.silenced]
    return Diagnosis(
        engine.version,
        next(iter(texts)),
        tuple(each for each in kept if each.level == "cause"),
        tuple(each for each in kept if each.level == "hint"),
        tuple(each for each in findings if each.silenced),
        tuple(rule.id for rule in tried if rule.id not in named),
        error,
        texts,
        fixed,
    )


def _found(
    model: ReaderModel, wanted: Iterable[Rule], ignores: Ignores, tell: Callable[[str], None], limit: float
) -> tuple[list[Judged], Mapping[str, str], list[Rule]]:
    """What is found in a model that compiles, its texts with the edits of causes that go together, and who looked."""
    found: list[Judged] = []
    tried: list[Rule] = []
    afloat = model.afloat() if any(rule.afloat for rule in wanted) else model
    until = time.monotonic() + limit

    def asked(rule: Rule) -> ReaderModel:
        return afloat if rule.afloat else model

    for rule in wanted:
        if time.monotonic() > until:
            break
        tell(rule.id)
        tried.append(rule)
        judged = (judge(asked(rule), rule, suspect) for suspect in suspects_of(asked(rule), rule, tell))
        found += [each for each in judged if each is not None]
    found = without_consequences(without_rivals(found), asked)
    found = [replace(each, silenced=ignores.why(each, model)) for each in found]
    edits: list[Edit] = []
    for each in found:
        if each.proved and not isinstance(model.with_edits([*edits, *each.suspect.edits]), CompileError):
            edits += each.suspect.edits
    return found, apply(model.texts, edits), tried


def _from_starts(
    model: ReaderModel,
    wanted: Sequence[Rule],
    ignores: Ignores,
    start: Start | None,
    tell: Callable[[str], None],
    limit: float,
) -> tuple[list[Judged], Mapping[str, str], list[Rule], ReaderModel]:
    """The same from the model's start and, where no cause is found there, from its first keyframe; and that model."""
    found, fixed, tried = _found(model, wanted, ignores, tell, limit)
    if start is None and model.simulation.count("key") and not any(each.proved for each in found):
        model, before = ReaderModel(model.engine, model.texts, model.source, Start(key=0)), found
        found, fixed, tried = _found(model, tried, ignores, tell, limit)
        seen = {rule.id for rule in tried}  # a hint of the model's own start that is not one of the keyframe's
        found += [each for each in before if each.rule.id not in seen]
    return found, fixed, tried, model


def _behind(
    model: ReaderModel,
    wanted: Sequence[Rule],
    ignores: Ignores,
    start: Start | None,
    tell: Callable[[str], None],
    limit: float,
) -> tuple[list[Judged], Mapping[str, str], list[Rule]]:
    """The same of a model whose files are missing: all where they are pictures, else as hints what needs no shape."""
    stand_ins = model.engine
    assert isinstance(stand_ins, StandIns)
    if not stand_ins.shapes:
        found, fixed, tried, _ = _from_starts(model, wanted, ignores, start, tell, limit)
        return found, fixed, tried
    shapeless = [rule for rule in wanted if not {rule.area, rule.id} & OF_SHAPES]
    found, _, tried, _ = _from_starts(model, shapeless, ignores, start, tell, limit)
    others = StandIns(stand_ins.engine, OTHER * stand_ins.size, stand_ins.absent)
    other = ReaderModel(others, model.texts, model.source, start or Start())
    again = {rule.id: rule for rule in (each.rule for each in found)}
    kept = {_said(each) for each in _from_starts(other, [*again.values()], ignores, start, tell, limit)[0]}
    simulation = model.simulation
    meshes = {simulation.name("geom", each) for each, of in enumerate(simulation.model("geom_type")) if of == MESH}
    found = [each for each in found if _said(each) in kept and not meshes & {*each.suspect.elements}]
    return [replace(each, level="hint") for each in found], model.texts, tried


def _said(each: Judged) -> tuple[str, tuple[str, ...], str]:
    return each.rule.id, each.suspect.elements, each.suspect.says


def _with(suspect: Suspect, sentence: str) -> Suspect:
    return replace(suspect, says=f"{suspect.says} {sentence}")


def diagnose_here(path: Path | str, **options: object) -> Diagnosis:
    """Diagnoses a model file in this process, whose current folder is the model's meanwhile.

    Args:
        path: An MJCF or URDF file.
        options: See `examine`.

    Raises:
        OSError: If the file cannot be read.
    """
    from clinic.diagnosis.native import NativeEngine

    path = Path(path).absolute()
    before = Path.cwd()
    os.chdir(path.parent)
    try:
        texts = read_texts(decoded(path.read_bytes())[0], path.name, read_file)
        return examine(NativeEngine(), texts, **options)  # type: ignore[arg-type]
    finally:
        os.chdir(before)


def read_file(name: str) -> str | None:
    """The text of a file; None where there is none that is text."""
    try:
        return decoded(Path(name).read_bytes())[0]
    except (OSError, ValueError):
        return None
