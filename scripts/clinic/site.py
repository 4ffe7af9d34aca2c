"""The whole site's generated pages, as {path: bytes}: what every adapter writes."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from functools import partial
from pathlib import Path

import mujoco

from clinic import browser
from clinic.cache import Cache, Files, key_of
from clinic.case import RECORD, Case, load_cases
from clinic.evidence import Evidence
from clinic.exhibit import all_exhibits, evidence_of, run_tasks
from clinic.fences import run_fences
from clinic.laws import complaints
from clinic.lookalike import Matrix, alike_problems, group, matrix, unclear
from clinic.manual import manual_problems
from clinic.messages import heard, load_messages, messages_page
from clinic.pages import card, case_page, home_page
from clinic.playground import FILE as PLAYGROUND
from clinic.playground import playground
from clinic.problem import CaseError, Problem
from clinic.reference import reference
from clinic.symptoms import symptoms_page
from clinic.triage.table import MARK as TRIAGE_MARK
from clinic.triage.table import screening_tasks, table

PAGE = "cases/{slug}/index.md"
QUIET = "---\nsearch:\n  boost: 0.3\n---\n\n"
REFERENCE_MARK = "Print it with `clinic reference`."
BROWSER_PARTS = {"javascripts/iframe-worker.js": "node_modules/iframe-worker/shim/index.js"}


def project_root() -> Path:
    """The folder that holds `cases/`: the working directory or the nearest one above it.

    Raises:
        FileNotFoundError: If there is none.
    """
    here = Path.cwd()
    for folder in (here, *here.parents):
        if (folder / "cases").is_dir() and (folder / "pyproject.toml").is_file():
            return folder
    raise FileNotFoundError(f"no folder with cases/ and pyproject.toml at or above {here}")


def cache_folder(root: Path) -> Path:
    """Where finished work is kept: CLINIC_CACHE, or `.cache/clinic` in the checkout."""
    return Path(os.environ.get("CLINIC_CACHE", root / ".cache" / "clinic"))


def build(root: Path, cache: Cache | None = None) -> Files:
    """Every generated file of the site, by its path below the documentation folder.

    Raises:
        CaseError: With all problems of all cases, and every claim that the runs do not bear out.
    """
    cache = cache or Cache(cache_folder(root))
    cases = load_cases(root / "cases")
    by_slug = {case.slug: case for case in cases}
    if problems := list(alike_problems(by_slug)):
        raise CaseError(problems)
    exhibits = all_exhibits(cases, cache)
    evidence = {slug: evidence_of(files) for slug, files in exhibits.items()}
    alike = matrices(by_slug, cache)
    problems = [p for case in cases for p in manual_problems(case)]
    made: Files = browser.parts(root)
    if browser.has_playground(made):
        for case in cases:
            if case.record.model is not None:
                exhibits[case.slug][PLAYGROUND] = playground(case, mujoco.__version__, cases)
    for case in cases:
        problems += _unproven(case, list(proven(case, evidence[case.slug], alike.get(case.slug))))
        try:
            page = case_page(case, evidence[case.slug], exhibits[case.slug], by_slug, alike.get(case.slug))
        except CaseError as error:
            problems += error.problems
            continue
        made[PAGE.format(slug=case.slug)] = page.encode()
        for name, content in exhibits[case.slug].items():
            made[f"cases/{case.slug}/{name}"] = content
        for name in (RECORD, *case.texts):
            made[f"cases/{case.slug}/{name}"] = (root / "cases" / case.slug / name).read_bytes()
    if problems:
        raise CaseError(problems)
    cards = [card(case, evidence[case.slug], exhibits[case.slug]) for case in cases]
    made["index.md"] = home_page(cards, mujoco.__version__).encode()
    made["symptoms.md"] = symptoms_page(cases, {card.slug: card for card in cards}).encode()
    messages = load_messages()
    made["messages.md"] = messages_page(messages, heard(messages, cache), by_slug).encode()
    screenings = run_tasks(list(screening_tasks(cases)), cache)
    made |= {f"cases/{slug}/{name}": text for slug, files in screenings.items() for name, text in files.items()}
    triage = (root / "docs" / "triage.md").read_text(encoding="utf-8").replace(TRIAGE_MARK, table(cases, screenings))
    made["triage.md"] = run_fences("docs/triage.md", triage, by_slug, cache).encode()
    contributing = (root / "CONTRIBUTING.md").read_text(encoding="utf-8")
    made["contributing.md"] = (QUIET + contributing.replace(REFERENCE_MARK, reference())).encode()
    for path, source in BROWSER_PARTS.items():
        if (root / source).is_file():
            made[path] = (root / source).read_bytes()
    return made


def matrices(cases: Mapping[str, Case], cache: Cache) -> dict[str, Matrix]:
    """The matrix of every case that has look-alikes, by slug."""
    made = {}
    for case in cases.values():
        if case.record.alike is not None:
            members = group(case, cases)
            key = key_of("alike", [[m.slug, m.text, m.record.model_dump(mode="json")] for m in members])
            files = cache.remember(key, partial(_matrix_file, members))
            made[case.slug] = Matrix.model_validate_json(files["matrix.json"])
    return made


def proven(case: Case, evidence: Evidence, alike: Matrix | None) -> Iterator[str]:
    """What a build refuses to publish: claims that the runs do not bear out."""
    for law in ("verdicts", "warned", "lasting", "steady", "swept"):
        yield from complaints(case, evidence, law)
    if alike is not None:
        yield from (f"{cell}; correct `alike`" for cell in unclear(alike))


def navigation(root: Path) -> list[dict[str, object]]:
    """The site's navigation as MkDocs takes it: the cases by number, then the pages written by hand."""
    cases = load_cases(root / "cases")
    pages = [{f"{case.record.number}. {case.record.title}": PAGE.format(slug=case.slug)} for case in cases]
    return [
        {"Home": "index.md"},
        {"Find your symptom": "symptoms.md"},
        {"What MuJoCo says": "messages.md"},
        {"Triage": "triage.md"},
        {"Cases": pages},
        {"By thing": "tags.md"},
        {"Add a case": "contributing.md"},
    ]


def _matrix_file(members: list[Case]) -> Files:
    return {"matrix.json": matrix(members).model_dump_json().encode()}


def _unproven(case: Case, complaints: list[str]) -> list[Problem]:
    return [
        case.problem(("checks",), complaint.split(";")[0], "what the record claims", complaint.split("; ", 1)[-1])
        for complaint in complaints
    ]
