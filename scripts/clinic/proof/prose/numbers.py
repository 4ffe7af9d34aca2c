"""Law 5, numbers: none is typed in prose, and those of a title agree with what is changed."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator

from clinic.engine.variant import Variant, variants
from clinic.proof.evidence import Evidence
from clinic.proof.prose_laws import prose_of
from clinic.proof.trials import changed_numbers
from clinic.record.case import Case
from clinic.record.problem import Problem, listed
from clinic.record.prose import FORMULA, bare
from clinic.record.yaml_lines import Where

WRITTEN = re.compile(r"(?<![\w.])\d[\d_]*\.?\d*(?:e-?\d+)?")
SMALL = "three four five six seven eight nine ten eleven twelve thirteen fourteen fifteen sixteen twenty thirty forty"
SMALL += " fifty sixty seventy eighty ninety hundred thousand million dozen"
COUNT = "|".join(f"{word}s?" for word in SMALL.split())
SHARE = "fourth|fifth|sixth|seventh|eighth|ninth|tenth|twelfth|twentieth|fiftieth|hundredth|thousandth|millionth"
SIZE = r"(?:metres?|centimetres?|millimetres?|seconds?|milliseconds?|radians?|degrees?|kilograms?|newtons?|percent)"
NUMBER = re.compile(
    rf"(?<![\w.])[-\u2212]?\d[\d_,.]*(?:(?<=\d))(?:[\s\u00a0]?(?:°|%))?|\b(?:{COUNT})(?:-(?:\w+))?\b|\b(?:{SHARE})s?\b|"
    rf"\btwice\b|\bthrice\b|\bdoubl(?:es|ed|ing)\b|\bhal(?:ve[sd]?|ving)\b|\ba third\b|\bquarters?\b(?! turn)|"
    rf"\ba half of\b|\bhalf (?:an?|of a) {SIZE}\b|"
    rf"\b(?:one|two|zero|full|whole) {SIZE[:-1]}|minutes?|hours?)\b|\b(?:at|by) (?:zero|one|two)\b(?! (?:most|least))|"
    r"\b(?:has|had|have) (?:zero|two)\b",
    re.IGNORECASE,
)
TITLE = re.compile(rf"{NUMBER.pattern}|\bdouble the\b|\bhalf (?:of )?the\b|\btwo\b", re.IGNORECASE)
UNIT = re.compile(r"\s(?:m?s|[mc]?m|k?g|N|rad|Hz)\b")
STEPS = re.compile(r"\b(?:earlier|later|more|fewer|less|further|ahead)\b", re.IGNORECASE)
LESS = re.compile(r"\b(?:half (?:of )?the|quarter|hal(?:ve|ving)|divide|lighter|thinner|softer|lower)\b", re.IGNORECASE)
MORE = re.compile(r"\b(?:twice the|doubl(?:e|ing)|heavier|thicker|harder|raise)\b", re.IGNORECASE)
OPERATOR = re.compile(r"[\d/*=^√()+·]")


def typed(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, numbers. None is typed, in digits or in words; a run, the record or the engine has it."""
    labels: list[tuple[Where, str]] = [
        (("signals", name, "label"), signal.label) for name, signal in case.record.signals.items()
    ]
    releases = [spec.lstrip("<") for spec in case.record.older]
    for key, sweep in case.record.sweep.items():
        labels.append((("sweep", key, "title"), sweep.title))
        labels += [(("sweep", key, "vary", k, "label"), parameter.label) for k, parameter in enumerate(sweep.vary)]
    reasons: list[tuple[Where, str]] = [(("older", spec), reason) for spec, reason in case.record.older.items()]
    reasons += [(("exempt", law), reason) for law, reason in case.record.exempt.items()]
    reasons += [(("loose", words), reason) for words, reason in (case.record.loose or {}).items()]
    reasons += [(("fixes", k, "redundant"), fix.redundant or "") for k, fix in enumerate(case.record.fixes)]
    reasons += [(("sweep", key, "apart"), sweep.apart or "") for key, sweep in case.record.sweep.items()]
    reasons.append((("no_sweep",), case.record.no_sweep or ""))
    for where, text in [*prose_of(case), *reasons, *labels]:
        for found in NUMBER.finditer(FORMULA.sub("", bare(text))):
            number = found[0].strip().rstrip(".,")
            own = where[0] == "loose" and number == "twice"  # what the law itself tries
            if number not in releases and not own and not (where[-1] == "label" and number.startswith("by ")):
                repair = "write a field such as {{ broken.signal.final }}, or say it without a number"
                wanted = "what a run gave"
                if where[0] == "older":
                    wanted, repair = (
                        f"a release that `older` names: {listed(releases)}",
                        "write that, or say it in words",
                    )
                yield case.problem(where, f"{number!r}, typed by hand", wanted, repair, quoted=number)
    for key, sweep in case.record.sweep.items():
        for place, form in [("prediction", sweep.prediction), *((f"rivals.{r.id}", r) for r in sweep.rivals)]:
            if OPERATOR.search(form.label) or NUMBER.search(form.label):
                wanted, repair = "words alone: the formula stands beside them", "leave the formula out"
                yield case.problem(("sweep", key, *place.split(".")[:1]), form.label, wanted, repair, form.label)


