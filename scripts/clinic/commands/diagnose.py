"""The commands about a reader's model: `diagnose`, `rules`, `explain`."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Annotated, Literal

import typer

app = typer.Typer()
Rules = Annotated[list[str], typer.Option(help="Only this rule; may be repeated.")]


@app.command()
def diagnose(
    model: Annotated[str, typer.Argument(help="An MJCF or URDF file; `-` reads standard input.")],
    symptom: Annotated[str, typer.Option(help="What you see, as slips, or in your words: its causes come first.")] = "",
    keyframe: Annotated[str | None, typer.Option(help="Start from this keyframe, by name or number.")] = None,
    ctrl: Annotated[list[str], typer.Option(help="name=value, or a CSV or NPZ with a column `time`.")] = [],  # noqa: B006
    duration: Annotated[float, typer.Option(min=0.01, max=60, help="How long to let it go, in s.")] = 2.0,
    seed: Annotated[int, typer.Option(help="Of whatever is drawn.")] = 0,
    fix: Annotated[bool, typer.Option("--fix", help="Print the edits as a diff.")] = False,
    out: Annotated[Path | None, typer.Option(help="With --fix: write the mended model to this new file.")] = None,
    every: Annotated[bool, typer.Option("--all", help="Print every cause, and the six steps of triage.")] = False,
    form: Annotated[Literal["text", "json"], typer.Option("--format", help="How to print it.")] = "text",
    select: Rules = [],  # noqa: B006
    ignore: Annotated[list[str], typer.Option(help="Not this rule; may be repeated.")] = [],  # noqa: B006
) -> None:
    """Say what is wrong with your own model; exit code 0 if nothing is found, 1 for a cause, 2 if it cannot be run."""
    from clinic.commands import terminal
    from clinic.commands.diagnosis_options import OptionError, check_rules, family_of, start_of
    from clinic.diagnosis.process import DiagnosisError
    from clinic.diagnosis.process import diagnose as run

    err = terminal.console(stderr=True)
    try:
        check_rules([*select, *ignore])
        symptom = family_of(symptom)
        start = start_of(keyframe, ctrl, duration, seed, model)
        source = sys.stdin.read() if model == "-" else model
        if model == "-" and not source.lstrip("\ufeff \r\n\t").startswith("<"):
            raise OptionError("standard input: no XML")
        with err.status("compiling") as status:
            made = run(source, symptom=symptom, start=start, select=select, ignore=ignore, tell=status.update)
        if out is not None and fix:
            if out.exists():
                raise OptionError(f"{out} exists; name a new file")
            out.write_text(next(iter(made.fixed.values())), encoding="utf-8")
    except (OptionError, DiagnosisError, OSError) as error:
        print(f"clinic: {error}", file=sys.stderr)
        raise typer.Exit(2) from None
    if form == "json":
        print(json.dumps(made.data(), indent=1, ensure_ascii=False, allow_nan=False))
    elif fix:
        print(made.diff() or "nothing to change", end="")
    else:
        print(made.text(every))
    if every and form == "text" and not made.error and model != "-":
        from clinic.triage.process import reports

        for said in reports(Path(model)):
            print(said, flush=True)
    raise typer.Exit(1 if made.causes else 2 if made.error else 0)


@app.command()
def rules() -> None:
    """List the rules that `clinic diagnose` tries."""
    from clinic.commands.diagnosis_options import rules_table

    print(rules_table())


@app.command()
def explain(rule: Annotated[str, typer.Argument(help="A rule, by its id.")]) -> None:
    """Print what a rule looks for, why it matters, an example, and when it is wrong."""
    from clinic.commands.diagnosis_options import explained, unknown
    from clinic.diagnosis.rules import rules

    if rule not in rules():
        print(f"clinic: {unknown(rule)}", file=sys.stderr)
        raise typer.Exit(2)
    print(explained(rules()[rule]))
