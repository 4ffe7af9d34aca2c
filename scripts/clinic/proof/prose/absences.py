"""Law 5, what there is and is not: what prose denies, the functions that it names, and what it says of ever."""

from __future__ import annotations

import functools
import io
import re
import tokenize
from collections.abc import Iterator
from functools import cache

import mujoco

from clinic.engine.variant import variants
from clinic.proof.evidence import Evidence
from clinic.proof.prose.numbers import NUMBER
from clinic.proof.prose_laws import prose_of, said_of
from clinic.record.case import Case
from clinic.record.problem import Problem
from clinic.record.prose import FIELD, bare

DENIED = re.compile(r"\bno\s+`([a-z_]+)`|\bno\s+(motor|servo|equality|tendon|sensor|keyframe|damper)\b", re.IGNORECASE)
ELEMENT = {"motor": "<motor", "servo": "<position", "equality": "<equality", "tendon": "<tendon", "sensor": "<sensor"}
ELEMENT |= {"keyframe": "<keyframe", "damper": 'damping="'}
NO_WARNING = re.compile(r"\bno\s+(?:error\s+and\s+no\s+)?warning\b", re.IGNORECASE)
FUNCTIONS = {"sine": "sin(", "cosine": "cos(", "logarithm": "log(", "exponential": "exp("}
FUNCTION = re.compile(rf"\b({'|'.join(FUNCTIONS)})s?\b", re.IGNORECASE)
EVER = re.compile(r"\b(?:always|never|in (?:each|every|any) case|impossible)\b", re.IGNORECASE)
NAME = re.compile(r"`((?:(?:data|model|mujoco)\.)?[a-z_]+)`|`(mj[A-Za-z]*_\w+)`")
KIND = re.compile(
    r"\b(free|ball|slide)\s+joint|\b(position|velocity)\s+(?:servo|actuator)s?\b|"
    r"\b(force|torque|touch)\s+sensor",
    re.IGNORECASE,
)
CHOSEN = re.compile(r"\bdefault\b[^.;:]{0,40}?\b(elliptic|RK4|Runge|implicit\w*|PGS|CG)\b")
ELSEWHERE = ("nan", "undefined", "null", "inf")
OPEN = ("symptom", "diagnosis", "cause")


