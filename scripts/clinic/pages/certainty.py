"""How firmly what a case claims stands, in sentences for its page."""

from __future__ import annotations

from clinic.pages.text.prose import markdown
from clinic.proof.evidence import Evidence
from clinic.proof.releases import differing
from clinic.proof.robustness import NUDGE, STARTS
from clinic.record.case import Case
from clinic.record.prose import plain, quantity

STILL = 1e-3  # of a signal; less is no motion


def smaller_steps(case: Case, evidence: Evidence) -> str:
    """Whether a smaller timestep helps, from the runs; empty where nothing moves that the symptom is about."""
    spans = [evidence.variants["broken"].values[check.signal]["span"] or 0.0 for check in case.record.checks.broken]
    if "broken" not in evidence.robustness or max(spans) < STILL:
        return ""
    words = {"broken": "the symptom is the same", "well": "it is gone", "neither": "it has changed and is not gone"}
    shrunk, step = evidence.robustness["broken"].shrunk, 1e3 * (evidence.variants["broken"].timestep or 0.0)
    half, twentieth = shrunk.values()
    at_half, at_twentieth = (f"({plain(step * float(share))}\u00a0ms)" for share in shrunk)
    answer = "No" if half == twentieth == "broken" else "Yes" if "well" in (half, twentieth) else "In part"
    if half == twentieth:
        return f"{answer}: at half of it {at_half} and at a twentieth {at_twentieth} {words[half]}."
    return f"{answer}: at half of it {at_half} {words[half]}, at a twentieth {at_twentieth} {words[twentieth]}."


def releases(case: Case, evidence: Evidence) -> str:
    """On which releases of MuJoCo the case is the same, and why not on the others; empty if that was not measured."""
    told = differing(evidence)
    if not told:
        return ""
    releases = sorted(told, key=lambda release: [int(part) for part in release.split(".")])
    last = max((k for k, release in enumerate(releases) if told[release]), default=-1)
    said = "the same on every release measured" if last < 0 else "the same"
    reasons = [
        f"{spec.replace('<', 'Before ')}: {markdown(reason, evidence, case).strip()}"
        for spec, reason in case.record.older.items()
    ]
    return " ".join([f"{said} from {releases[last + 1]} on.", *reasons] if last + 1 < len(releases) else reasons)


def steady(case: Case, evidence: Evidence) -> str:
    """Whether the outcomes hang on one lucky start, in a sentence or two; empty if that was not measured."""
    if not evidence.robustness:
        return ""
    total = sum(robust.runs for robust in evidence.robustness.values())
    same = sum(robust.same for robust in evidence.robustness.values())
    ended = f"all {total} runs ended the same way" if same == total else f"{same} of {total} runs ended the same way"
    said = (
        f"Was it luck? Each was run again from {STARTS} starts up to {quantity(NUDGE, 'm', 1)} or rad away, with "
        f"speeds changed by as much a second, and the broken model and the repairs with half the timestep too: {ended}."
    )
    if all(robust.longer is not False for robust in evidence.robustness.values()):
        said += " Every repair still holds after ten times the duration."
    shaken = [f"`{key}` {one.same} of {one.runs}" for key, one in evidence.robustness.items() if one.same < one.runs]
    reasons = [
        markdown(reason, evidence, case) for law, reason in case.record.exempt.items() if law in ("steady", "lasting")
    ]
    return " ".join([said, *([f"({', '.join(shaken)}.)"] if shaken else []), *reasons])


def tried(case: Case, evidence: Evidence) -> tuple[list[str], list[str]]:
    """The trials in which the broken variant is broken and every repair holds, and the contrasts; none if one fails."""
    as_told = (
        (variant.kind == "broken" and variant.broken) or (variant.kind == "fix" and variant.well)
        for variant in evidence.variants.values()
        if variant.kind != "refuted"
    )
    trials = case.record.trials if all(as_told) else []
    return [each.title for each in trials if not each.contrast], [each.title for each in trials if each.contrast]
