"""The site's generated pages, as {path: bytes}: what every adapter writes."""

from __future__ import annotations

from collections.abc import Container, Mapping
from html import escape
from pathlib import Path

from clinic.pages import completion
from clinic.pages.case_files import picture_tasks
from clinic.pages.case_page import interim_page
from clinic.pages.cases import FOLDER, PAGE, case_pages
from clinic.pages.error_page import error_page, unmeasured_page, with_problems
from clinic.pages.overviews import overviews
from clinic.pages.schema import FILE as SCHEMA
from clinic.pages.schema import schema_text
from clinic.proof.evidence import missing_requirement
from clinic.proof.experiments import EVIDENCE, evidence_of, evidence_task, measuring_tasks
from clinic.publish import bundle
from clinic.publish.for_programs import FEED, LLMS, feed, lines, llms_text
from clinic.publish.site_files import SECTION, Navigation, Site
from clinic.record.case import read_cases
from clinic.record.checkout import slugs
from clinic.record.problem import CaseError, problems_by_case
from clinic.work.cache import Cache, Files
from clinic.work.task import Task, run_tasks


def make_site(root: Path, cache: Cache) -> Site:
    """The site as far as it can be made: every case comes as far as it can, and holds up no other."""
    read, problems = read_cases(root / "cases")
    known = {case.slug: case for case in read}
    unread = sorted(set(slugs(root)) - known.keys())
    made: Files = bundle.playground_files(root, cache)
    shown, told_apart, wrong = case_pages(root, read, cache, bundle.START in made)
    files, others = overviews(root, shown, told_apart, known, cache)
    problems += [*wrong, *others]
    made |= files
    made |= bundle.diagnosis_files(root, cache)
    made |= {f"{bundle.FOLDER}/{completion.FILE}": completion.completion()} if bundle.START in made else {}
    made[SCHEMA] = schema_text().encode()
    for one in shown:
        made |= {f"{FOLDER.format(slug=one.case.slug)}/{name}": content for name, content in one.files.items()}
    pages, told = {one.case.slug: one.page for one in shown}, problems_by_case(problems)
    headings = {case.slug: case.record.heading for case in read}
    headings |= {slug: slug for slug in unread}
    for slug, heading in headings.items():
        if slug in pages:
            page = with_problems(pages[slug], told[slug]) if slug in told else pages[slug]
        elif slug in told:
            page = error_page(heading, told[slug])
        else:
            page = unmeasured_page(heading, missing_requirement(known[slug]))
        made[PAGE.format(slug=slug)] = page.encode()
    listed = lines(made)
    made[LLMS] = llms_text(listed).encode()
    if (news := feed(listed, known)) is not None:
        made[FEED] = news.encode()
    return Site(made, navigation(headings), CaseError(problems).problems)


def slow_tasks_to_do(root: Path, cache: Cache) -> list[Task]:
    """Tasks that take long and are not kept: all but the variants' runs and the plots."""
    tasks = [task for case in read_cases(root / "cases")[0] for task in (*measuring_tasks(case), *picture_tasks(case))]
    return [task for task in tasks if not cache.path(task.key).exists()]


def interim_pages(root: Path, cache: Cache, slugs: Container[str]) -> Files | None:
    """The pages of these cases with what their checks measured; None if there are none, or one cannot be run."""
    cases = [case for case in read_cases(root / "cases")[0] if case.slug in slugs]
    found, failed = run_tasks([evidence_task(case) for case in cases], cache)
    if failed or not all(EVIDENCE in files for files in found.values()):
        return None
    pages = {case.slug: interim_page(case, evidence_of(found[case.slug])) for case in cases}
    return {PAGE.format(slug=slug): page.encode() for slug, page in pages.items()} or None


def navigation(headings: Mapping[str, str]) -> Navigation:
    """The site's navigation: the cases by slug, then the pages written by hand. The theme takes titles as HTML.

    More than SECTION cases are in sections, for every page holds the part of the navigation around it.
    """
    cases = [{escape(heading, quote=False): PAGE.format(slug=slug)} for slug, heading in headings.items()]
    sections = [cases[k : k + SECTION] for k in range(0, len(cases), SECTION)]
    divided = [{f"{k * SECTION + 1} to {k * SECTION + len(part)}": part} for k, part in enumerate(sections)]
    return [
        {"Home": "index.md"},
        {"Find your symptom": "symptoms.md"},
        {"What MuJoCo says": "messages.md"},
        {"Diagnose your model": "rules/index.md"},
        {"Check your models in CI": "check-your-models.md"},
        {"Triage": "triage.md"},
        {"Cases": divided if len(sections) > 1 else cases},
        {"Cases by topic": "tags.md"},
        {
            "Contribute": [
                {"Add a case": "contribute/add-a-case.md"},
                {"The record": "contribute/the-record.md"},
                {"Work on the code": "contribute/work-on-the-code.md"},
            ]
        },
        {"Words": "words.md"},
        {"For programs": "programs.md"},
        {"About": "about.md"},
    ]