def denied(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, absence. What prose says the broken variant has none of is not in its files, and it raises no warning."""
    texts = "\n".join(case.texts.values())
    for where, text in prose_of(case):
        if where[0] not in OPEN:
            continue
        for found in DENIED.finditer(FIELD.sub("", text)):
            name = (found[1] or found[2]).lower()
            sought = f'{name}="' if found[1] else ELEMENT[name]
            if sought in texts:
                yield case.problem(where, found[0], f"files without {sought}", "correct the sentence", found[0])
        if case.record.warnings and where == ("symptom",) and (silent := NO_WARNING.search(text)):
            wanted = f"the warning that it raises: {case.record.warnings[0]}"
            yield case.problem(where, silent[0], wanted, "correct the sentence", silent[0])


def named(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, names. A bare name in code is of the case's files, its snippet or what it measures.

    A name that a remedy brings stands where that remedy is spoken of; one of MuJoCo's besides is among `mentions`.
    """
    record, used = case.record, set[str]()
    measured = record.model_dump_json(include={"signals", "telling", "sweep", "trials", "run", "warnings"})
    own = _names(*case.texts.values(), record.snippet or "", evidence.snippet or "", measured)
    brought = {
        each.id: _names(each.id, *(edit.replace for edit in each.edits)) for each in (*record.fixes, *record.refuted)
    }
    for where, text in prose_of(case):
        told = record.refuted[where[1]].id if where[0] == "refuted" and isinstance(where[1], int) else ""
        for paragraph in re.split(r"\n[ \t]*\n", text):
            spoken = {told, *(field[1].strip().partition(".")[0] for field in FIELD.finditer(paragraph))}
            there = own.union(*(names for key, names in brought.items() if key in spoken or said_of(key, paragraph)))
            for span in (found[1] or found[2] for found in NAME.finditer(FIELD.sub("1", paragraph))):
                word = span.rpartition(".")[2]
                if word in there or word in ELSEWHERE:
                    continue
                used.add(word)
                if word not in vocabulary():
                    wanted = "a name of the case's files, of its snippet, of MuJoCo or of MJCF"
                    yield case.problem(where, span, wanted, "correct the name", span)
                elif word not in record.mentions:
                    wanted = "a name that the case's files, its snippet or the remedy that is spoken of has"
                    repair = f"correct the name, or put {word} into `mentions`"
                    yield case.problem(where, span, wanted, repair, span)
    for word in record.mentions:
        if word not in used:
            yield case.problem(("mentions",), word, "a name in prose that stands in no file", "remove it", word)


def _names(*texts: str) -> set[str]:
    return {word for text in texts for word in re.findall(r"[\w-]+", text)}


def kinds(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, kinds. A free joint, a velocity servo, a touch sensor that prose names is in a file, or in the snippet."""
    known = "\n".join([*case.texts.values(), case.record.snippet or "", *(variant.text for variant in variants(case))])
    for where, text in prose_of(case):
        said = bare(text)
        for found in KIND.finditer(said):
            kind = next(filter(None, found.groups())).lower()
            if not any(form in known for form in (f'type="{kind}"', f"<{kind}joint", f"<{kind} ")):
                wanted = f'files with <{kind}> or type="{kind}"'
                yield case.problem(where, found[0], wanted, "correct the sentence", found[0])
        for found in CHOSEN.finditer(said):
            wanted = "MuJoCo's default: a pyramidal cone, the integrator Euler, the solver Newton"
            yield case.problem(where, found[1], wanted, "correct the sentence", found[1])


@cache
def vocabulary() -> frozenset[str]:
    """The names of MJCF, and of MuJoCo's functions, enumerations, fields and classes; a few of other languages."""
    classes = [mujoco.MjData, mujoco.MjModel, mujoco.MjOption, mujoco.MjStatistic, mujoco.MjVisual, mujoco.MjContact]
    classes += [getattr(mujoco, name) for name in dir(mujoco) if name.startswith("mjt")]
    known = {*re.findall(r"\w+", mujoco.mj_printSchema(False, False)), *dir(mujoco), *dir(mujoco.Renderer), *ELSEWHERE}
    return frozenset(known.union(*(dir(each) for each in classes)))


def functional(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, functions. A sine, cosine, ... in prose is one that a formula, a sweep, its legend or the snippet has."""
    record = case.record
    known = record.model_dump_json(include={"formulas", "signals", "snippet"})
    known += "".join(sweep.model_dump_json(exclude={"text", "title"}) for sweep in record.sweep.values())
    known += "".join(case.texts.values())
    for where, text in prose_of(case):
        for found in FUNCTION.finditer(bare(text)):
            word = found[1].lower()
            if not re.search(rf"(?<![a-z]){re.escape(FUNCTIONS[word])}|\b{word}\b", known):
                wanted = "a function that a formula, a sweep or the snippet computes"
                yield case.problem(where, found[0], wanted, "correct it, or write it under `formulas`", found[0])


def bold(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, no claim wider than what was run. *Always* and *never* stand in a sentence with a number of a run."""
    for where, text in prose_of(case):
        for sentence in re.split(r"(?<=[.?!])\s|\n[ \t]*\n", text):
            if (found := EVER.search(bare(sentence))) and not FIELD.search(sentence):
                wanted, repair = "a sentence with the number that shows it", "say what was seen, or add the number"
                yield case.problem(where, found[0], wanted, repair, found[0])


def commented(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, comments. A number in a comment or a docstring of the case's code stands in the code as well."""
    snippet = "snippet.mjs" if case.record.language == "javascript" else "snippet.py"
    for name, text in {**case.texts, snippet: case.record.snippet or ""}.items():
        told = list(comments(name, text))
        code = functools.reduce(lambda left, comment: left.replace(comment[1], ""), told, text)
        for line, comment in told:
            for found in NUMBER.finditer(comment):
                if re.search(rf"(?<![\w.]){re.escape(found[0])}(?![\w.])", code):
                    continue
                wanted, repair = "a number that stands in the code", "say it without a number"
                said = f"{found[0]!r} in a comment"
                if name == snippet:
                    yield case.problem(("snippet",), said, wanted, repair, quoted=found[0])
                else:
                    yield Problem(f"cases/{case.slug}/{name}", line, "", said, wanted, repair)


def comments(name: str, text: str) -> Iterator[tuple[int, str]]:
    """The comments and docstrings of a file, each with the line where it begins."""
    if name.endswith(".py"):
        previous, depth = tokenize.NEWLINE, 0
        for token in tokenize.generate_tokens(io.StringIO(text).readline):
            starts = previous in (tokenize.NEWLINE, tokenize.INDENT, tokenize.NL) and not depth
            if token.type == tokenize.COMMENT or (token.type == tokenize.STRING and starts):
                yield token.start[0], token.string
            previous = token.type
            depth += (token.string in ("(", "[", "{")) - (token.string in (")", "]", "}"))
        return
    pattern = r"//[^\n]*|/\*.*?\*/" if name.endswith(".mjs") else r"<!--.*?-->"
    for found in re.finditer(pattern, text, re.DOTALL):
        yield text.count("\n", 0, found.start()) + 1, found[0]
