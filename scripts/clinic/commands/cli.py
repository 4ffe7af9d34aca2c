"""The command `clinic`. What is slow to import is imported by the command that needs it."""

from __future__ import annotations

import json
import shutil
import sys
import tempfile
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from clinic.record.checkout import cache_folder, cases_root, folders, project_root, slugs
from clinic.record.problem import CaseError, LackError

if TYPE_CHECKING:
    from clinic.proof.evidence import Evidence
    from clinic.record.case import Case

app = typer.Typer(no_args_is_help=True, help="Broken MuJoCo simulations that prove themselves.")


class Kind(StrEnum):
    """Where a bug lives."""

    model = "model"
    python = "python"
    javascript = "javascript"


def complete(incomplete: str) -> list[str]:
    """The slugs that begin like this, for the shell."""
    try:
        return [slug for slug in slugs(cases_root()) if slug.startswith(incomplete)]
    except OSError:
        return []


Slug = Annotated[str, typer.Argument(help="A case, by its folder's name.", autocompletion=complete)]
Slugs = Annotated[
    list[str] | None, typer.Argument(metavar="[SLUG]...", help="Cases; all when left out.", autocompletion=complete)
]
AsJson = Annotated[bool, typer.Option("--json", help="Print data for a program.")]


@app.command()
def new(
    slug: Annotated[str, typer.Argument(help="The folder's name: words that name the symptom, joined by hyphens.")],
    title: Annotated[str, typer.Option(help="The symptom as a sentence, without a full stop.", prompt="The symptom")],
    kind: Annotated[Kind, typer.Option(help="Where the bug lives.")] = Kind.model,
) -> None:
    """Write the folder of a new case, which passes every law until you put your bug into it."""
    from clinic.commands.scaffold import write_case
    from clinic.pages.schema import write_schema

    root = project_root()
    folder = write_case(root, slug, title, kind)
    write_schema(root)
    for path in sorted(folder.iterdir()):
        print(path.relative_to(root).as_posix())
    print(f"It passes every law: clinic check {slug}. Now put your bug into it; `make serve` shows the page.")


@app.command()
def check(slugs: Slugs = None, as_json: AsJson = False) -> None:
    """Run cases and judge them by every law; exit code 1 if anything is wrong."""
    from rich.progress import track

    from clinic.commands import terminal
    from clinic.commands.check import check_cases, report_data
    from clinic.work.cache import Cache

    root, out, err = project_root(), terminal.console(), terminal.console(stderr=True)
    wanted = [folder.name for folder in folders(root, slugs or [])]
    checking = check_cases(root, wanted, Cache(cache_folder(root)))
    quiet = not err.is_terminal
    reports = list(track(checking, "checking", len(wanted), console=err, transient=True, disable=quiet))
    reports.sort(key=lambda report: report.case.record.number if report.case else 0)
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


@app.command(name="list")
def list_cases(as_json: AsJson = False) -> None:
    """List the cases by number."""
    from clinic.commands import terminal
    from clinic.record.case import read_cases

    cases, problems = read_cases(cases_root() / "cases")
    if as_json:
        _print_json([terminal.row_data(case) for case in cases])
    else:
        terminal.console().print(terminal.cases_table(cases))
    if problems:
        raise CaseError(problems)


@app.command()
def show(
    slug: Slug,
    answer: Annotated[bool, typer.Option("--answer", help="Open the folds: diagnosis, cause, fix, lesson.")] = False,
    as_json: AsJson = False,
) -> None:
    """Show a case in the terminal, its numbers filled in from the runs."""
    from clinic.commands import terminal
    from clinic.pages.text.prose import prose_problems

    case, evidence = _run(slug, sweeps=answer)
    if problems := list(prose_problems(case, evidence)):
        raise CaseError(problems)
    if as_json:
        _print_json(terminal.case_data(case, evidence, answer))
    else:
        terminal.console().print(terminal.case_text(case, evidence, answer))


