"""The command `clinic`. What is slow to import is imported by the command that needs it."""

from __future__ import annotations

import json
import shutil
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from clinic.record.checkout import cache_folder, folders, project_root, slugs
from clinic.record.problem import CaseError

if TYPE_CHECKING:
    from clinic.commands.judgement import Judgement
    from clinic.proof.evidence import Evidence
    from clinic.record.case import Case

app = typer.Typer(no_args_is_help=True, help="Broken MuJoCo simulations that prove themselves.")


def complete(incomplete: str) -> list[str]:
    """The slugs that begin like this, for the shell."""
    try:
        return [slug for slug in slugs(project_root()) if slug.startswith(incomplete)]
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
    title: Annotated[str | None, typer.Option(help="The symptom as a sentence, without a full stop.")] = None,
    kind: Annotated[str | None, typer.Option(help="Where the bug lives: model, python or javascript.")] = None,
) -> None:
    """Write the folder of a new case, which passes every law until you put your bug into it."""
    from clinic.commands.scaffold import Kind, slug_problems, start
    from clinic.pages.schema import write_schema

    root = project_root()
    if problems := list(slug_problems(root, slug)):
        raise CaseError(problems)
    title = title or _asked("title", "Title, the symptom as a sentence")
    kind = kind or _asked("kind", "Where the bug lives (model, python, javascript)", "model")
    if kind not in list(Kind):
        raise typer.BadParameter(f"{kind} is none of {', '.join(Kind)}", param_hint="--kind")
    place = start(root, slug, title, Kind(kind))
    write_schema(root)
    for path in sorted(place.iterdir()):
        print(path.relative_to(root).as_posix())
    print(f"It passes every law: clinic check {slug}. Now put your bug into it; `make serve` shows the page.")


@app.command()
def check(slugs: Slugs = None, as_json: AsJson = False) -> None:
    """Run cases and judge them by every law; exit code 1 if anything is wrong."""
    from clinic.commands import terminal
    from clinic.commands.judgement import plain

    judgements = _judged(project_root(), slugs or [])
    if as_json:
        _print_json([plain(judgement) for judgement in judgements])
    else:
        out = terminal.console()
        for judgement in judgements if slugs else []:
            if judgement.case and judgement.evidence:
                out.print(terminal.checks_table(judgement.case, judgement.evidence))
        out.print(terminal.summary(judgements))
        for judgement in judgements:
            for said in (*judgement.problems, *judgement.breaches):
                print(said, file=sys.stderr)
    if not all(judgement.sound for judgement in judgements):
        raise typer.Exit(1)


@app.command(name="list")
def list_cases(as_json: AsJson = False) -> None:
    """List the cases by number."""
    from clinic.commands import terminal
    from clinic.record.case import read_cases

    cases, problems = read_cases(project_root() / "cases")
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
    from clinic.pages.text.prose import FieldError

    case, evidence = _run(slug)
    try:
        if as_json:
            _print_json(terminal.case_data(case, evidence, answer))
        else:
            terminal.console().print(terminal.case_text(case, evidence, answer))
    except FieldError as error:
        raise CaseError([case.problem((), error.found, error.expected, error.repair)]) from None


@app.command()
def view(
    slug: Slug,
    fix: Annotated[str, typer.Option(help="A fix or refuted remedy, by its id; the broken model when left out.")] = "",
) -> None:
    """Open a case's model in MuJoCo's viewer, at the start of its run."""
    from clinic.commands.viewer import view as open_viewer
    from clinic.engine.variant import BROKEN
    from clinic.record.case import load_case

    (folder,) = folders(project_root(), [slug])
    try:
        open_viewer(load_case(folder), fix or BROKEN)
    except RuntimeError as error:
        sys.exit(f"clinic: {error}")


@app.command()
def cache(clear: Annotated[bool, typer.Option("--clear", help="Forget everything kept.")] = False) -> None:
    """Show where finished work is kept and how much of it, or clear it."""
    from clinic.work.cache import Cache

    kept = Cache(cache_folder(project_root()))
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

    root = project_root()
    own = [root / name for name in ("docs", "cases", "scripts", "tests", ".git", ".venv", "node_modules")]
    if root.is_relative_to(out.resolve()) or any(out.resolve().is_relative_to(folder) for folder in own):
        raise typer.BadParameter(f"{out} holds the project's own files and would be deleted; name another folder")
    if out.is_symlink() or (out.exists() and not out.is_dir()):
        raise typer.BadParameter(f"{out} is no folder; name one")
    if out.exists() and any(out.iterdir()) and not (out / SCHEMA).is_file():
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

    (folder,) = folders(project_root(), [slug])
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


def _judged(root: Path, wanted: list[str]) -> list[Judgement]:
    """The judgements of the cases named, of all when none is, by number; progress goes to stderr."""
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    from clinic.commands import terminal
    from clinic.commands.judgement import Neighbours, judge_folder
    from clinic.work.cache import Cache

    named = folders(root, wanted)
    err = terminal.console(stderr=True)
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=err, transient=True, disable=not err.is_terminal) as progress:
        task = progress.add_task("reading", total=len(named))
        neighbours, store, judgements = Neighbours(root), Cache(cache_folder(root)), []
        for folder in named:

            def tell(said: str, name: str = folder.name) -> None:
                progress.update(task, description=f"{name}: {said}")

            judgements.append(judge_folder(folder, neighbours, store, tell))
            progress.advance(task)
    return sorted(judgements, key=lambda found: found.case.record.number if found.case else 0)


def _run(slug: str) -> tuple[Case, Evidence]:
    """A case and what its runs show."""
    from clinic.commands import terminal
    from clinic.pages.exhibits import evidence_of, exhibits
    from clinic.record.case import load_case
    from clinic.work.cache import Cache

    root = project_root()
    case = load_case(folders(root, [slug])[0])
    with terminal.console(stderr=True).status(f"running {case.slug}"):
        return case, evidence_of(exhibits(case, Cache(cache_folder(root))))


def _asked(option: str, question: str, default: str | None = None) -> str:
    """The answer of whoever sits at the terminal; the default where nobody does."""
    if _asks():
        return str(typer.prompt(question, default=default))
    if default is None:
        raise typer.BadParameter("give it, for nobody can be asked here", param_hint=f"--{option}")
    return default


def _asks() -> bool:
    return sys.stdin.isatty()


def _print_json(data: object) -> None:
    print(json.dumps(data, indent=1, ensure_ascii=False))


def main() -> None:
    """Entry point: a mistake of the author or of the machine ends with its message and exit code 1, not a traceback."""
    try:
        app()
    except CaseError as error:
        sys.exit(str(error))
    except (FileNotFoundError, ConnectionError) as error:
        sys.exit(f"clinic: {error}")
