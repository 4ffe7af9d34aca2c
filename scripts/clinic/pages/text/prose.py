"""Prose of a record made into Markdown: fields filled from the evidence, formulas set as MathML."""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.pages.text.formula import FormulaError, mathml
from clinic.proof.evidence import Evidence, VariantEvidence
from clinic.record.problem import closest, listed
from clinic.record.prose import CODE, CONVERSIONS, FIELD, FORMULA, quantity

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
    if name == "engine" and not filters:
        return evidence.engine
    if name.startswith("sweep."):
        return _sweep_field(name, filters, evidence)
    variant_id, _, rest = name.partition(".")
    if variant_id not in evidence.variants:
        raise _unknown(name, variant_id, evidence.variants, "variant")
    variant = evidence.variants[variant_id]
    if rest == "warning" and not filters:
        if not variant.messages:
            raise FieldError(f"{{{{ {name} }}}}", "a variant that MuJoCo warned about", "remove the field")
        return variant.messages[0]
    value, unit = _value(name, rest, variant)
    return _shown(name, value, unit, filters)


def _sweep_field(name: str, filters: list[str], evidence: Evidence) -> str:
    """`sweep.ID.points`, or one of the fields of Agreement for the prediction or, with its id, for a rival."""
    _, sweep, *rest = name.split(".")
    if sweep not in evidence.sweep:
        raise _unknown(name, sweep, evidence.sweep, "sweep")
    swept = evidence.sweep[sweep]
    if rest == ["points"]:
        return _shown(name, len(swept.points), "", filters)
    which, field = ("prediction", *rest) if len(rest) == 1 else (*rest, "")[:2]
    if which not in swept.agreement:
        raise _unknown(name, which, swept.agreement, "prediction of the sweep")
    numbers = swept.agreement[which].model_dump(exclude={"unit"})
    if numbers.get(field) is None:
        fields = [key for key, known in numbers.items() if known is not None]
        raise _unknown(name, field, ["points", *fields], "field of the sweep")
    return _shown(name, numbers[field], swept.agreement[which].unit if field == "worst" else "", filters)


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


def _value(name: str, rest: str, variant: VariantEvidence) -> tuple[float, str]:
    if rest in ("timestep", "duration") and variant.timestep is not None and variant.steps is not None:
        return (variant.timestep if rest == "timestep" else variant.timestep * variant.steps), "s"
    signal, _, which = rest.partition(".")
    if signal not in variant.values:
        more = ["timestep", "duration", "warning"] if variant.timestep is not None else []
        raise _unknown(name, signal, [*variant.values, *more], "signal")
    if which not in variant.values[signal]:
        raise _unknown(name, which, variant.values[signal], "take")
    value = variant.values[signal][which]
    if value is None:
        raise FieldError(f"{{{{ {name} }}}}", "a number that the run measured", "take another number of the signal")
    return value, "s" if which == "onset" else variant.traces[signal].unit


def _unknown(name: str, word: str, known: object, kind: str) -> FieldError:
    options = list(known)  # type: ignore[call-overload]
    guess = closest(word, options)
    return FieldError(
        f"{{{{ {name} }}}}: {word or 'nothing'} is no {kind}",
        f"a {kind}: {listed(options, 20)}",
        f"write {guess}" if guess else "correct the field",
    )
