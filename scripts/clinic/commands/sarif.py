"""Diagnoses as SARIF 2.1.0, which code hosts and editors show beside the lines that it names."""

from __future__ import annotations

import difflib
import hashlib
import math
import os
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any
from urllib.parse import quote

from clinic.diagnosis.edit import apply
from clinic.diagnosis.finding import SITE, Diagnosis, Finding
from clinic.diagnosis.rules import rules

SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"
LEVELS = {"cause": "error", "hint": "note"}
Json = dict[str, Any]


def sarif(found: Sequence[tuple[str, Diagnosis]], failed: Sequence[str], version: str) -> Json:
    """A log with one run.

    Args:
        found: Diagnoses, each with the folder of its model, as seen from the current one.
        failed: What could not be diagnosed, in a sentence each.
        version: Of the clinic.
    """
    told = [(folder, made, each) for folder, made in found for each in (*made.causes, *made.hints, *made.silenced)]
    ids = sorted({each.rule for _, _, each in told})
    failures = [*failed, *(f"{made.file}: {made.error.strip()}" for _, made in found if made.error and not made.causes)]
    driver = {"name": "clinic diagnose", "version": version, "rules": [_rule(rule, told) for rule in ids]}
    if site := os.environ.get(SITE, ""):
        driver["informationUri"] = site
    invocation: Json = {"executionSuccessful": not failures}
    if failures:
        invocation["toolExecutionNotifications"] = [{"level": "error", "message": {"text": each}} for each in failures]
    results = [_result(each, made, folder, ids.index(each.rule)) for folder, made, each in told]
    run = {
        "tool": {"driver": driver},
        "columnKind": "unicodeCodePoints",
        "invocations": [invocation],
        "results": results,
    }
    return {"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}


def path_of(folder: str, file: str) -> str:
    """A model's file as seen from the current folder, with slashes; whole where it lies outside."""
    path = os.path.relpath(os.path.join(folder, file))
    return Path(os.path.abspath(path) if path.startswith("..") else path).as_posix()


def _uri(folder: str, file: str) -> Json:
    path = path_of(folder, file)
    return {"uri": Path(path).as_uri()} if os.path.isabs(path) else {"uri": quote(path), "uriBaseId": "%SRCROOT%"}


def _rule(rule: str, told: Sequence[tuple[str, Diagnosis, Finding]]) -> Json:
    """A rule as the log describes it; what is said of no rule is described by its title."""
    known = rules().get(rule)
    first = next(each for _, _, each in told if each.rule == rule)
    said: Json = {"id": rule, "shortDescription": {"text": known.title if known else first.title}}
    if known:
        said["fullDescription"] = {"text": known.text.partition("\n\n")[0].replace("\n", " ")}
        said["help"] = {"text": known.text, "markdown": known.text}
        said["properties"] = {"tags": list(known.families)}
    if first.page:
        said["helpUri"] = first.page
    return said


def _result(found: Finding, made: Diagnosis, folder: str, index: int) -> Json:
    result: Json = {
        "ruleId": found.rule,
        "ruleIndex": index,
        "level": LEVELS[found.level],
        "message": {"text": message(found)},
        "locations": [
            {
                "physicalLocation": {
                    "artifactLocation": _uri(folder, found.file),
                    "region": {"startLine": found.line or 1},
                },
                "logicalLocations": [{"name": each, "kind": "element"} for each in found.elements],
            }
        ],
        "partialFingerprints": {"clinic/v1": _fingerprint(found)},
    }
    if found.edit:
        after = apply(made.texts, found.edit)
        changes = [
            {"artifactLocation": _uri(folder, file), "replacements": replaced}
            for file, text in made.texts.items()
            if (replaced := _replacements(text, after[file]))
        ]
        text = "; ".join(each.told() for each in found.edit)
        result["fixes"] = [{"description": {"text": text}, "artifactChanges": changes}]
    if found.silenced:
        result["suppressions"] = [{"kind": "inSource", "justification": found.silenced}]
    measured = {"before": found.before, "after": found.after}
    if found.probe:
        kept = {name: value for name, value in measured.items() if value is not None and math.isfinite(value)}
        result["properties"] = {"probe": found.probe, "unit": found.unit, **kept}
    return result


def message(found: Finding) -> str:
    """What a finding says, in one paragraph."""
    change = f" Edit: {'; '.join(each.told() for each in found.edit[:3])}" if found.edit else ""
    return f"{': '.join(filter(None, (found.title, ', '.join(found.elements))))}. {found.says}{change}"


def _fingerprint(found: Finding) -> str:
    """What stays the same where lines are moved."""
    return hashlib.sha256("\n".join((found.rule, found.file, *found.elements)).encode()).hexdigest()[:32]


def _replacements(before: str, after: str) -> list[Mapping[str, Any]]:
    """The lines that differ, as regions of the text before and what comes in their place."""
    old, new = _lines(before), _lines(after)
    made: list[Mapping[str, Any]] = []
    for kind, start, end, first, last in difflib.SequenceMatcher(None, old, new, autojunk=False).get_opcodes():
        if kind != "equal":
            region = {"startLine": start + 1, "startColumn": 1, "endLine": end + 1, "endColumn": 1}
            if end == len(old) and start < end and not old[-1].endswith("\n"):  # there is no next line to begin
                region |= {"endLine": end, "endColumn": len(old[-1]) + 1}
            made.append({"deletedRegion": region, "insertedContent": {"text": "".join(new[first:last])}})
    return made


def _lines(text: str) -> list[str]:
    return re.findall(r"[^\n]*\n|[^\n]+", text)
