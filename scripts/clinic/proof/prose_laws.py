"""Law 5: what prose says is bound to what was run. A quotation names its element, a number its remedy."""

from __future__ import annotations

import contextlib
import re
from collections.abc import Container, Iterator, Sequence
from typing import TYPE_CHECKING

from clinic.engine.quotation import QUOTATION, QuotationError, attributes, quotation
from clinic.engine.variant import Variant, variants
from clinic.record.case import Case
from clinic.record.problem import Problem, listed
from clinic.record.prose import FIELD, FORMULA, bare
from clinic.record.yaml_lines import Where

if TYPE_CHECKING:
    from clinic.proof.evidence import Evidence

PROSE = ("symptom", "diagnosis", "cause", "fix", "lesson")
ELSEWHERE = ("engine", "sweep", "default", "formula", "record")  # what a field begins with that names no variant
SPAN = re.compile(r"`([^`]+)`")
ATTRIBUTE = re.compile(r'([a-z_]+)="[^"]*"')
BARE = re.compile(r"[-+\d.e ]*\d[-+\d.e ]*")
DIGIT = re.compile(r"(?<![\w])\d")
LITERAL = re.compile(r"\d|\\[dt]?frac|\\sqrt|/|\^|\\(?:sin|cos|tan|exp|log)\b")
SUBSCRIPT = re.compile(r"_(?:\w|\{[^{}]*\})|\\neq 0|\^\{?'+\}?")
NEAR = 40  # characters between a word such as *lowest* and the number it is said of
TAKEN = ("final", "first", "min", "max", "mean", "span")
TAKES = (
    (
        r"\b(?:never \w+ (?:above|more)|never passes|never exceeds|at most|highest|largest|grows to)\b"
        r"|\bup to(?: an? \w+ of)?\s*$",
        "max",
    ),
    (r"\b(?:lowest|smallest|at least|never below)\b", "min"),
    (r"\b(?:at first|at the first|in the first|in real time|at the start)\b", "first"),
    (r"\b(?:ends? at|rests? at|comes to rest|at the end)\b", "final"),
)
AFTER = {"most": "max", "least": "min"}
SINGLE = ("visual", "option", "compiler")  # elements of which a model has one
WORD = re.compile(r"[^\W\d_]+")


