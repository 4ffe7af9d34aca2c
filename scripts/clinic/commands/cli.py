"""The command `clinic`. What is slow to import is imported by the command that needs it."""

from __future__ import annotations

import json
import shutil
import sys
from pathlib import Path
from typing import Annotated, Literal

import typer

from clinic.commands import bench_rules, diagnose
from clinic.record.checkout import cache_folder, cases_root, folders, project_root, slugs
from clinic.record.problem import CaseError, MissingRequirementError

app = typer.Typer(no_args_is_help=True, help="Broken MuJoCo simulations that prove themselves.")
app.add_typer(diagnose.app)
app.add_typer(bench_rules.app)


def complete(incomplete: str) -> list[str]:
    """The slugs that begin like this, for the shell."""
    try:
        return [slug for slug in slugs(cases_root()) if slug.startswith(incomplete)]
    except OSError:
        return []


Slug = Annotated[str, typer.Argument(help="A case, by its folder's name.", autocompletion=complete)]
Slugs = Annotated[list[str] | None, typer.Argument(help="Cases; all when left out.", autocompletion=complete)]
AsJson = Annotated[bool, typer.Option("--json", help="Print data for a program.")]


@app.command()
def new(
    slug: Annotated[str, typer.Argument(help="The folder's name: words that name the symptom, joined by hyphens.")],
    title: Annotated[str, typer.Option(help="The symptom as a sentence, without a full stop; asked for.")] = "",
    kind: Annotated[Literal["model", "python", "javascript"], typer.Option(help="Where the bug lives.")] = "model",
    family: Annotated[str, typer.Option(help="The symptom's family: sags, slips, ...; asked for when left out.")] = "",
) -> None:
    """Write the folder of a new case, which passes every law until you put your bug into it."""
    from clinic.commands.scaffold import check_slug, write_case
    from clinic.pages.schema import write_schema
    from clinic.record.families import families, likely_families

    root = project_root()
    check_slug(root, slug)
    title = title or typer.prompt("The symptom")
    if not family:
        guess = next(iter(likely_families(title)), None)
        if sys.stdin.isatty():
            print(*(f"  {name:18} {each.title}" for name, each in families().items()), sep="\n")
            guess = typer.prompt("Its family", guess)
        if guess is None:
            raise typer.BadParameter(f"the title tells no family; name it with --family: {', '.join(families())}")
        family = guess
    write_case(root, slug, title, kind, family)
    write_schema(root)
    print(
        f"cases/{slug}/, of the family {family}, passes every law: clinic check {slug}. Now put your bug into it; "
        "`make serve` shows the page."
    )


@app.command()
def check(
    slugs: Slugs = None,
    as_json: AsJson = False,
    engine: Annotated[list[str], typer.Option(help="Say instead what another release of MuJoCo does: 3.10.0.")] = [],  # noqa: B006
) -> None:
    """Run cases and judge them by every law; exit code 1 if anything is wrong."""
    from rich.progress import track

    from clinic.commands import terminal
    from clinic.commands.check import check_cases, report_data
    from clinic.commands.console import console
    from clinic.work.cache import Cache

    if engine:
        from clinic.commands.releases import compare

        told = list(compare(project_root(), slugs or [], engine))
        print("\n".join(map(str, told)) or "the same, but for what the records say under `older`")
        raise typer.Exit(bool(told))
    root, out, err = project_root(), console(), console(stderr=True)
    wanted = [folder.name for folder in folders(root, slugs or [])]
    checking = check_cases(root, wanted, Cache(cache_folder(root)))
    reports = list(track(checking, "checking", len(wanted), console=err, transient=True, disable=not err.is_terminal))
    reports.sort(key=lambda report: report.case.rank if report.case else (0.0, report.slug))
    if as_json:
        _print_json([report_data(report) for report in reports])
    else:
        for report in reports if slugs else []:
            if report.case and report.evidence:
                out.print(terminal.checks_table(report.case, report.evidence))
        out.print(terminal.reports_table(reports))
        for report in reports:
            for said in (*report.problems, *report.breaches):
                print(said, file=sys.stderr)
    if not all(report.sound for report in reports):
        raise typer.Exit(1)


@app.callback()
def _require_engine() -> None:
    from clinic.engine.installed import too_old

    if told := too_old():
        sys.exit(f"clinic: {told}")


@app.command()
def claims(slug: Slug) -> None:
    """Print the sentences of a case that its claims.yaml lacks, for that file."""
    from clinic.proof.claims import missing
    from clinic.record.case import load_case

    (folder,) = folders(cases_root(), [slug])
    print(missing(load_case(folder)))


@app.command(name="list")
def list_cases(as_json: AsJson = False) -> None:
    """List the cases by number."""
    from clinic.commands import terminal
    from clinic.commands.console import console
    from clinic.record.case import read_cases

    cases, problems = read_cases(cases_root() / "cases")
    if as_json:
        _print_json([terminal.row_data(case) for case in cases])
    else:
        console().print(terminal.cases_table(cases))
    if problems:
        raise CaseError(problems)


