"""Prose of a record made into Markdown: fields filled from the evidence, formulas set as MathML."""

from __future__ import annotations

import html
import math
import re
from collections.abc import Iterator, Mapping
from typing import Any, TypeVar

import latex2mathml.converter

from clinic.engine.quotation import QUOTATION, QuotationError, engine_default, quotation
from clinic.pages.text.markup import escaped
from clinic.proof.evidence import Evidence
from clinic.proof.prose.formulas import sides_as_latex
from clinic.proof.prose_laws import prose_of
from clinic.proof.sweep import SweepEvidence, predictions
from clinic.record.case import Case
from clinic.record.expression import ExpressionError, parse
from clinic.record.latex import latex
from clinic.record.problem import Problem, closest, listed
from clinic.record.prose import CODE, CONVERSIONS, FIELD, FORMULA, quantity, rounded_up

T = TypeVar("T")
LONG_ENOUGH = 150  # characters
NINE_DIGITS = 1e-9  # of what was measured; less is how a machine rounds
PARTS = re.compile(f"{CODE.pattern}|{FORMULA.pattern}|(?P<tag><)", re.DOTALL | re.MULTILINE)


class ProseError(ValueError):
    """A field that resolves to nothing, or a formula that cannot be set: what was found, expected, and the repair."""

    def __init__(self, found: str, expected: str, repair: str) -> None:
        self.found, self.expected, self.repair = found, expected, repair
        super().__init__(found, expected, repair)

    def __str__(self) -> str:
        return f"{self.found}; expected {self.expected}; {self.repair}"


def markdown(text: str, evidence: Evidence, case: Case | None = None) -> str:
    """The prose with its fields filled and its formulas as MathML; a `<` outside code is shown.

    Raises:
        ProseError: For the first field that resolves to nothing, or formula that cannot be set.
    """
    return PARTS.sub(_part, fill(text, evidence, case))


def _part(match: re.Match[str]) -> str:
    if match["block"]:
        return f'\n\n<div class="formula">{_mathml(match["block"], "block")}</div>\n\n'
    if match["inline"]:
        return (
            f"<span>{_mathml(match['inline'], 'inline')}</span>"  # at a line's start Markdown takes <math> for a block
        )
    return match["code"] or "&lt;"


def _mathml(formula: str, display: str) -> str:
    """The formula as a `block` or `inline`, with nothing in it that Markdown would take for its own.

    Its source stands beside it, for the page's Markdown; cleaning takes that out of the HTML.
    """
    formula = " ".join(formula.split())
    try:
        made: str = latex2mathml.converter.convert(formula, display=display)
        return escaped(made.replace("<math ", f'<math alttext="{html.escape(formula)}" ', 1))
    except Exception as error:  # the converter raises many kinds
        repair = "correct it; in text write \\lt for < and a formula's braces in pairs"
        raise ProseError(f"${formula}$: {str(error) or type(error).__name__}", "a LaTeX formula", repair) from None


def fill(text: str, evidence: Evidence, case: Case | None = None) -> str:
    """The text with every `{{ field | filter }}` replaced.

    Raises:
        ProseError: For the first field that resolves to nothing.
    """
    return FIELD.sub(lambda match: resolve(match[1], evidence, case), text)


def opening(case: Case, evidence: Evidence) -> str:
    """The first sentences of the symptom, until they are long enough to say something."""
    words = " ".join(fill(case.record.symptom, evidence, case).replace("`", "").split())
    kept = ""
    for sentence in re.split(r"(?<=[.?!]) ", words):
        kept = f"{kept} {sentence}".strip()
        if len(kept) >= LONG_ENOUGH:
            break
    return kept


