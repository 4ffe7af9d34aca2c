"""Releases of MuJoCo: what each one does with every variant, kept in a lock file and held against the records.

`python -m clinic.proof.releases FOLDER SLUG...`, run by the Python that has a release installed, prints its part.
"""

from __future__ import annotations

import hashlib
import json
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from pathlib import Path

import mujoco
from packaging.specifiers import SpecifierSet
from packaging.version import Version
from pydantic import Field, TypeAdapter

from clinic.engine import node
from clinic.engine.variant import variants
from clinic.proof.evidence import Evidence, VariantEvidence, observe
from clinic.record.case import Case, load_case
from clinic.record.checkout import cases_root
from clinic.record.parts import Strict
from clinic.record.problem import Problem, listed

LOCK = "releases.lock.json"
DIGITS = 4
TOLERANCE = 1e-3  # of a number: what three digits show
NOISE = 1e-6  # below it a number reads as nothing
LONGEST = 200  # characters of an error


class Behaviour(Strict):
    """What one variant does on one release.

    Attributes:
        broken: Whether every check of `broken` holds, without the trials.
        fixed: Whether every check of `fixed` holds, without them too.
        warnings: How often MuJoCo warned, by type.
        checks: The measured numbers by kind, in the record's order.
        error: Why it does not run there; empty if it does.
    """

    broken: bool = False
    fixed: bool = False
    warnings: dict[str, int] = Field(default={})
    checks: dict[str, list[float | None]] = Field(default={})
    error: str = ""


Behaviours = dict[str, Behaviour]
RELEASES = TypeAdapter(dict[str, Behaviours])


class Locked(Strict):
    """The behaviour of a case on every release, and a digest of the files that it was measured on."""

    files: str
    releases: dict[str, Behaviours]


Lock = dict[str, Locked]
LOCKS = TypeAdapter(Lock)


@lru_cache
def read_lock(root: Path) -> Lock:
    """The lock file of a checkout, by slug; empty where there is none."""
    path = root / LOCK
    return LOCKS.validate_json(path.read_bytes()) if path.is_file() else {}


def lock_text(lock: Lock) -> str:
    """The lock as a file, one line a case and release, so that a change of one is seen as one."""
    lines = []
    for slug, locked in sorted(lock.items()):
        rows = [
            f"  {json.dumps(release)}: {json.dumps({k: b.model_dump(exclude_defaults=True) for k, b in seen.items()})}"
            for release, seen in sorted(locked.releases.items(), key=lambda entry: Version(entry[0]))
        ]
        lines.append(f'{json.dumps(slug)}: {{"files": "{locked.files}", "releases": {{\n' + ",\n".join(rows) + "}}")
    return "{\n" + ",\n".join(lines) + "\n}\n"


def files_digest(case: Case) -> str:
    """A digest of what the runs of a case's variants depend on."""
    kept = {"run", "signals", "checks", "fixes", "refuted"}
    experiment = case.record.model_dump(mode="json", include=kept, exclude={"signals": {"__all__": {"said"}}})
    return hashlib.sha256(json.dumps([experiment, case.texts], sort_keys=True).encode()).hexdigest()[:16]


def behaviour(case: Case) -> dict[str, Behaviour]:
    """What every variant does on the release that runs, by id."""
    seen = {}
    for variant in variants(case):
        try:
            seen[variant.id] = seen_in(observe(case, variant, tried=False))
        except Exception as error:  # whatever an older release has against it
            said = " ".join(f"{type(error).__name__}: {error}".split())
            seen[variant.id] = Behaviour(error=said[:LONGEST])
    return seen


def seen_in(evidence: VariantEvidence) -> Behaviour:
    """The part of a variant's evidence that releases are compared by, rounded to DIGITS."""
    return Behaviour(
        broken=all(check.holds for check in evidence.checks["broken"]),
        fixed=all(check.holds for check in evidence.checks["fixed"]),
        warnings=evidence.warnings,
        checks={
            kind: [None if check.measured is None else float(f"{check.measured:.{DIGITS}g}") for check in checks]
            for kind, checks in evidence.checks.items()
        },
    )


