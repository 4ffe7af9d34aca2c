"""The command `clinic`."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

from clinic.cache import Cache
from clinic.case import Case, load_case, load_cases
from clinic.evidence import Evidence
from clinic.exhibit import evidence_of, exhibits
from clinic.laws import all_complaints
from clinic.problem import CaseError
from clinic.prose import quantity
from clinic.reference import reference
from clinic.site import build as build_site
from clinic.site import cache_folder, project_root
from clinic.triage.child import reports

app = typer.Typer(add_completion=False, no_args_is_help=True, help="Broken MuJoCo simulations that prove themselves.")


@app.command()
def build(out: Annotated[Path, typer.Option(help="The folder to write; made anew.")]) -> None:
    """Write the pages as real files, beside those written by hand."""
    root = project_root()
    own = [root / name for name in ("docs", "cases", "scripts", "tests", ".git")]
    if root.is_relative_to(out.resolve()) or any(out.resolve().is_relative_to(folder) for folder in own):
        raise typer.BadParameter(f"{out} holds the project's own files and would be deleted; name another folder")
    made = build_site(root)
    if out.exists():
        shutil.rmtree(out)
    shutil.copytree(root / "docs", out)
    for name, content in made.items():
        path = out / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    print(f"{len(made)} files in {out}")


@app.command()
def check(slug: Annotated[str | None, typer.Argument(help="A case; all when left out.")] = None) -> None:
    """Run a case and judge it by every law."""
    root = project_root()
    cases = load_cases(root / "cases") if slug is None else [load_case(root / "cases" / slug)]
    cache = Cache(cache_folder(root))
    failures: list[str] = []
    for case in cases:
        evidence = evidence_of(exhibits(case, cache))
        Console().print(_table(case, evidence))
        failures += all_complaints(case, evidence)
    for failure in failures:
        print(failure, file=sys.stderr)
    if failures:
        raise typer.Exit(1)


@app.command(name="reference")
def print_reference() -> None:
    """Print the record's reference as Markdown."""
    print(reference())


@app.command()
def triage(path: Annotated[Path, typer.Argument(help="A case's folder, or any MJCF or URDF file.")]) -> None:
    """Run the six steps of triage on a model and print what each saw."""
    for said in reports(path):
        print(said, flush=True)


def _table(case: Case, evidence: Evidence) -> Table:
    table = Table("variant", "kind", "check", "measured", "holds", title=f"{case.record.number}. {case.record.title}")
    for key, variant in evidence.variants.items():
        for kind, results in variant.checks.items():
            for result in results:
                unit = "s" if result.take == "onset" else variant.traces[result.signal].unit
                value = "nothing" if result.measured is None else quantity(result.measured, unit, 6)
                claim = f"{kind}: {result.signal} {result.take} {result.expected}"
                table.add_row(key, variant.kind, claim, value, "yes" if result.holds else "no")
    return table


def main() -> None:
    """Entry point: an author's mistake ends with its message and exit code 1, not with a traceback."""
    try:
        app()
    except CaseError as error:
        sys.exit(str(error))
    except FileNotFoundError as error:
        sys.exit(f"clinic: {error}")
