"""The page that says how well the rules do on planted faults, and the same as data."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import Any

from clinic.diagnosis.bench.faults import kinds
from clinic.diagnosis.bench.harm import HARMS
from clinic.diagnosis.bench.lock import HARMLESS, LEAST, LETTERS, NO_PLACE, Kept, score
from clinic.diagnosis.bench.table import SIDES
from clinic.diagnosis.rules import rules
from clinic.pages.text.template import render
from clinic.work.cache import Files

WORDS = {letter: word for word, letter in LETTERS.items()} | {HARMLESS: "harmless", NO_PLACE: "no place"}


def benchmark(of: Kept) -> Files:
    """The page and its data."""
    scores = {rule.id: score(of, rule.id) for rule in rules().values()}
    unowned = {row.rule: score(of, row.rule) for row in of.kinds.values() if row.rule not in rules()}
    data = benchmark_data(of)
    page = render(
        "benchmark",
        kept=of,
        rules=rules(),
        scores=scores,
        unowned=unowned,
        texts={kind.name: kind.text for kind in kinds().values()},
        harms=data["harms"],
        least=LEAST,
        totals={side: _total(of, side) for side in SIDES},
    )
    text = json.dumps(data, indent=1, ensure_ascii=False) + "\n"
    return {"rules/benchmark.md": page.encode(), "rules/benchmark.json": text.encode()}


def benchmark_data(of: Kept) -> dict[str, Any]:
    """Every plant's outcome by kind and side, and every rule's score."""
    return {
        "engine": of.engine,
        "seed": of.seed,
        "healthy": {"models": of.healthy, "named": of.false},
        "rules": [
            {"id": rule.id, "level": rule.level, "unplanted": rule.unplanted, "seconds": of.seconds.get(rule.id)}
            | asdict(score(of, rule.id))
            for rule in rules().values()
        ],
        "kinds": [
            {
                "kind": name,
                "text": kinds()[name].text,
                "rules": kinds()[name].rules,
                "harms": kinds()[name].harms,
                **{side: [WORDS[letter] for letter in getattr(row, side)] for side in SIDES},
                "beside": row.beside,
            }
            for name, row in of.kinds.items()
            if name in kinds()
        ],
        "harms": {name: (measure.__doc__ or "").strip() for name, measure in HARMS.items()},
    }


def _total(of: Kept, side: str) -> tuple[int, int]:
    """Faults found as a cause among the first three, and all that do harm."""
    letters = "".join(getattr(row, side) for row in of.kinds.values())
    return letters.count(LETTERS["cause"]), sum(letters.count(each) for each in LETTERS.values())
