"""The laws that every case obeys. Each law gives where the record breaks it, and what to do.

A new law goes into LAWS, docs/contribute/the-record.md and tests/proof/test_laws.py; one that every page obeys also
into BUILD_LAWS (`pages/cases.py`), one that a case may be exempt from into `Law` (`record/fields.py`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import combinations
from typing import Literal

from clinic.engine.checks import expected
from clinic.engine.simulate import compile_model
from clinic.engine.variant import Variant, apply_edits, changed_lines, variants
from clinic.proof.bounds import bounded, differing, marked, parting, varied, windowed
from clinic.proof.claims import claimed
from clinic.proof.evidence import CheckResult, Evidence, VariantEvidence, observe
from clinic.proof.prose.absences import bold, commented, denied, functional, kinds, named
from clinic.proof.prose.angles import angles
from clinic.proof.prose.comparisons import compared, ordered
from clinic.proof.prose.formulas import formulas
from clinic.proof.prose.labels import computed, entitled, labelled
from clinic.proof.prose.numbers import titled, typed
from clinic.proof.prose.opposites import indexed, opposed, valued
from clinic.proof.prose.signals import called, counted, within_its_sweep
from clinic.proof.prose.titles import performed
from clinic.proof.prose.units import in_units, written
from clinic.proof.prose_laws import owned, quoted, stated, taken
from clinic.proof.releases import differing as differing_releases
from clinic.proof.releases import release_problems
from clinic.proof.sweep import errors_at, format_values, unjudged_sides
from clinic.proof.task import changes
from clinic.proof.tightness import covers, value_of, words_of
from clinic.proof.trials import checks_in
from clinic.record.case import Case
from clinic.record.parts import Check, Edit
from clinic.record.problem import Problem, listed
from clinic.record.prose import quantity
from clinic.record.yaml_lines import Where

MAX_CHANGED_LINES = 5


def verdicts(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 1. Broken: all of `checks.broken`, not all of `checks.fixed`. A fix: the other way round.

    A refuted remedy: not all of `checks.fixed`.
    """
    for name, variant in evidence.variants.items():
        if variant.kind != "refuted":
            yield from _failing(case, name, variant, "broken" if variant.kind == "broken" else "fixed")
        kind = "broken" if variant.kind == "fix" else "fixed"
        if variant.broken if kind == "broken" else variant.well:
            repair = "move it to `fixes`, or tighten one" if variant.kind == "refuted" else "tighten one"
            yield case.problem(("checks", kind), f"{name}: passes every check", "a check that it fails", repair)


