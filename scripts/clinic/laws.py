"""The laws that every case obeys. Each law gives its complaints, and a complaint says what to do."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from itertools import combinations

from clinic.case import Case
from clinic.checks import expected, judge
from clinic.evidence import CheckResult, Evidence, VariantEvidence, observe
from clinic.measure import measure_model, measure_output
from clinic.problem import Problem
from clinic.prose import quantity
from clinic.proselaws import PROSE, quoted, typed
from clinic.record import Check, Fix
from clinic.record_parts import Edit
from clinic.script import run_script
from clinic.simulate import compile_model
from clinic.sweep import agreement
from clinic.variant import EditError, apply_edits, changed_lines, remedies, variants
from clinic.yamlmap import Where

MAX_CHANGED_LINES = 5
CHECK = re.compile(r"checks\.(?P<kind>broken|fixed)\[(?P<index>\d+)\]")


def verdicts(case: Case, evidence: Evidence) -> Iterator[str]:
    """Law 1. Broken: all of `checks.broken`, not all of `checks.fixed`. A fix: the other way round.

    A refuted remedy: not all of `checks.fixed`.
    """
    for name, variant in evidence.variants.items():
        match variant.kind:
            case "broken":
                yield from _failing(name, variant, "broken")
                if variant.well:
                    yield f"{name}: passes every check of `fixed`; tighten one until the broken variant fails it"
            case "fix":
                yield from _failing(name, variant, "fixed")
                if variant.broken:
                    yield f"{name}: passes every check of `broken` too; tighten one until the repair fails it"
            case "refuted":
                if variant.well:
                    yield f"{name}: refuted, yet passes every check of `fixed`; move it to `fixes` or tighten a check"


def ablation(case: Case, evidence: Evidence) -> Iterator[str]:
    """Law 2. Of a fix with several edits, no proper subset passes `fixed`, or `redundant` says why."""
    for fix in case.record.fixes:
        enough = [subset for subset in _subsets(fix) if passes(case, subset)]
        if enough and fix.redundant is None:
            part = " and ".join(f"{edit.find!r}" for edit in enough[0])
            yield f"{fix.id}: the edit of {part} alone repairs it; drop the other edits, or say why in `redundant`"
        if not enough and fix.redundant is not None:
            yield f"{fix.id}: `redundant` is no longer needed: every edit is necessary; remove it"


def small_edits(case: Case, evidence: Evidence) -> Iterator[str]:
    """Law 3. Every remedy changes at most a handful of lines (that edits match once is checked on loading)."""
    for variant in variants(case)[1:]:
        count = changed_lines(case.text, variant.text)
        if not 1 <= count <= MAX_CHANGED_LINES:
            yield f"{variant.id}: changes {count} lines; keep it to 1 to {MAX_CHANGED_LINES}"


def repeatable(case: Case, evidence: Evidence) -> Iterator[str]:
    """Law 4, first half. A second run of a variant gives bitwise the same evidence."""
    for variant in variants(case):
        again = observe(case, variant)
        if again != evidence.variants[variant.id]:
            yield f"{variant.id}: two runs differ; seed what is random, and bound loops by steps"


def warned(case: Case, evidence: Evidence) -> Iterator[str]:
    """Law 4, second half. A fix raises no MuJoCo warning; the broken variant exactly those in `warnings`."""
    for name, variant in evidence.variants.items():
        raised, named = sorted(variant.warnings), sorted(case.record.warnings)
        if variant.kind == "fix" and raised:
            yield f"{name}: a fix that raises {', '.join(raised)}; repair the model until it is silent"
        if variant.kind == "broken" and raised != named:
            yield f"{name}: raises {raised}, while `warnings` names {named}; write `warnings: {raised}`"


def lasting(case: Case, evidence: Evidence) -> Iterator[str]:
    """Law 6, first half. A fix still holds after ten times its duration."""
    for name, robust in evidence.robustness.items():
        if robust.longer is False:
            yield f"{name}: no longer holds after ten times the duration; repair it, or say why in `exempt: lasting`"


def steady(case: Case, evidence: Evidence) -> Iterator[str]:
    """Law 6, second half. Small changes of the start, and half the timestep, leave every verdict."""
    for name, robust in evidence.robustness.items():
        if robust.same < robust.runs:
            share = f"{robust.same} of {robust.runs}"
            yield f"{name}: keeps its verdict in {share} changed runs; widen a bound, or say why in `exempt: steady`"


def swept(case: Case, evidence: Evidence) -> Iterator[str]:
    """The cause is a law: each prediction agrees, moved by 5 % it does not, and rivals miss; or `no_sweep` says why."""
    record = case.record
    if bool(record.sweep) == (record.no_sweep is not None):
        yield "has no `sweep` and no reason in `no_sweep`, or both; give one of the two"
    for name, sweep in record.sweep.items():
        found = evidence.sweep[name]
        own = found.agreement["prediction"]
        if own.judged == 0 or own.wrong:
            worst = "" if own.worst is None else f", by {quantity(own.worst, own.unit)} at the worst"
            yield f"sweep {name}: the prediction misses {own.wrong} of {own.judged} points{worst}; correct its `expr`"
        for factor in (0.95, 1.05):
            if not agreement(sweep, sweep.prediction, "prediction", found.points, factor).wrong:
                yield f"sweep {name}: the prediction times {factor} agrees too; choose points that can tell"
        for rival in sweep.rivals:
            if not found.agreement[rival.id].wrong:
                yield f"sweep {name}: the rival {rival.id} never misses; remove it, or choose points that can tell"


def filmed(case: Case, evidence: Evidence) -> Iterator[str]:
    """A model case has a film, a code case none."""
    if (case.record.film is None) != (case.record.model is None):
        yield "a model needs `film`, and a script has none; add or remove it"


LAWS: dict[str, Callable[[Case, Evidence], Iterator[str]]] = {
    law.__name__: law
    for law in (verdicts, ablation, small_edits, repeatable, warned, quoted, typed, lasting, steady, swept, filmed)
}


def complaints(case: Case, evidence: Evidence, law: str) -> list[str]:
    """What a law complains of, after exemptions (law 8): one that is no longer needed is a complaint itself."""
    found = list(LAWS[law](case, evidence))
    if law not in case.record.exempt:
        return found
    return [] if found else [f"`exempt: {law}` is no longer needed; remove it"]


def all_breaches(case: Case, evidence: Evidence) -> list[Problem]:
    """What every law complains of, as problems of the record."""
    return [breach(case, complaint) for law in LAWS for complaint in complaints(case, evidence, law)]


def breach(case: Case, complaint: str) -> Problem:
    """A complaint as a problem of the record."""
    found, _, repair = complaint.partition(";")
    return case.problem(_place(case, complaint), found, "what the record claims", repair.strip() or found)


def _place(case: Case, complaint: str) -> Where:
    """The check that a complaint names, or what it begins with: a text, a sweep, a remedy; else the checks."""
    if check := CHECK.search(complaint):
        return "checks", check["kind"], int(check["index"])
    kind, _, name = complaint.partition(":")[0].partition(" ")
    if kind in PROSE:
        return (kind,)
    if kind == "sweep" and name in case.record.sweep:
        return kind, name
    places = {remedy.id: where for where, _, remedy in remedies(case)}
    return places.get(name, places.get(kind, ("checks",)))


def passes(case: Case, edits: tuple[Edit, ...]) -> bool:
    """Whether the broken text after these edits passes every check of `fixed`."""
    try:
        text = apply_edits(case.text, edits)
        if case.record.run is not None:
            _, traces = measure_model(case.record, compile_model(text), case.record.run)
        else:
            traces = measure_output(case.record, run_script(text, case.texts, name=case.record.source))
    except (EditError, ValueError):
        return False
    return all(judge(check, traces).holds for check in case.record.checks.fixed)


def _subsets(fix: Fix) -> Iterator[tuple[Edit, ...]]:
    for size in range(1, len(fix.edits)):
        yield from combinations(fix.edits, size)


def _failing(name: str, variant: VariantEvidence, kind: str) -> Iterator[str]:
    for index, result in enumerate(variant.checks[kind]):  # type: ignore[index]
        if not result.holds:
            place = f"checks.{kind}[{index}]"
            yield f"{name}: {_measured(result, variant)}; correct the bound of {place}, the edits, or the model"


def _measured(result: CheckResult, variant: VariantEvidence) -> str:
    unit = "s" if result.take == "onset" else variant.traces[result.signal].unit
    value = "nothing" if result.measured is None else quantity(result.measured, unit, 6)
    check = Check.model_validate({"signal": result.signal, "take": result.take, **result.expected}, strict=False)
    return f"{result.signal} ({result.take}) measured {value}, expected {expected(check)} {unit}".rstrip()
