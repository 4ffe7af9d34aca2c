"""The pages of the rules: what each looks for, and what `clinic diagnose` prints on its two examples."""

from __future__ import annotations

import html
import json
import os
import re
import tempfile
from collections.abc import Mapping
from dataclasses import fields
from typing import Any

import mujoco
from pydantic import TypeAdapter

from clinic.diagnosis.bench.lock import Kept, score
from clinic.diagnosis.diagnose import examine
from clinic.diagnosis.finding import Finding, Measured
from clinic.diagnosis.native import NativeEngine
from clinic.diagnosis.rules import Rule, rules
from clinic.pages.benchmark import benchmark
from clinic.pages.text.template import render
from clinic.record.case import Case
from clinic.record.families import families
from clinic.work.cache import Cache, Files, key_of

TOLD = "told.json"
PAGE = "rules/{rule}.md"
EXAMPLE = re.compile(r"^(Bad|Good):\n\n((?: {4}.*\n|\n)+)", re.M)


def rule_pages(cases: Mapping[str, Case], cache: Cache, kept: Kept) -> Files:
    """The page of every rule, the list of all, how well they do, the same as data, and the schema of a diagnosis."""
    told = json.loads(cache.remember(key_of("rules", "examples", of="diagnosis"), _told)[TOLD])
    made = {PAGE.format(rule=rule.id): _page(rule, told[rule.id], cases, kept).encode() for rule in rules().values()}
    made |= benchmark(kept)
    by_family = {name: [rule for rule in rules().values() if rule.families[0] == name] for name in families()}
    listed = render("rules", by_family=by_family, families=families(), engine=mujoco.__version__)
    made["rules/index.md"] = listed.encode()
    data = [
        {name: getattr(rule, name) for name in ("id", "title", "families", "since", "case", "level")}
        for rule in rules().values()
    ]
    made["rules.json"] = (json.dumps(data, indent=1, ensure_ascii=False) + "\n").encode()
    made["diagnosis.schema.json"] = (json.dumps(diagnosis_schema(), indent=1, ensure_ascii=False) + "\n").encode()
    return made


def diagnosis_schema() -> dict[str, Any]:
    """The JSON Schema of what `clinic diagnose --format json` prints."""
    finding = TypeAdapter(Finding).json_schema()
    parts = finding.pop("$defs", {})
    edit = parts["Edit"]
    offsets = {"start", "head_end", "end"}
    edit["properties"] = {name: each for name, each in edit["properties"].items() if name not in offsets}
    edit["required"] = [name for name in edit["required"] if name not in offsets]
    for name in ("before", "after"):  # a number that is not finite is null
        finding["properties"][name] = {"title": name.title(), "type": ["number", "null"]}
    finding["required"] = [each.name for each in fields(Finding)]
    several = {"type": "array", "items": {"$ref": "#/$defs/Finding"}}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "A diagnosis",
        "type": "object",
        "required": ["engine", "file", "causes", "hints", "silenced", "ruled_out", "untried", "error", "measured"],
        "properties": {
            "engine": {"type": "string", "description": "The release of MuJoCo that ran the model."},
            "file": {"type": "string"},
            "causes": several,
            "hints": several,
            "silenced": {**several, "description": "Causes and hints that comments in the model silence."},
            "ruled_out": {"type": "array", "items": {"type": "string"}},
            "untried": {
                "type": "array",
                "items": {"type": "string"},
                "description": "Rules for which no time was left.",
            },
            "error": {"type": "string", "description": "Why it does not compile; empty where it does."},
            "measured": {"anyOf": [{"$ref": "#/$defs/Measured"}, {"type": "null"}]},
        },
        "$defs": {**parts, "Finding": finding, "Measured": TypeAdapter(Measured).json_schema()},
    }


def _told() -> Files:
    """What a diagnosis of each rule's examples prints, by rule."""
    made, before, engine = {}, os.getcwd(), NativeEngine()
    with tempfile.TemporaryDirectory() as folder:
        os.mkdir(own := os.path.join(folder, "model"))  # a rule looks into the folder around it, too
        os.chdir(own)
        try:
            for rule in rules().values():
                shown = {which: {"model.xml": rule.example(which)} for which in ("Bad", "Good")}
                made[rule.id] = {which: examine(engine, texts).text() for which, texts in shown.items()}
        finally:
            os.chdir(before)
    return {TOLD: json.dumps(made).encode()}


def _page(rule: Rule, told: Mapping[str, str], cases: Mapping[str, Case], kept: Kept) -> str:
    def example(found: re.Match[str]) -> str:
        model = rule.shown(found[1]).rstrip()
        language = "xml" if model.startswith("<") or found[1] == "Bad" else "diff"
        said = f"`clinic diagnose` prints:\n\n``` {{ .text .wrap }}\n{told[found[1]]}\n```"
        return f"## {found[1]}\n\n```{language}\n{model}\n```\n\n{said}\n\n"

    text = EXAMPLE.sub(example, rule.text + "\n")
    first, _, rest = text.partition("\n\n")
    own = [families()[name].title for name in rule.families]
    case = cases.get(rule.case or "")
    found = score(kept, rule.id)
    return render(
        "rule",
        rule=rule,
        description=json.dumps(html.escape(first.replace("`", "").replace("\n", " ")), ensure_ascii=False),
        first=first,
        rest=rest,
        families=own,
        case=case,
        found=found,
        engine=mujoco.__version__,
    )
