"""Whether each sentence of a case's prose is shown by something: code that runs, MuJoCo's manual, its own numbers."""

from __future__ import annotations

import difflib
import json
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import mujoco
import yaml

from clinic.engine.script import ScriptError, run_script
from clinic.engine.variant import variants
from clinic.proof.evidence import Evidence
from clinic.proof.procedure import procedure
from clinic.proof.prose.absences import comments
from clinic.proof.prose.plain import plain_label, plain_title, printed_labels
from clinic.proof.prose_laws import prose_of
from clinic.proof.releases import on_releases
from clinic.record.case import Case
from clinic.record.claims import flat, sentences
from clinic.record.fields import WORDS
from clinic.record.problem import Problem
from clinic.record.prose import FIELD
from clinic.record.yaml_lines import Where

DRIVER = '''
import contextlib, io, json, pathlib, re, sys, traceback
import mujoco
import numpy as np
from clinic.record.expression import evaluate, parse

given = json.load(open("claims.json"))
shown = {name: given[name] for name in ("text", "measured", "output", "printed", "record", "releases")}
text, keyframe = given["text"], given["keyframe"]


def load(variant="broken"):
    """The model of a variant, or of a text, and its data at the record's start, after mj_forward."""
    model = mujoco.MjModel.from_xml_string(text.get(variant, variant))
    data = mujoco.MjData(model)
    if keyframe is not None:
        mujoco.mj_resetDataKeyframe(model, data, model.key(keyframe).id)
    mujoco.mj_forward(model, data)
    return model, data


def formula(name, **symbols):
    """The right side of an equation of the record, for these values of its symbols."""
    return evaluate(parse(re.split("[=~]", given["formulas"][name])[-1]), symbols)


def told(variant="broken"):
    """What the record's `telling` measures of a variant, or of a text; nan where nothing is."""
    pathlib.Path("asked.xml").write_text(text.get(variant, variant))
    sys.argv = ["which.py", "asked.xml"]
    with contextlib.redirect_stdout(io.StringIO()) as out:
        exec(compile(given["procedure"], "which.py", "exec"), {})
    found = re.search(r"^[a-z0-9-]+ = ([^\\s,]+)", out.getvalue(), re.MULTILINE)
    return float(found[1]) if found else np.nan


mujoco.set_mju_user_warning(lambda said: None)
names = dict(mujoco=mujoco, np=np, re=re, load=load, formula=formula, told=told, **shown)
wrong = {}
for number, code in given["codes"].items():
    try:
        with contextlib.redirect_stdout(io.StringIO()):
            exec(compile(code, "claim.py", "exec"), dict(names))
    except BaseException as error:
        frames = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == "claim.py"]
        line = code.splitlines()[frames[-1] - 1].strip() if frames else ""
        wrong[number] = f"{type(error).__name__}: {str(error) or line}"
print(json.dumps(wrong))
'''
MARKS = re.compile(r"^\s*(?:#|//|/\*|<!--|[\"']+)\s*|\s*(?:\*/|-->|[\"']+)\s*$")
ROLE = re.compile(r":[\w:+-]+:`([^`<]*?)\s*(?:<[^>]*>)?`")
MARKUP = re.compile(r"[`*]|(?<=\w)_(?=\s|$)|\\")


def unshown(case: Case, evidence: Evidence) -> dict[int, str]:
    """The claims of a case whose code does not hold, by their number, with what it says."""
    codes = {k: claim.python for k, claim in enumerate(case.claims.claims) if claim.python} if case.claims else {}
    if not codes:
        return {}
    taken = {
        f"{variant}.{signal}.{which}": value
        for variant, shown in evidence.variants.items()
        for signal, values in shown.values.items()
        for which, value in values.items()
    }
    given = {
        "codes": codes,
        "text": {variant.id: variant.text for variant in variants(case)},
        "measured": taken,
        "output": {name: shown.output for name, shown in evidence.variants.items()},
        "printed": evidence.snippet,
        "record": case.record.model_dump(mode="json", exclude=WORDS),
        "releases": {
            release: {name: behaviour.model_dump() for name, behaviour in seen.items()}
            for release, seen in on_releases(case).items()
        },
        "keyframe": case.record.run.keyframe if case.record.run else None,
        "formulas": {name: formula.says for name, formula in case.record.formulas.items()},
        "procedure": procedure(case.record.family, [case]) if case.record.family else "",
    }
    try:
        said = json.loads(run_script(DRIVER, {**case.texts, "claims.json": json.dumps(given)}, "driver.py", 60))
    except ScriptError as error:
        return dict.fromkeys(codes, error.found)
    return {int(number): each for number, each in said.items()}