def quoted(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, quotations. An attribute is a field that names its element; code with a number stands in a file."""
    made = variants(case)
    texts = [variant.text for variant in made] + [
        *case.texts.values(),
        case.record.snippet or "",
        evidence.snippet or "",
    ]
    for where, text in prose_of(case):
        spans = SPAN.findall(FIELD.sub("field", text))
        for attribute in (found for span in spans for found in ATTRIBUTE.finditer(span)):
            if case.record.run is not None:
                repair = f"write a field such as {{{{ {_place_of(made, attribute)} }}}}"
                yield case.problem(where, attribute[0], "an attribute named with its element", repair, attribute[0])
            elif not any(attribute[0] in known for known in texts):
                wanted, repair = "an attribute that some variant has", "correct the quotation"
                yield case.problem(where, attribute[0], wanted, repair, quoted=attribute[0])
        for span in spans:
            code = " ".join(ATTRIBUTE.sub("", span).split())
            if BARE.fullmatch(code):
                repair = "write a field such as {{ broken.signal.final }}, {{ default.geom.solref }}"
                yield case.problem(where, span, "a number from a run, the record or the engine", repair, quoted=span)
            elif DIGIT.search(code) and not any(_stands(code, known) for known in texts):
                wanted = "code that stands in the case's files, its snippet or what this prints"
                yield case.problem(where, code, wanted, "quote it as it stands there, or say it in words", quoted=span)
        for warning in re.findall(r"mjWARN_(\w+)", text):
            if warning not in case.record.warnings:
                wanted = f"what the broken variant raises: {listed(case.record.warnings)}"
                yield case.problem(where, f"mjWARN_{warning}", wanted, "correct the name", quoted=f"mjWARN_{warning}")
        yield from _misnamed(case, made, where, text)


def taken(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, which number. `up to` wants a maximum, `lowest` a minimum; a default is of the attribute that is named."""
    for where, text in prose_of(case):
        for paragraph in re.split(r"\n[ \t]*\n", text):
            for field in FIELD.finditer(paragraph):
                name = field[1].partition("|")[0].strip()
                before = re.split(r"[.;:]\s|\}\}", paragraph[: field.start()])[-1][-NEAR:]
                words = [
                    (m.end(), take) for pattern, take in TAKES for m in re.finditer(pattern, before, re.IGNORECASE)
                ]
                ending = re.match(r"\s+at (most|least)\b", paragraph[field.end() :])
                said, take = max(words)[1] if words else "", name.rpartition(".")[2]
                said = AFTER[ending[1]] if ending else said
                if said and (case.record.run is not None or said == "first") and take in set(TAKEN) - {said}:
                    repair = "correct the field or the words"
                    yield case.problem(where, field[0], f"its `{said}`: so the words say", repair, quoted=field[0])
                if name.startswith("default."):
                    tag, rest = name.split(".")[1], paragraph.replace(field[0], "")
                    lacks = [take] * (take not in rest) + [tag] * (tag not in [*_words(rest), *SINGLE])
                    for lacking in lacks:
                        wanted, repair = f"a paragraph that names {lacking}", "name it, or correct the field"
                        yield case.problem(where, field[0], wanted, repair, quoted=field[0])


def stated(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, formulas. One with a number, a fraction or a function is a field: it is computed and held to the runs."""
    for where, text in prose_of(case):
        for found in FORMULA.finditer(bare(text)):
            formula = " ".join((found["block"] or found["inline"]).split())
            if LITERAL.search(SUBSCRIPT.sub("", formula)):
                wanted = "a formula that is computed: {{ sweep.ID.formula }}, {{ formula.NAME }}"
                yield case.problem(where, f"${formula}$", wanted, "write it under `formulas`", quoted=formula)


def owned(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, whose number. What belongs to a remedy stands where that remedy is spoken of.

    A sentence with fields of several remedies names each of them.
    """
    made = {variant.id: variant for variant in variants(case)}
    for where, text in prose_of(case):
        for sentence in re.split(r"(?<=[.?!])\s|\n[ \t]*\n", text):
            fields = [field[1].strip() for field in FIELD.finditer(sentence)]
            several = {field.partition(".")[0] for field in fields} & made.keys() - {"broken"}
            for name in several if len(several) > 1 else ():
                if f"{name}.title" not in fields and not said_of(name, FIELD.sub("", sentence)):
                    found = f"fields of {listed(sorted(several))} in a sentence"
                    yield case.problem(where, found, f"words of {name}", "name each, or correct the fields", name)
        own = case.record.refuted[where[1]].id if where[0] == "refuted" and isinstance(where[1], int) else "broken"
        only = case.record.fixes[0].id if where == ("fix",) and len(case.record.fixes) == 1 else own
        for paragraph in re.split(r"\n[ \t]*\n", text):
            for field in FIELD.finditer(paragraph):
                name, of = field[1].strip().partition(".")[0], spoken(made, own, paragraph[: field.start()])
                if field[1].strip() == f"{name}.title" and name in made:
                    continue
                if QUOTATION.fullmatch(field[1].partition("|")[0]):
                    apt = made[name].kind == "fix" and where == ("fix",) if name in made else True
                    told = where[0] not in ("symptom", "diagnosis") and _named(name, paragraph, field)
                    if not (apt or told or name in (own, "broken")):
                        repair = f"correct the field, or say {name.replace('-', ' ')!r} in the sentence"
                        yield case.problem(where, field[0], f"an attribute of {own}", repair, quoted=field[0])
                    if name in made and name != "broken" and _same_as_broken(made, field[1]):
                        found, repair = (
                            f"{field[0]}, which {name} leaves as it is",
                            "write broken, or the edit's attribute",
                        )
                        yield case.problem(where, found, f"an attribute that {name} changes", repair, quoted=field[0])
                elif name not in (of, own, only, "broken", *ELSEWHERE) and not _named(name, paragraph, field):
                    wanted = f"a number of {of}" if of == own else f"a number of {of}, of which this speaks"
                    repair = f"correct the field, or say {name.replace('-', ' ')!r} in the sentence"
                    yield case.problem(where, field[0], wanted, repair, quoted=field[0])


def quotations(case: Case) -> Iterator[tuple[Where, str]]:
    """Every attribute quoted in prose, as it is written, with the field's place."""
    for where, text in prose_of(case):
        shown = SPAN.findall(FIELD.sub("field", text))
        for field in FIELD.finditer(text):
            if match := QUOTATION.fullmatch(field[1].partition("|")[0]):
                with contextlib.suppress(QuotationError):  # told where the prose is filled
                    shown.append(quotation(case, match))
        yield from ((where, found[0]) for span in shown for found in ATTRIBUTE.finditer(span))


def prose_of(case: Case) -> Iterator[tuple[Where, str]]:
    """Every prose field of the record with its place."""
    for name in PROSE:
        yield (name,), getattr(case.record, name)
    if case.record.telling is not None:
        yield ("telling", "says"), case.record.telling.says
    for index, remedy in enumerate(case.record.refuted):
        yield ("refuted", index, "why"), remedy.why
    for name, sweep in case.record.sweep.items():
        yield ("sweep", name, "text"), sweep.text


def _place_of(made: Sequence[Variant], attribute: re.Match[str]) -> str:
    """The field that would quote an attribute: `broken.geom(cube).priority`."""
    for variant in made:
        for tag, name in re.findall(r'<([a-z]+)(?: [^>]*?name="([^"]*)")?[^>]*>', variant.text):
            if f'{attribute[1]}="' in attribute[0] and attribute[0] in _shown(variant.text, tag, name or None):
                return f"{variant.id}.{tag}({name}).{attribute[1]}" if name else f"{variant.id}.{tag}.{attribute[1]}"
    return f"VARIANT.TAG(NAME).{attribute[1]}"


def _shown(text: str, tag: str, name: str | None) -> list[str]:
    return [f'{key}="{value}"' for key, value in attributes(text, tag, name).items()]


def _stands(code: str, text: str) -> bool:
    return re.search(rf"(?<!\w){re.escape(code)}(?!\w)", " ".join(text.split())) is not None


def _misnamed(case: Case, made: Sequence[Variant], where: Where, text: str) -> Iterator[Problem]:
    """Quotations after words that name another element, or none."""
    for paragraph in re.split(r"\n[ \t]*\n", text):
        for field in FIELD.finditer(paragraph):
            match = QUOTATION.fullmatch(field[1].partition("|")[0])
            if match is None or match["tag"] is None:
                continue
            texts = [variant.text for variant in made if variant.id in ("broken", match["variant"])]
            names = {name for known in texts for name in re.findall(rf'<{match["tag"]} [^>]*?name="([^"]*)"', known)}
            known_words = {word for name in names for word in _words(name)} | {match["tag"]}
            before = [word for word in _words(bare(paragraph[: field.start()])) if word in known_words]
            if not before or before[-1] not in {*_words(match["name"]), match["tag"]}:
                found = f"{field[0]}, after " + (f"the {before[-1]}" if before else "no element's name")
                repair = "name it before the quotation, or correct the field"
                yield case.problem(
                    where, found, f"{match['name']} or {match['tag']} as the last named", repair, field[0]
                )


def _words(text: str) -> list[str]:
    """The words in small letters and the singular."""
    return [word.removesuffix("s") for word in WORD.findall(text.lower().replace("'s", ""))]


def _named(name: str, paragraph: str, field: re.Match[str]) -> bool:
    """Whether the sentence around a field has the words of a remedy's id."""
    begun = max((m.end() for m in re.finditer(r"[.?!:]\s", paragraph[: field.start()])), default=0)
    ended = re.search(r"[.?!](?:\s|$)", paragraph[field.end() :])
    return said_of(name, FIELD.sub("", paragraph[begun : field.end() + (ended.start() if ended else len(paragraph))]))


def spoken(made: Container[str], own: str, before: str) -> str:
    """The variant that prose speaks of after a text: that of its last title or quoted attribute, else `own`."""
    for field in reversed(list(FIELD.finditer(before))):
        name = field[1].strip().partition(".")[0]
        if field[1].strip() == f"{name}.title" and name in made:
            return name
        if QUOTATION.fullmatch(field[1].partition("|")[0]):
            return own if name == "broken" else name
    return own


def said_of(name: str, text: str) -> bool:
    """Whether a text has the words of a remedy's id."""
    return set(_words(name)) <= set(_words(text))


def _same_as_broken(made: dict[str, Variant], field: str) -> bool:
    match = QUOTATION.fullmatch(field.partition("|")[0])
    assert match is not None
    tag = match["tag"] or match["alone"]
    before, after = (attributes(made[key].text, tag, match["name"]) for key in ("broken", match["variant"]))
    return any(before.get(key) == after.get(key) for key in match["attributes"].split())
