"""Prose of a record made into Markdown: fields filled from the evidence, formulas set as MathML."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import TypeVar

from clinic.pages.text.formula import FormulaError, mathml
from clinic.proof.evidence import Evidence
from clinic.proof.prose_laws import prose_of
from clinic.record.case import Case
from clinic.record.problem import Problem, closest, listed
from clinic.record.prose import CODE, CONVERSIONS, FIELD, FORMULA, quantity

T = TypeVar("T")
PARTS = re.compile(f"{CODE.pattern}|{FORMULA.pattern}|(?P<tag><)", re.DOTALL | re.MULTILINE)


class FieldError(ValueError):
    """A template field that resolves to nothing: what was found, expected, and the repair."""

    def __init__(self, found: str, expected: str, repair: str) -> None:
        self.found, self.expected, self.repair = found, expected, repair
        super().__init__(found, expected, repair)

    def __str__(self) -> str:
        return f"{self.found}; expected {self.expected}; {self.repair}"


def markdown(text: str, evidence: Evidence) -> str:
    """The prose with its fields filled and its formulas as MathML; a `<` outside code is shown.

    Raises:
        FieldError: For the first field that resolves to nothing.
        FormulaError: For the first formula that cannot be set.
    """
    return PARTS.sub(_part, fill(text, evidence))


def _part(match: re.Match[str]) -> str:
    if match["block"]:
        return f'\n\n<div class="formula">{mathml(match["block"], "block")}</div>\n\n'
    if match["inline"]:
        return mathml(match["inline"], "inline")
    return match["code"] or "&lt;"


def fill(text: str, evidence: Evidence) -> str:
    """The text with every `{{ field | filter }}` replaced.

    Raises:
        FieldError: For the first field that resolves to nothing.
    """
    return FIELD.sub(lambda match: resolve(match[1], evidence), text)


def prose_problems(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Every field and formula of the prose that cannot be shown."""
    reasons = [(("exempt", law), reason) for law, reason in case.record.exempt.items()]
    for where, text in [*prose_of(case), *reasons]:
        for error in mistakes(text, evidence):
            quoted = error.found.partition(": ")[0]
            yield case.problem(where, error.found, error.expected, error.repair, quoted)


def mistakes(text: str, evidence: Evidence) -> Iterator[FieldError | FormulaError]:
    """Every field of the text that is not closed or resolves to nothing, and every formula that cannot be set."""
    for match in FIELD.finditer(text):
        try:
            resolve(match[1], evidence)
        except FieldError as error:
            yield error
    filled = FIELD.sub("1", text)
    if (begun := filled.find("{{")) >= 0:
        opened = filled[begun:].partition("\n")[0]
        yield FieldError(opened[:40], "a field that is closed: {{ ... }}", "close it with }}")
    for match in PARTS.finditer(filled):
        try:
            _part(match)
        except FormulaError as error:
            yield error


def resolve(field: str, evidence: Evidence) -> str:
    """The text for one field, such as `broken.height.final | mm`.

    Raises:
        FieldError: If it resolves to nothing.
    """
    name, *filters = (part.strip() for part in field.split("|"))
    value, unit = _measured(name, evidence)
    if value is None:
        raise FieldError(f"{{{{ {name} }}}}", "what the run measured", "name something else, or remove the field")
    return value if isinstance(value, str) else _shown(name, value, unit, filters)


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
            raise FieldError(f"the filter {conversion} on {name} in {unit or 'no unit'}", expected, "change the filter")
    return quantity(value, unit, digits)


def _known(name: str, word: str, known: Mapping[str, T], kind: str) -> T:
    if word in known:
        return known[word]
    guess = closest(word, known)
    repair = f"write {guess}" if guess else "correct the field"
    raise FieldError(f"{{{{ {name} }}}}: {word or 'nothing'} is no {kind}", f"a {kind}: {listed(known, 20)}", repair)
