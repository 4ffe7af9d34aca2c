"""From a reader's model to its causes."""

from __future__ import annotations

import time
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from clinic.diagnosis.edit import Edit, apply
from clinic.diagnosis.engine import MESH, CompileError, Engine
from clinic.diagnosis.errors import OF_FILES, mended
from clinic.diagnosis.finding import Diagnosis, finding_of
from clinic.diagnosis.ignores import Ignores
from clinic.diagnosis.judge import Judged, grouped, judge, order, suspects_of, without_consequences, without_rivals
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules import Rule, rules
from clinic.diagnosis.source import read_source
from clinic.diagnosis.stand_ins import StandIns
from clinic.diagnosis.start import Start
from clinic.diagnosis.suspect import Suspect

LIMIT = 20.0  # s of processor time for a start, after which no further rule is tried
OF_SHAPES = {  # rules, by area or id, that boxes in the place of meshes mislead
    "contact", "mass", "parts-coincide", "mesh-in-another-unit", "mesh-of-another-link", "geom-out-of-scale",
    "key-in-the-floor", "wheels-off-the-ground",
}  # fmt: skip
MENDED = "What else is told was measured with these mended."
LARGER = 3.0  # times the boxes' size: what is told is the same with these


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
        texts: The model's text by its name, then those that it includes (`texts.read_texts`).
        symptom: The family of symptoms that the reader sees; its causes come first, and some from smaller numbers on.
        start: Keyframe and controls; where left out, the model's start, and then its first keyframe.
        select: Rules to try; all where empty.
        ignore: Rules not to try.
        tell: Is called with the id of each rule before it is tried.
        limit: How long rules are tried for each start, in s of processor time, which no other process takes from them.

    Raises:
        StartError: If the model compiles and does not have the start.
    """
    model = ReaderModel(engine, texts, read_source(texts), start or Start(), symptom)
    ignores = Ignores(model)
    wanted = [rule for name, rule in rules().items() if name not in ignore and (not select or name in select)]
    of_errors, others = (in_turn(rule for rule in wanted if rule.of_errors == ill) for ill in (True, False))
    trial = _Trial(ignores, start, tell, limit)
    error, families = model.error, (symptom,) if symptom else ()
    if error:
        found, left, placed = mended(model, of_errors, tell)
        made, found = _Made([], left.texts, [], [], model), grouped(found)
        if not left.error:
            made = trial.behind(left, others, as_hints=any(each.level == "cause" for each in found))
            suspects = (_located(each.suspect, made.model) for each in made.found)
            behind = [replace(each, suspect=placed(one)) for each, one in zip(made.found, suspects, strict=True)]
            made = made._replace(found=behind, model=model)
            found = _measured_with(found, left.engine, bool(behind))
    else:
        found, of_errors, made = [], [], trial.from_starts(model, others)
    found += order(grouped(made.found), families)
    named, untried = {each.rule.id for each in found}, {rule.id for rule in made.untried}
    tried = {rule.id for rule in (*of_errors, *made.tried)} - untried
    findings = [
        *(finding_of(each, made.model) for each in found),
        *ignores.findings(tried, named),
    ]
    kept = [each for each in findings if not each.silenced]
    return Diagnosis(
        engine.version,
        next(iter(texts)),
        tuple(each for each in kept if each.level == "cause"),
        tuple(each for each in kept if each.level == "hint"),
        tuple(each for each in findings if each.silenced),
        tuple(sorted(tried - named)),
        error,
        texts,
        made.fixed,
        untried=tuple(sorted(untried - named)),
    )


def in_turn(wanted: Iterable[Rule]) -> list[Rule]:
    """Rules as they are tried: first those that can name a cause."""
    return sorted(wanted, key=lambda rule: rule.level == "hint")


def _measured_with(found: Sequence[Judged], engine: Engine, more: bool) -> list[Judged]:
    """Errors, the last of which says of what model all else is told."""

    def told(each: Judged) -> str:
        if isinstance(engine, StandIns):
            return f" {engine.told()}" if each.rule.id in OF_FILES and each.level == "hint" else ""
        return f" {MENDED}" if more and each is found[-1] else ""

    return [replace(each, suspect=replace(each.suspect, says=each.suspect.says + told(each))) for each in found]


def _located(suspect: Suspect, model: ReaderModel) -> Suspect:
    """The suspect with the place of the first of its elements that has one, where no edit has."""
    if suspect.edits or suspect.at:
        return suspect
    return replace(suspect, at=next((place for each in suspect.elements if (place := model.named(each))), None))


class _Made(NamedTuple):
    """What was found in a model, its texts with the edits of causes that go together, who looked, and the model."""

    found: list[Judged]
    fixed: Mapping[str, str]
    tried: list[Rule]
    untried: list[Rule]  # for want of time
    model: ReaderModel


@dataclass(frozen=True)
class _Trial:
    """How rules are tried on a model that compiles."""

    ignores: Ignores
    start: Start | None
    tell: Callable[[str], None]
    limit: float

    def once(self, model: ReaderModel, wanted: Sequence[Rule]) -> _Made:
        """All rules, one after the other, until the time is over."""
        found: list[Judged] = []
        tried: list[Rule] = []
        afloat = model.afloat() if any(rule.afloat for rule in wanted) else model
        until = time.process_time() + self.limit

        def asked(rule: Rule) -> ReaderModel:
            return afloat if rule.afloat else model

        for rule in wanted:
            if time.process_time() > until:
                break
            self.tell(rule.id)
            tried.append(rule)
            judged = (judge(asked(rule), rule, suspect) for suspect in suspects_of(asked(rule), rule, self.tell))
            found += [each for each in judged if each is not None]
        found.sort(key=lambda each: each.rule.id)  # whoever was first to look
        found = [replace(each, silenced=self.ignores.why(each, model)) for each in without_rivals(found)]
        found = without_consequences(found, asked)
        edits: list[Edit] = []
        for each in found:
            if each.proved and not isinstance(model.with_edits([*edits, *each.suspect.edits]), CompileError):
                edits += each.suspect.edits
        return _Made(found, apply(model.texts, edits), tried, [*wanted[len(tried) :]], model)

    def from_starts(self, model: ReaderModel, wanted: Sequence[Rule]) -> _Made:
        """The same from the model's start and, where no cause is found there, from its first keyframe."""
        made = self.once(model, wanted)
        if self.start is None and model.simulation.count("key") and not any(each.proved for each in made.found):
            begun = ReaderModel(model.engine, model.texts, model.source, Start(key=0), model.symptom)
            again = self.once(begun, made.tried)
            seen = {rule.id for rule in again.tried}
            # a hint of the model's own start that is not one of the keyframe's stays
            kept = [each for each in made.found if each.rule.id not in seen]
            return again._replace(found=again.found + kept, untried=made.untried + again.untried)
        return made

    def behind(self, left: ReaderModel, wanted: Sequence[Rule], as_hints: bool) -> _Made:
        """The same of a model that was mended: what needs no shape where boxes are in it, and that as hints."""
        model = ReaderModel(left.engine, left.texts, left.source, self.start or Start(), left.symptom)
        if isinstance(left.engine, StandIns) and left.engine.shapes:
            made, as_hints = self._of_any_size(model, left.engine, wanted), True
        else:
            made = self.from_starts(model, wanted)
        if not as_hints:
            return made
        return made._replace(found=[replace(each, level="hint") for each in made.found], fixed=left.texts)

    def _of_any_size(self, model: ReaderModel, stand_ins: StandIns, wanted: Sequence[Rule]) -> _Made:
        """What is found with boxes in the place of meshes, and with larger ones too."""
        made = self.from_starts(model, [rule for rule in wanted if not {rule.area, rule.id} & OF_SHAPES])
        larger = StandIns(stand_ins.engine, LARGER * stand_ins.size, stand_ins.absent)
        other = ReaderModel(larger, model.texts, model.source, self.start or Start(), model.symptom)
        again = self.from_starts(other, [*{each.rule.id: each.rule for each in made.found}.values()])
        kinds = model.simulation.model("geom_type")
        meshes = {model.simulation.name("geom", each) for each, kind in enumerate(kinds) if kind == MESH}
        same = {(each.rule.id, each.suspect.elements, each.suspect.says) for each in again.found}
        kept = [
            each
            for each in made.found
            if (each.rule.id, each.suspect.elements, each.suspect.says) in same
            and not meshes & {*each.suspect.elements}
        ]
        return made._replace(found=kept, untried=made.untried + again.untried)
