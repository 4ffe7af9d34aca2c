"""Law 5, angles: a part of a turn is that of the number beside it, degrees and radians are those of the file."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

from clinic.engine.quotation import QUOTATION, attributes
from clinic.engine.variant import variants
from clinic.proof.evidence import Evidence
from clinic.proof.prose.comparisons import numbers
from clinic.proof.prose_laws import prose_of
from clinic.record.case import Case
from clinic.record.problem import Problem
from clinic.record.units import unit

TURNS = {"a quarter": math.pi / 2, "half a": math.pi, "three quarters of a": 1.5 * math.pi, "a full": 2 * math.pi}
APPOSITION = re.compile(rf", (?:which is )?({'|'.join(TURNS)}) turn\b")
UNIT = re.compile(r"\{\{([^{}]*)\}\}[^.;:{}]{0,25}?\bin (degrees|radians)\b")
BY_COMPILER = ("range", "ref", "springref", "euler", "axisangle")
ALWAYS = {"qpos": "radians", "fovy": "degrees", "cutoff": "degrees", "azimuth": "degrees"}
CLOSE = 0.02  # of the turn that is said


def angles(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, angles. A part of a turn is the number it is said of; degrees and radians are what the file's are."""
    yield from _turned(case, evidence)
    yield from _measured_in(case)


def _turned(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """A part of a turn that is said of a number is that number."""
    for where, text in prose_of(case):
        flat = " ".join(text.split())
        for one in numbers(flat, evidence):
            found, size = APPOSITION.match(flat, one.end), unit(one.unit)
            if found is None or size is None or one.unit not in ("rad", "°"):
                continue
            if abs(abs(one.value) * size.size - TURNS[found[1]]) > CLOSE * TURNS[found[1]]:
                wanted = f"the part of a turn that {one.value:.4g} {one.unit} are"
                yield case.problem(where, f"{found[1]} turn", wanted, "correct it, or leave it out", found[1])


def _measured_in(case: Case) -> Iterator[Problem]:
    """Degrees and radians that are said of a quoted angle are those that the variant's compiler reads."""
    texts = {variant.id: variant.text for variant in variants(case)}
    for where, text in prose_of(case):
        for found in UNIT.finditer(" ".join(text.split())):
            match = QUOTATION.fullmatch(found[1].partition("|")[0])
            if match is None:
                continue
            asked = match["attributes"].split()
            angle = attributes(texts[match["variant"]], "compiler", None).get("angle", "degree")
            units = {ALWAYS.get(name, f"{angle}s" if name in BY_COMPILER else "") for name in asked} - {""}
            units |= {f"{angle}s"} if "angle" in asked else set()
            if units and units != {found[2]}:
                wanted = f"{' and '.join(sorted(units))}, in which it is read"
                yield case.problem(where, f"in {found[2]}", wanted, "correct the unit", quoted=f"in {found[2]}")