def differences(here: Mapping[str, Behaviour], there: Mapping[str, Behaviour]) -> Iterator[str]:
    """Each variant that another release treats otherwise, and how: `discrete does not run`."""
    for name, one in here.items():
        other = there.get(name, Behaviour(error="not measured"))
        if other.error != one.error:
            yield f"{name} does not run ({other.error})" if other.error else f"{name} runs"
        elif other.warnings != one.warnings:
            yield f"{name} warns {listed(other.warnings)} instead of {listed(one.warnings)}"
        elif (other.broken, other.fixed) != (one.broken, one.fixed):
            yield f"{name} is judged otherwise"
        elif any(
            _apart(*pair) for kind in one.checks for pair in zip(one.checks[kind], other.checks[kind], strict=True)
        ):
            yield f"{name} measures other numbers"


def on_releases(case: Case) -> dict[str, Behaviours]:
    """What the case's variants do on every release; empty if the case is new, or has changed since."""
    locked = read_lock(cases_root()).get(case.slug)
    return locked.releases if locked is not None and locked.files == files_digest(case) else {}


def differing(evidence: Evidence) -> dict[str, list[str]]:
    """What differs on each release of the evidence from what was measured now."""
    here = {name: seen_in(variant) for name, variant in evidence.variants.items()}
    there = RELEASES.validate_python(evidence.releases)
    return {release: list(differences(here, seen)) for release, seen in there.items()}


def release_problems(case: Case, found: Mapping[str, Sequence[str]]) -> Iterator[Problem]:
    """Differences that the record does not explain under `older`, and explanations of nothing."""
    for release, told in found.items():
        if told and not any(Version(release) in SpecifierSet(text) for text in case.record.older):
            expected = "a release that agrees, or a reason in `older`"
            yield case.problem(("older",), f"on {release}, {listed(told)}", expected, "say why, from the changelog")
    for text, reason in case.record.older.items():
        differ = [one for release, told in found.items() if Version(release) in SpecifierSet(text) for one in told]
        for fix in [*case.record.fixes, *case.record.refuted]:
            if f"`{fix.id}`" in reason and differ and not any(one.startswith(f"{fix.id} ") for one in differ):
                expected = f"what differs there: {listed(sorted({one.split()[0] for one in differ}))}"
                yield case.problem(("older", text), f"`{fix.id}`", expected, "correct the reason", quoted=fix.id)
        if same := [release for release, told in found.items() if not told and Version(release) in SpecifierSet(text)]:
            expected = f"a difference on every release that {text} names"
            yield case.problem(("older", text), f"none on {listed(same)}", expected, "narrow it, or remove it")


def measured_here(cases: Iterable[Case]) -> dict[str, tuple[str, dict[str, Behaviour]]]:
    """The release that runs each case, and what it does."""
    found = {}
    for case in cases:
        release = node.version(node.MUJOCO) if case.record.language == "javascript" else mujoco.__version__
        if release is not None:
            found[case.slug] = release, behaviour(case)
    return found


def _apart(one: float | None, other: float | None) -> bool:
    if one is None or other is None:
        return one is not other
    return abs(one - other) > max(NOISE, TOLERANCE * max(abs(one), abs(other)))


def main() -> None:
    """Prints what the installed release does, as data."""
    folder, *slugs = sys.argv[1:]
    cases = [load_case(Path(folder) / slug) for slug in slugs]
    found = measured_here(cases)
    data = {
        slug: [release, {name: one.model_dump(exclude_defaults=True) for name, one in seen.items()}]
        for slug, (release, seen) in found.items()
    }
    print(json.dumps(data))


if __name__ == "__main__":
    main()