def claimed(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, sentences. Each is in `claims.yaml`, and what is named there shows it."""
    if case.claims is None:
        return
    listed = case.claims.sentences
    known = dict(_said(case))
    left = [sentence for sentence in listed if sentence not in known]
    for sentence, where in known.items():
        if sentence not in listed:
            near = difflib.get_close_matches(sentence, left, n=1, cutoff=0.6)
            left = [each for each in left if each not in near]
            found = f"a sentence that nothing is named for: {sentence!r}"
            expected = _shown_by(case, near[0]) if near else "a sentence of claims.yaml"
            repair = "see whether that shows it, and write it there, or correct the sentence"
            yield case.problem(where, found, expected, repair, quoted=sentence)
    for k, claim in enumerate(case.claims.claims):
        place = ("claims", k)
        if claim.manual is not None and claim.quote is not None:
            text = manual_text(claim.manual)
            if text is None:
                yield case.claim_problem(place, claim.manual, "a page of the manual", "correct the page")
            elif text and plain(claim.quote) not in text:
                yield case.claim_problem(place, claim.quote, f"words of {claim.manual}", "quote it to the letter")
        elif k in (evidence.claims or {}):
            found = f"{flat(claim.says)!r} is not shown: {(evidence.claims or {})[k]}"
            yield case.claim_problem(place, found, "code that holds", "correct the sentence, or its code")
    for kind in ("claims", "measured", "advice"):
        for k, each in enumerate(getattr(case.claims, kind)):
            sentence = flat(each if isinstance(each, str) else each.says)
            if sentence in left:
                found = f"{sentence!r}, which the record does not say"
                yield case.claim_problem((kind, k), found, "a sentence of the record", "remove it, or correct it")


def _said(case: Case) -> Iterator[tuple[str, Where]]:
    """Every sentence of the prose and of the reasons, every title, label, comment, equation and measurement of a cause,
    and what the code prints beside its numbers, each with its field.

    Labels and titles that say no more than their path and their edits are left out.
    """
    record = case.record
    for where, text in (*prose_of(case), *_reasons(case)):
        yield from ((sentence, where) for sentence in sentences(text))
    yield record.title, ("title",)
    if (telling := record.telling) is not None:
        if telling.cause:
            yield telling.cause, ("telling", "cause")
        if telling.expr:
            bound = f"above {telling.above:g}" if telling.above is not None else f"below {telling.below:g}"
            yield flat(f"{telling.expr} {bound}"), ("telling", "expr")
    for name, each in record.formulas.items():
        symbols = ", ".join(f"{symbol} is {text}" for symbol, text in each.where.items())
        yield flat(f"{each.says}, where {symbols}"), ("formulas", name, "says")
    for name, signal in record.signals.items():
        if signal.label and not plain_label(case, name):
            yield flat(signal.label), ("signals", name, "label")
    for variant in variants(case)[1:]:
        if not plain_title(case, variant):
            yield flat(variant.title), (*variant.where, "title")
    for index, trial in enumerate(record.trials):
        yield trial.title, ("trials", index, "title")
    for name, sweep in record.sweep.items():
        yield sweep.title, ("sweep", name, "title")
        yield sweep.prediction.label, ("sweep", name, "prediction")
        yield from ((each.label, ("sweep", name, "vary", k)) for k, each in enumerate(sweep.vary) if each.label)
        yield from ((each.label, ("sweep", name, "rivals", k)) for k, each in enumerate(sweep.rivals))
    snippet = "snippet.mjs" if record.language == "javascript" else "snippet.py"
    for file, text in {**case.texts, snippet: record.snippet or ""}.items():
        if file.endswith((".py", ".mjs", ".xml")):
            place = "snippet" if file == snippet else "script" if record.script else "model"
            for _, comment in comments(file, text):
                yield from ((sentence, (place,)) for sentence in sentences(MARKS.sub("", comment)))
        if file.endswith(".py"):
            yield from ((label, (place,)) for label in printed_labels(text))


def _reasons(case: Case) -> Iterator[tuple[Where, str]]:
    """Every reason that the record gives for what is not so, with its place."""
    record = case.record
    yield from ((("loose", text), reason) for text, reason in (record.loose or {}).items())
    yield from ((("older", release), reason) for release, reason in record.older.items())
    yield from ((("fixes", k, "redundant"), fix.redundant) for k, fix in enumerate(record.fixes) if fix.redundant)
    yield from ((("sweep", name, "apart"), each.apart) for name, each in record.sweep.items() if each.apart)
    if record.telling is not None:
        yield from ((("telling", "still", fix), reason) for fix, reason in record.telling.still.items())
    if record.no_sweep is not None:
        yield ("no_sweep",), record.no_sweep


def missing(case: Case) -> str:
    """The sentences that the claims lack, as YAML; those without a field as claims, to be shown or to be moved."""
    listed = case.claims.sentences if case.claims else []
    lacking = [sentence for sentence in dict(_said(case)) if sentence not in listed]
    groups = {
        "claims": [{"says": s, "python": "assert ..."} for s in lacking if not FIELD.search(s)],
        "measured": [s for s in lacking if FIELD.search(s)],
    }
    return "".join(
        yaml.safe_dump({kind: group}, allow_unicode=True, width=110, sort_keys=False)
        for kind, group in groups.items()
        if group
    )


def _shown_by(case: Case, sentence: str) -> str:
    """What shows a sentence of the claims, in words."""
    assert case.claims is not None
    for claim in case.claims.claims:
        if flat(claim.says) == sentence:
            shown = f"the manual: {claim.quote!r}" if claim.quote else "code that holds"
            return f"as in claims.yaml, where it is {sentence!r}, shown by {shown}"
    return f"as in claims.yaml, where it is {sentence!r}"


@cache
def manual_text(page: str) -> str | None:
    """The words of a page of the manual; None where there is no such page, empty where there is no manual."""
    doc = Path(mujoco.__file__).parent / "doc"
    file = (doc / page.partition("#")[0]).with_suffix(".rst")
    if not doc.is_dir():
        return ""
    return plain(file.read_text(encoding="utf-8")) if file.is_file() else None


def plain(text: str) -> str:
    """Words without the marks of reStructuredText, flat."""
    return flat(MARKUP.sub("", ROLE.sub(r"\1", text)))