@app.command()
def view(
    slug: Slug,
    fix: Annotated[str, typer.Option(help="A fix or refuted remedy, by its id; the broken model when left out.")] = "",
) -> None:
    """Open a case's model in MuJoCo's viewer, at the start of its run."""
    from clinic.commands.viewer import view as open_viewer
    from clinic.engine.variant import BROKEN
    from clinic.record.case import load_case

    (folder,) = folders(cases_root(), [slug])
    open_viewer(load_case(folder), fix or BROKEN)


@app.command()
def cache(clear: Annotated[bool, typer.Option("--clear", help="Forget everything kept.")] = False) -> None:
    """Show where finished work is kept and how much of it, or clear it."""
    from clinic.work.cache import Cache

    kept = Cache(cache_folder(cases_root()))
    entries = kept.entries()
    size = sum(entry.stat().st_size for entry in entries)
    if clear:
        for entry in entries:
            entry.unlink(missing_ok=True)
    print(f"{len(entries)} entries, {size / 1e6:.1f} MB, {'cleared from' if clear else 'in'} {kept.folder}")


@app.command()
def build(out: Annotated[Path, typer.Option(help="The folder to write; made anew.")]) -> None:
    """Write the site's pages as real files, beside those written by hand."""
    from clinic.pages.schema import FILE as SCHEMA
    from clinic.publish.site import build as build_site

    root, out = project_root(), out.resolve()
    ours = not out.exists() or (out.is_dir() and (not any(out.iterdir()) or (out / SCHEMA).is_file()))
    if not ours or root.is_relative_to(out) or out.is_relative_to(root / "docs"):
        raise typer.BadParameter(f"{out} holds what no build wrote, and would be deleted; name another folder")
    made = build_site(root)
    out.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=f"{out.name}-", dir=out.parent) as work:
        whole = Path(shutil.copytree(root / "docs", Path(work, "whole")))
        for name, content in made.items():
            path = whole / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        if out.exists():
            shutil.rmtree(out)
        whole.rename(out)
    print(f"{len(made)} files in {out}")


@app.command()
def triage(path: Annotated[Path, typer.Argument(help="A case's folder, or any MJCF or URDF file.")]) -> None:
    """Run the six steps of triage on a model and print what each saw."""
    from clinic.triage.child import reports

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
def print_schema(
    write: Annotated[
        bool, typer.Option("--write", help="Write it where the editor's lines in cases/ find it.")
    ] = False,
) -> None:
    """Print the record's JSON Schema."""
    from clinic.pages.schema import schema_text, write_schema

    if write:
        write_schema(project_root())
    else:
        print(schema_text(), end="")


def _run(slug: str, sweeps: bool) -> tuple[Case, Evidence]:
    """A case and what its runs show, with those of its sweeps if asked for."""
    import mujoco

    from clinic.commands import terminal
    from clinic.engine.releases import CASES, installed
    from clinic.proof.evidence import lack
    from clinic.proof.experiments import measure_case
    from clinic.record.case import load_case
    from clinic.work.cache import Cache

    root = cases_root()
    case = load_case(folders(root, [slug])[0])
    try:
        with terminal.console(stderr=True).status(f"running {case.slug}"):
            return case, measure_case(case, Cache(cache_folder(root)), ("sweeps",) if sweeps else ())
    except CaseError:
        if installed() >= CASES or lack(case):
            raise
        sys.exit(f"clinic: {slug} uses what MuJoCo {mujoco.__version__} does not have: pip install -U mujoco")


def _print_json(data: object) -> None:
    print(json.dumps(data, indent=1, ensure_ascii=False))


def main() -> None:
    """Entry point: a mistake of the author or of the machine ends with its message and exit code 1, not a traceback."""
    try:
        app()
    except CaseError as error:
        sys.exit(str(error))
    except ModuleNotFoundError as error:
        if (error.name or "").startswith("clinic"):
            raise
        sys.exit(f"clinic: {error.name} is not installed; this needs pip install 'mujoco-clinic[site]'")
    except ImportError as error:  # an engine that is too old
        sys.exit(f"clinic: {error}")
    except (FileNotFoundError, ConnectionError, LackError) as error:
        sys.exit(f"clinic: {error}")