@app.command()
def show(
    slug: Slug,
    answer: Annotated[bool, typer.Option("--answer", help="Open the folds: diagnosis, cause, fix, lesson.")] = False,
    as_json: AsJson = False,
) -> None:
    """Show a case in the terminal, its numbers filled in from the runs."""
    import mujoco

    from clinic.commands import terminal
    from clinic.commands.console import console
    from clinic.engine.installed import NEEDED_BY_CASES, installed
    from clinic.pages.text.prose import prose_problems
    from clinic.proof.evidence import missing_requirement
    from clinic.proof.experiments import measure_case
    from clinic.record.case import load_case
    from clinic.work.cache import Cache

    root = cases_root()
    (folder,) = folders(root, [slug])
    case = load_case(folder)
    try:
        with console(stderr=True).status(f"running {case.slug}"):
            evidence = measure_case(case, Cache(cache_folder(root)), ("sweeps",))
    except CaseError:
        if installed() >= NEEDED_BY_CASES or missing_requirement(case):
            raise
        sys.exit(f"clinic: {slug} uses what MuJoCo {mujoco.__version__} does not have: pip install -U mujoco")
    if problems := list(prose_problems(case, evidence)):
        raise CaseError(problems)
    if as_json:
        _print_json(terminal.case_data(case, evidence, answer))
    else:
        console().print(terminal.case_text(case, evidence, answer))


@app.command()
def view(
    slug: Slug,
    fix: Annotated[str, typer.Option(help="A fix or refuted remedy, by its id.")] = "broken",
) -> None:
    """Open a case's model in MuJoCo's viewer, at the start of its run."""
    from clinic.commands.viewer import open_viewer
    from clinic.record.case import load_case

    (folder,) = folders(cases_root(), [slug])
    open_viewer(load_case(folder), fix)


@app.command()
def build(out: Annotated[Path, typer.Option(help="The folder to write; made anew.")]) -> None:
    """Write the site's pages as real files, beside those written by hand."""
    from clinic.pages.schema import FILE as SCHEMA
    from clinic.publish.site import make_site
    from clinic.work.cache import Cache

    root, out = project_root(), out.resolve()
    foreign = out.exists() and not (out / SCHEMA).is_file()
    if foreign or root.is_relative_to(out) or out.is_relative_to(root / "docs"):
        raise typer.BadParameter(f"{out} is not a folder that a build wrote, and would be deleted; name another")
    made = make_site(root, Cache(cache_folder(root)))
    if made.problems:
        raise CaseError(made.problems)
    shutil.rmtree(out, ignore_errors=True)
    shutil.copytree(root / "docs", out)
    for name, content in made.files.items():
        (out / name).parent.mkdir(parents=True, exist_ok=True)
        (out / name).write_bytes(content)
    print(f"{len(made.files)} files in {out}")


@app.command()
def triage(path: Annotated[Path, typer.Argument(help="A case's folder, or any MJCF or URDF file.")]) -> None:
    """Run the six steps of triage on a model and print what each saw."""
    from clinic.triage.process import reports

    for said in reports(path):
        print(said, flush=True)


@app.command()
def judge(
    slug: Slug,
    file: Annotated[Path, typer.Argument(help="Your model or script, which should be a repair of the case.")],
    as_json: AsJson = False,
) -> None:
    """Judge your own repair of a case; exit code 0 if it is one, 1 if it is none, 2 if it cannot be run."""
    from dataclasses import asdict

    from clinic.proof.judge import judge_file

    try:
        (folder,) = folders(cases_root(), [slug])
    except CaseError as error:
        print(error, file=sys.stderr)
        raise typer.Exit(2) from None
    made = judge_file(folder, file)
    if as_json:
        _print_json({**asdict(made), "repaired": made.repaired})
    elif made.error:
        print(f"It cannot be judged: {made.error}")
    else:
        print("\n".join([*made.changes, *made.failed, "Repaired." if made.repaired else "Not repaired."]))
    if not made.repaired:
        raise typer.Exit(2 if made.error else 1)


@app.command(name="reference")
def print_reference() -> None:
    """Print the record's reference as Markdown."""
    from clinic.pages.reference import reference

    print(reference())


@app.command(name="schema")
def print_schema() -> None:
    """Print the record's JSON Schema."""
    from clinic.pages.schema import schema_text

    print(schema_text(), end="")


def _print_json(data: object) -> None:
    print(json.dumps(data, indent=1, ensure_ascii=False))


def main() -> None:
    """Entry point: a mistake of the author or of the machine ends with its message and exit code 1, not a traceback."""
    try:
        app()
    except CaseError as error:
        sys.exit(str(error))
    except ModuleNotFoundError as error:
        sys.exit(f"clinic: {error.name} is not installed; this needs a checkout, set up by `make setup`")
    except (ImportError, FileNotFoundError, ConnectionError, MissingRequirementError) as error:
        sys.exit(f"clinic: {error}")  # an ImportError says that the engine is too old