def ablation(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 2. Of a fix with several edits, no proper subset passes `fixed`, or `redundant` says why."""
    for index, fix in enumerate(case.record.fixes):
        where: Where = ("fixes", index)
        subsets = (subset for size in range(1, len(fix.edits)) for subset in combinations(fix.edits, size))
        enough = [subset for subset in subsets if passes(case, subset)]
        if enough and fix.redundant is None:
            part = " and ".join(f"{edit.find!r}" for edit in enough[0])
            found, repair = f"the edit of {part} alone repairs it", "drop the other edits, or say why in `redundant`"
            yield case.problem((*where, "edits"), found, "edits of which none can be spared", repair)
        if not enough and fix.redundant is not None:
            found = "a reason, though every edit is necessary"
            yield case.problem((*where, "redundant"), found, "a reason for an edit that can be spared", "remove it")


def small_edits(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 3. Every remedy changes at most a handful of lines; when variants are made it is checked that edits match."""
    for variant in variants(case)[1:]:
        count = changed_lines(case.text, variant.text)
        if not 1 <= count <= MAX_CHANGED_LINES:
            place, wanted = (*variant.where, "edits"), f"1 to {MAX_CHANGED_LINES}"
            yield case.problem(place, f"{count} changed lines", wanted, "change the lines that matter, and no others")


def repeatable(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 4, first half. A second run of a variant gives bitwise the same evidence."""
    for variant in variants(case):
        if observe(case, variant) != evidence.variants[variant.id]:
            found, wanted = f"{variant.id}: two runs that differ", "the same numbers from every run"
            where, repair = variant.where or ("checks",), "seed what is random, and bound loops by steps"
            yield case.problem(where, found, wanted, repair)


def warned(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 4, second half. A fix raises no MuJoCo warning; the broken variant exactly those in `warnings`."""
    for name, variant in evidence.variants.items():
        raised, named = sorted(variant.warnings), sorted(case.record.warnings)
        if variant.kind == "fix" and raised:
            wanted, repair = "a fix that raises no warning", "repair the model until it is silent"
            yield case.problem(_place(case, name), f"{name}: raises {listed(raised)}", wanted, repair)
        if variant.kind == "broken" and raised != named:
            wanted = f"what the broken variant raises: {listed(raised)}"
            repair = f"write `warnings: [{', '.join(raised)}]`" if raised else "remove `warnings`"
            yield case.problem(("warnings",), listed(named), wanted, repair)


def lasting(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 6, first half. A fix still holds after ten times its duration."""
    for name, robust in evidence.robustness.items():
        if robust.longer is False and evidence.variants[name].well:
            found = f"{name}: no longer holds after ten times the duration"
            repair = "repair what builds up, or say in `exempt: {lasting: ...}` why it must"
            yield case.problem(_place(case, name), found, "a fix that holds", repair)


def steady(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 6, second half. Small changes of the start, and half the timestep, leave every verdict."""
    for name, robust in evidence.robustness.items():
        if robust.same < robust.runs:
            found = f"{name}: keeps its verdict in {robust.same} of {robust.runs} slightly changed runs"
            repair = "widen a bound, or say in `exempt: {steady: ...}` why it must"
            yield case.problem(_place(case, name), found, "the same verdict in all of them", repair)


def swept(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """The cause is a law: each prediction agrees, moved by 5 % it does not, and rivals miss."""
    record = case.record
    if record.sweep and record.no_sweep is not None:
        wanted = "`sweep`, or the reason why there is none in `no_sweep`"
        yield case.problem(("sweep",), "both", wanted, "give one of them")
    for name, sweep in record.sweep.items():
        where: Where = ("sweep", name, "prediction")
        found, telling = evidence.sweep[name], "choose points that can tell"
        own = found.agreement["prediction"]
        if own.judged == 0:
            repair = "widen its `over`, or correct its `expr`"
            yield case.problem(where, "held against no point", "points that it can miss", repair)
        if own.wrong:
            point, _ = max(errors_at(sweep, "prediction", found.points), key=lambda each: each[1])
            seen = "nothing" if point.outcome is None else f"{point.outcome:.4g}"
            worst = f"{format_values(point.at)}: it says {point.predicted['prediction']:.4g}, and {seen} is measured"
            said = f"misses {own.wrong} of {own.judged} points; most at {worst}"
            yield case.problem(where, said, "a prediction that misses none", "correct its `expr`")
        for factor in (0.95, 1.05):
            errors = errors_at(sweep, "prediction", found.points, factor)
            if all(error <= sweep.prediction.within for _, error in errors):
                said = f"agrees when multiplied by {factor} too"
                yield case.problem(where, said, "a prediction that then misses", telling)
        if sweep.holds is not None:
            yield from _far_from_line(case, name, evidence)
        for rival in sweep.rivals:
            if not found.agreement[rival.id].wrong:
                said, repair = f"{rival.id}: never misses", f"remove it, or {telling}"
                yield case.problem(("sweep", name, "rivals"), said, "a rival that misses somewhere", repair)


def tightness(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 7, second half. A check notices when a number that matters is halved or doubled, or `loose` says why not."""
    reasons, found = case.record.loose or {}, evidence.loose or []
    for number in found:
        if not any(covers(case, words, number) for words in reasons):
            words = words_of(case, number)
            said = f"{words} of {number.variant}: no check notices when {value_of(case, number)} is {number.change}"
            repair = f"add a check of what it decides, or say in `loose: {{{words!r}: ...}}` why none need notice"
            yield case.problem(("loose",), said, "checks that pin each number down", repair)
    for words in reasons if evidence.loose is not None else ():
        if not any(covers(case, words, number) for number in found):
            wanted = "text that holds a number of which a change goes unnoticed"
            yield case.problem(("loose", words), words, wanted, "remove it, or copy the text character by character")


def filmed(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """A code case has no film."""
    if case.record.model is None and case.record.film is not None:
        yield case.problem(("film",), "a film of a script", "none: there is nothing to see", "remove `film`")


def same_task(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """A fix of a model leaves the task alone, but for what `task.may` names."""
    if case.record.run is None:
        return
    broken, *others = variants(case)
    for variant in others:
        told = changes(compile_model(broken.text), compile_model(variant.text), case.record.task)
        if variant.kind == "fix" and told:
            wanted, repair = "a repair that leaves the task alone", "name what it may change in `task: {may: [...]}`"
            yield case.problem(_place(case, variant.id), f"{variant.id}: {' '.join(told)}", wanted, repair)


def released(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 10. Every release of MuJoCo that was measured does the same, or `older` says why not."""
    yield from release_problems(case, differing_releases(evidence))


OF_GRADE_A = ("parting", "bold", "named", "kinds", "functional", "commented")
LAWS: dict[str, Callable[[Case, Evidence], Iterator[Problem]]] = {
    law.__name__: law
    for law in (
        verdicts,
        bounded,
        parting,
        windowed,
        differing,
        ablation,
        small_edits,
        repeatable,
        warned,
        claimed,
        quoted,
        typed,
        taken,
        called,
        counted,
        compared,
        ordered,
        opposed,
        valued,
        indexed,
        within_its_sweep,
        labelled,
        computed,
        in_units,
        written,
        angles,
        entitled,
        stated,
        formulas,
        owned,
        titled,
        performed,
        denied,
        functional,
        named,
        kinds,
        bold,
        commented,
        lasting,
        steady,
        swept,
        varied,
        marked,
        tightness,
        filmed,
        same_task,
        released,
    )
}


def breaches(case: Case, evidence: Evidence, *laws: str) -> list[Problem]:
    """Where the case breaks the laws, after exemptions (law 11): one that is no longer needed is a breach itself.

    A first version, which is no grade A yet, is not held to its every word.
    """
    made = []
    for law in laws:
        if law in OF_GRADE_A and case.lacking:
            continue
        found = list(LAWS[law](case, evidence))
        if law not in case.record.exempt:
            made += found
        elif not found:
            where, wanted = ("exempt", law), "an exemption from a law that the case breaks"
            made.append(case.problem(where, "a law that it obeys", wanted, "remove it"))
    return made


def passes(case: Case, edits: tuple[Edit, ...]) -> bool:
    """Whether the broken text after these edits runs, and passes every check of `fixed`."""
    try:
        return observe(case, Variant("fix", "", "", edits, apply_edits(case.text, edits))).well
    except ValueError:
        return False


def _failing(case: Case, name: str, variant: VariantEvidence, kind: Literal["broken", "fixed"]) -> Iterator[Problem]:
    asked: list[tuple[Where, str, Check, CheckResult]] = []
    for index, (check, result) in enumerate(zip(getattr(case.record.checks, kind), variant.checks[kind], strict=True)):
        asked.append((("checks", kind, index), "", check, result))
    for index, trial in enumerate(case.record.trials):
        checks = getattr(checks_in(case.record, trial), kind)
        for check, result in zip(checks, variant.trials[trial.id][kind], strict=True):
            asked.append((("trials", index), f" in {trial.id}", check, result))
    for where, inside, check, result in asked:
        if not result.holds:
            unit = "s" if result.take == "onset" else variant.traces[result.signal].unit
            value = "nothing" if result.measured is None else quantity(result.measured, unit, 6)
            found = f"{name}{inside}: {result.signal} ({result.take}) = {value}"
            wanted = f"{expected(check)} {unit}".rstrip()
            yield case.problem(where, found, wanted, "correct the bound, the edits, or the model")


def _far_from_line(case: Case, name: str, evidence: Evidence) -> Iterator[Problem]:
    """A line must be shown to separate near to it and in the end, or `apart` says why not."""
    sweep, where = case.record.sweep[name], ("sweep", name)
    told = []
    if sides := unjudged_sides(sweep, evidence.sweep[name].points):
        reach = f"{2 * sweep.prediction.within:g} of the line, relative, that is judged"
        told.append((f"no point {' and none '.join(sides)} it within {reach}", "add points there"))
    if case.record.run is not None and sweep.outcome.take != "final":
        told.append((f"the outcome is taken as {sweep.outcome.take}", "take `final`"))
    if sweep.apart is None:
        for found, repair in told:
            wanted = "points judged near the line on both sides, by their end"
            yield case.problem(where, found, wanted, f"{repair}, or say in `apart` why not")
    elif not told:
        yield case.problem((*where, "apart"), "a reason, though none is needed", "nothing to excuse", "remove it")


def _place(case: Case, name: str) -> Where:
    """Where the record speaks of a variant."""
    return next(variant.where for variant in variants(case) if variant.id == name) or ("checks",)
