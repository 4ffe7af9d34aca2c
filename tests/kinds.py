"""One page of every kind that the site has."""

from __future__ import annotations

CASES = "cases/{}/index.html"
KINDS = {
    "home": "index.html",
    "model case": CASES.format("box-falls-through-floor"),
    "python case": CASES.format("misaligned-log"),
    "javascript case": CASES.format("javascript-view-goes-dead"),
    "camera case": CASES.format("camera-upside-down"),
    "symptoms": "symptoms.html",
    "family": "symptoms/slips.html",
    "messages": "messages.html",
    "rules": "rules/index.html",
    "rule": "rules/twin-joint-differs.html",
    "benchmark": "rules/benchmark.html",
    "check your models": "check-your-models.html",
    "triage": "triage.html",
    "add a case": "contribute/add-a-case.html",
    "record": "contribute/the-record.html",
    "code": "contribute/work-on-the-code.html",
    "tags": "tags.html",
    "not found": "404.html",
}