LASTING = re.compile(r"\blong(?:er)?\b|\btime\b|\bseconds?\b|\blast|\d\s*m?s\b", re.IGNORECASE)
"""What a title has that speaks of a duration."""


def titled(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, titles. A number in the title of a remedy or trial is one that it writes, or the ratio to that before."""
    titles: list[tuple[Where, str, list[tuple[float, float]]]] = [
        ((*variant.where, "title"), variant.title, _numbers_of(variant, evidence)) for variant in variants(case)[1:]
    ]
    for index, trial in enumerate(case.record.trials):
        changed = list(changed_numbers(case, case.text, trial))
        if trial.duration and case.record.run is not None and LASTING.search(trial.title):
            changed.append((case.record.run.duration, trial.duration))
        changed += [(math.nan, float(n)) for edit in trial.edits for n in WRITTEN.findall(edit.replace)]
        titles.append((("trials", index, "title"), trial.title, changed))
    for where, title, changed in titles:
        code = case.record.run is None  # its number may stand for the inverse: a count of steps for a timestep
        counted = bool(STEPS.search(title)) and not re.search(r"times|twice|half|divide", title, re.IGNORECASE)
        made = {abs(after) for _, after in changed}
        ratios = _ratios(changed, up=code or not LESS.search(title), down=code or not MORE.search(title))
        if counted:
            made, ratios = {abs(after - before) for before, after in changed}, set()
        for number in TITLE.finditer(title):
            after = title[number.end() :]
            multiple = re.match(r"\s(?:times|of)\b", after) or LESS.match(number[0])
            allowed = made if UNIT.match(after) else made | ratios
            if multiple and ratios - {1.0}:
                allowed = ratios
            values = _values(number[0])
            if not any(abs(value - known) <= 1e-6 * abs(value) for value in values for known in allowed):
                wanted = (
                    f"a number or a ratio of what it changes: {listed(sorted(f'{value:g}' for value in allowed), 12)}"
                )
                yield case.problem(where, number[0], wanted, "correct the title", quoted=number[0])


def _numbers_of(variant: Variant, evidence: Evidence) -> list[tuple[float, float]]:
    """The numbers that a remedy replaces, each with one that it writes."""
    changed: list[tuple[float, float]] = []
    for edit in variant.edits:
        before, after = ([float(n) for n in WRITTEN.findall(text)] for text in (edit.find, edit.replace))
        changed += [(a, b) for a in [*before, math.nan] for b in after]
    steps = [evidence.variants[key].timestep for key in ("broken", variant.id)]
    if steps[0] and steps[1]:
        changed.append((steps[0], steps[1]))
    return changed


def _ratios(changed: Iterable[tuple[float, float]], up: bool, down: bool) -> set[float]:
    """How many times larger (`up`) or smaller (`down`) the new numbers are than the old ones."""
    ratios = {abs(after / before) for before, after in changed if up and before}
    ratios |= {abs(before / after) for before, after in changed if down and after}
    return {float(f"{ratio:.9g}") for ratio in ratios if math.isfinite(ratio)}


def _values(number: str) -> list[float]:
    """What a number in a title may stand for: itself, in thousandths, or the factor that it names."""
    words = {"one": 1.0, "twice": 2.0, "double": 2.0, "halve": 2.0, "halving": 2.0, "doubling": 2.0, "dozen": 12.0}
    words |= {word: float(n) for n, word in enumerate(["two", *SMALL.split()[:12]], 2)} | {
        "hundred": 100.0,
        "thousand": 1000.0,
    }
    words |= {
        "fourth": 4.0,
        "fifth": 5.0,
        "tenth": 10.0,
        "hundredth": 100.0,
        "thousandth": 1000.0,
        "half": 2.0,
        "quarter": 4.0,
    }
    if number.lower().startswith("half a"):
        return [0.5]
    word = re.split(r"[- ]", number.lower())[0]
    if word in words:
        return [words[word]]
    try:
        value = float(re.sub(r"[^\d.]", "", number))
    except ValueError:
        return [float("nan")]
    return [value, value / 1000]