def prose_problems(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Every field and formula of the prose that cannot be shown."""
    reasons = [(("exempt", law), reason) for law, reason in case.record.exempt.items()]
    for where, text in [*prose_of(case), *reasons]:
        for error in mistakes(text, evidence, case):
            quoted = error.found.partition(": ")[0]
            yield case.problem(where, error.found, error.expected, error.repair, quoted)


def mistakes(text: str, evidence: Evidence, case: Case | None = None) -> Iterator[ProseError]:
    """Every field of the text that is not closed or resolves to nothing, and every formula that cannot be set."""
    for match in FIELD.finditer(text):
        try:
            resolve(match[1], evidence, case)
        except ProseError as error:
            yield error
    filled = FIELD.sub("1", text)
    if (begun := filled.find("{{")) >= 0:
        opened = filled[begun:].partition("\n")[0]
        yield ProseError(opened[:40], "a field that is closed: {{ ... }}", "close it with }}")
    for match in PARTS.finditer(filled):
        try:
            _part(match)
        except ProseError as error:
            yield error


def resolve(field: str, evidence: Evidence, case: Case | None = None) -> str:
    """The text for one field: `broken.height.final | mm`, or what `case` has, such as `broken.geom(cube).priority`.

    Raises:
        ProseError: If it resolves to nothing.
    """
    name, *filters = (part.strip() for part in field.split("|"))
    value, unit = (None if case is None else _written(name, case)) or _measured(name, evidence)
    if isinstance(value, float) and name.startswith("sweep.") and name.endswith(".worst"):
        value = max(value, _least(name, evidence, case)) if value else value
    if value is None:
        raise ProseError(f"{{{{ {name} }}}}", "what the run measured", "name something else, or remove the field")
    return value if isinstance(value, str) else _shown(name, value, unit, filters)


def nine_digits(swept: SweepEvidence, relative: bool) -> float:
    """The error of a prediction that is right to nine digits, as a power of ten."""
    largest = max((abs(point.outcome) for point in swept.points if point.outcome), default=0.0)
    scale = 1.0 if relative or not largest else largest
    return float(10.0 ** math.ceil(math.log10(scale * NINE_DIGITS) - 1e-9))


def _least(name: str, evidence: Evidence, case: Case | None) -> float:
    """The least error of a sweep's prediction, `sweep.ID.RIVAL.worst`, that says more than how a machine rounds."""
    _, sweep, *which, _ = name.split(".")
    key, swept = ".".join(which) or "prediction", evidence.sweep[sweep]
    share = not swept.agreement[key].unit if case is None else predictions(case.record.sweep[sweep])[key].relative
    return nine_digits(swept, share)


def _written(name: str, case: Case) -> tuple[float | str, str] | None:
    """What is not measured: `VARIANT.TAG(NAME).ATTRIBUTE`, `default.PATH`, `formula.NAME`, `record.PATH`; else None."""
    first, _, rest = name.partition(".")
    try:
        if match := QUOTATION.fullmatch(name):
            return f"`{quotation(case, match)}`", ""
        if first == "default":
            return engine_default(rest), ""
    except QuotationError as error:
        raise ProseError(f"{{{{ {name} }}}}: {error.found}", error.expected, error.repair) from None
    if first == "formula":
        formula, _, side = rest.partition(".")
        known = _known(name, formula, case.record.formulas, "formula")
        try:
            return _known(name, side or "whole", sides_as_latex(known.says), "side"), ""
        except ExpressionError as error:
            raise ProseError(f"{{{{ {name} }}}}: {known.says}", str(error), "correct the equation") from None
    if first == "sweep" and rest.endswith(".formula"):
        sweep, *rival = rest.removesuffix(".formula").split(".")
        forms = predictions(_known(name, sweep, case.record.sweep, "sweep"))
        return latex(parse(_known(name, ".".join(rival) or "prediction", forms, "prediction of the sweep").expr)), ""
    if first == "record":
        value: Any = case.record.model_dump()
        for part in rest.split("."):
            fields = value if isinstance(value, dict) else {str(k): each for k, each in enumerate(value)}
            value = _known(name, part, fields, "field")
            if not isinstance(value, dict | list | tuple | int | float):
                break
        return (value, "") if isinstance(value, int | float) else None
    return None


def _measured(name: str, evidence: Evidence) -> tuple[float | str | None, str]:
    """A number with its unit, or a text: `engine`, `VARIANT.SIGNAL.TAKE`, `sweep.ID.points`, `sweep.ID.RIVAL.worst`."""
    first, _, rest = name.partition(".")
    if name == "engine":
        return evidence.engine, ""
    if first == "sweep":
        sweep, *which, field = rest.split(".") if "." in rest else (rest, "")
        swept = _known(name, sweep, evidence.sweep, "sweep")
        if field == "points":
            return len(swept.points), ""
        agreement = _known(name, ".".join(which) or "prediction", swept.agreement, "prediction of the sweep")
        numbers = {key: number for key, number in agreement.model_dump(exclude={"unit"}).items() if number is not None}
        number: float = _known(name, field, {"points": 0, **numbers}, "field of the sweep")
        return number, agreement.unit if field == "worst" else ""
    variant = _known(name, first, evidence.variants, "variant")
    if rest == "title":
        return variant.title, ""
    own: dict[str, tuple[float | str | None, str]] = {}
    if variant.timestep is not None and variant.steps is not None:
        own = {"timestep": (variant.timestep, "s"), "duration": (variant.timestep * variant.steps, "s")}
        own["warning"] = (next(iter(variant.messages), None), "")
    if rest in own:
        return own[rest]
    signal, _, take = rest.partition(".")
    takes = _known(name, signal, {**variant.values, **{key: {} for key in own}}, "signal")
    return _known(name, take, takes, "take"), "s" if take == "onset" else variant.traces[signal].unit


def _shown(name: str, value: float, unit: str, filters: list[str]) -> str:
    digits = 3
    for conversion in filters:
        if re.fullmatch(r"[1-9][0-9]?", conversion):
            digits = int(conversion)
        elif conversion in CONVERSIONS and CONVERSIONS[conversion][0] == unit:
            _, factor, unit = CONVERSIONS[conversion]
            value *= factor
        else:
            fitting = [key for key, (source, _, _) in CONVERSIONS.items() if source == unit]
            expected = f"{listed([*fitting, '2', '3'])}, ...: the digits to keep"
            raise ProseError(f"the filter {conversion} on {name} in {unit or 'no unit'}", expected, "change the filter")
    if name.startswith("sweep.") and name.endswith(".worst"):
        value = rounded_up(value, digits)
    return quantity(value, unit, digits)


def _known(name: str, word: str, known: Mapping[str, T], kind: str) -> T:
    if word in known:
        return known[word]
    guess = closest(word, known)
    repair = f"write {guess}" if guess else "correct the field"
    raise ProseError(f"{{{{ {name} }}}}: {word or 'nothing'} is no {kind}", f"a {kind}: {listed(known, 20)}", repair)
