"""The commands about a reader's model: `diagnose`, `rules`, `explain`."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated, Any, Literal

import typer
from typer.core import TyperCommand

app = typer.Typer()
Rules = Annotated[list[str], typer.Option(help="Only this rule, or these with commas between; may be repeated.")]


class _Diagnose(TyperCommand):
    """`--fix` takes a file, or nothing."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        alone = [after.startswith("-") for after in [*args, "-"][1:]]
        given = ["--fix=" if arg == "--fix" and last else arg for arg, last in zip(args, alone, strict=True)]
        return super().parse_args(ctx, given)


@app.command(cls=_Diagnose)
def diagnose(
    models: Annotated[list[str], typer.Argument(metavar="MODEL", help="MJCF or URDF files; `-`: standard input.")] = [],  # noqa: B006
    symptom: Annotated[
        str,
        typer.Option(
            help="What you see, as slips, or in your words: its causes come first, some from smaller numbers on."
        ),
    ] = "",
    keyframe: Annotated[str | None, typer.Option(help="Start from this keyframe, by name or number.")] = None,
    ctrl: Annotated[list[str], typer.Option(help="name=value, or a CSV or NPZ with a column `time`.")] = [],  # noqa: B006
    duration: Annotated[float, typer.Option(min=0.01, max=60, help="How long to let it go, in s.")] = 2.0,
    seed: Annotated[int, typer.Option(help="Of the poses in which loads are measured.")] = 0,
    fix: Annotated[
        str | None,
        typer.Option(metavar="[OUT]", help="Print the edits as a diff; with OUT, write the mended model to this file."),
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="With --fix OUT: over a file that exists.")] = False,
    every: Annotated[bool, typer.Option("--all", help="Print every cause, and the six steps of triage.")] = False,
    form: Annotated[
        Literal["text", "json", "sarif", "github"], typer.Option("--format", help="How to print it.")
    ] = "text",
    select: Rules = [],  # noqa: B006
    ignore: Annotated[list[str], typer.Option(help="Not this rule, or these; may be repeated.")] = [],  # noqa: B006
) -> None:
    """Say what is wrong with your own model; exit code 0 if no cause is found, 1 for a cause, 2 if it cannot be run."""
    from clinic.commands.console import console
    from clinic.commands.diagnosis_options import STDIN, OptionError, chosen_rules, family_of, read_source, start_of
    from clinic.commands.diagnosis_output import check_output, printed, say, write_fix
    from clinic.diagnosis.finding import Diagnosis
    from clinic.diagnosis.process import DiagnosisError
    from clinic.diagnosis.process import diagnose as run

    made: list[tuple[str, Diagnosis]] = []
    failed: list[tuple[str, str]] = []
    try:
        select, ignore = chosen_rules(select, ignore)
        family, others = family_of(symptom)
        if family != symptom:
            or_else = f"; if you mean another one: --symptom {' or --symptom '.join(others)}" if others else ""
            print(f"clinic: --symptom is read as {family}{or_else}", file=sys.stderr)
        check_output(models, form, fix, force)
        start = start_of(keyframe, ctrl, duration, seed)
        with console(stderr=True).status("compiling") as status:
            for model in models:
                source = read_source(model)
                tell = status.update
                try:
                    found = run(source, symptom=family, start=start, select=select, ignore=ignore, tell=tell)
                    made.append((model, found))
                except DiagnosisError as error:
                    failed.append((model, str(error)))
        if fix and made:
            write_fix(*made[0], Path(fix), force)
        for _, said in failed:
            print(f"clinic: {said}", file=sys.stderr)
        if made or form in ("sarif", "github"):
            say(printed(made, failed, form, fix is not None, every))
        unsaid = form == "text" and len(models) == 1 and not (family or select)
        if unsaid and any(not found.causes and (found.hints or not found.error) for _, found in made):
            said = 'say what you see, and weaker signs of it are told, too: --symptom slips, or --symptom "it sags"'
            print(f"clinic: {said}", file=sys.stderr)
        if every and form == "text":
            from clinic.triage.process import reports

            for path in [Path(model) for model, found in made if not found.error and model != STDIN]:
                for report in reports(path):
                    say(report)
    except OptionError as error:
        print(f"clinic: {error}", file=sys.stderr)
        raise typer.Exit(2) from None
    causes, broken = any(found.causes for _, found in made), any(found.error for _, found in made)
    raise typer.Exit(1 if causes else 2 if failed or broken else 0)


@app.command()
def rules() -> None:
    """List the rules that `clinic diagnose` tries."""
    from clinic.commands.diagnosis_options import rules_table

    print(rules_table())


@app.command()
def explain(rule: Annotated[str, typer.Argument(help="A rule, by its id.")]) -> None:
    """Print what a rule looks for, why it matters, an example, and when it is wrong."""
    from clinic.commands.diagnosis_options import explained
    from clinic.diagnosis.ignores import unknown
    from clinic.diagnosis.rules import rules

    if rule not in rules():
        print(f"clinic: {unknown(rule)}", file=sys.stderr)
        raise typer.Exit(2)
    print(explained(rules()[rule]))
