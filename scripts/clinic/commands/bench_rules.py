"""The command `bench-rules`: how good the rules of `clinic diagnose` are."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from clinic.diagnosis.bench.healthy import Healthy
    from clinic.diagnosis.bench.table import Task
    from clinic.diagnosis.bench.trial import Plant

app = typer.Typer()


@app.command()
def bench_rules(
    seed: Annotated[int, typer.Option(help="Of the plants.")] = 0,
    plants: Annotated[int, typer.Option(min=0, help="How often each kind of fault is planted on each side.")] = 4,
    held_out: Annotated[bool, typer.Option("--held-out", help="Also the third that no rule is made with.")] = False,
    kind: Annotated[list[str], typer.Option(help="Only this kind of fault; may be repeated.")] = [],  # noqa: B006
    robot: Annotated[list[str], typer.Option(help="Only models whose path has this in it; may be repeated.")] = [],  # noqa: B006
    as_json: Annotated[bool, typer.Option("--json", help="Print data for a program.")] = False,
    write: Annotated[
        bool,
        typer.Option("--write", help="Write bench.lock.json: all of it, or what --kind names; implies --held-out."),
    ] = False,
    export: Annotated[
        Path | None, typer.Option(help="Also write the plants that do harm into this file, for another tool.")
    ] = None,
    every: Annotated[
        bool, typer.Option("--all", help="Print every plant that was missed, and what was named.")
    ] = False,
) -> None:
    """Measure the rules on healthy models and on faults planted in them; CLINIC_HEALTHY names more folders."""
    from clinic.commands.console import console
    from clinic.diagnosis.bench.faults import kinds
    from clinic.diagnosis.bench.lock import LOCK, kept, lock_text, read_lock, unlawful, with_kinds
    from clinic.diagnosis.bench.table import data, measure, plants_text, tasks
    from clinic.record.checkout import cache_folder, project_root
    from clinic.work.cache import Cache

    if unknown := set(kind) - set(kinds()):
        raise typer.BadParameter(f"no kind of fault: {', '.join(sorted(unknown))}; there are {', '.join(kinds())}")
    if write and robot:
        raise typer.BadParameter("--write measures all models: leave --robot out")
    root: Path = project_root()
    held_out = held_out or write
    with console(stderr=True).status("measuring") as status:
        made = measure(
            root,
            Cache(cache_folder(root)),
            lambda models: _chosen(tasks(_named(models, robot), seed, plants, held_out), kind),
            seed,
            lambda done, of: status.update(f"{done} of {of}"),
        )
    if write:
        new = kept(made, plants)
        (root / LOCK).write_text(lock_text(with_kinds(read_lock(root), new) if kind else new), encoding="utf-8")
        for said in unlawful(read_lock(root)):
            print(said)
    if export is not None:
        export.write_text(plants_text(made), encoding="utf-8")
    table = data(made)
    if as_json:
        print(json.dumps(table, indent=1, ensure_ascii=False))
        return
    _print(table, made.plants if every else [], held_out)


def _print(table: dict[str, Any], plants: Iterable[Plant], held_out: bool) -> None:
    """Two tables, the sums of each side, and in a line each what was named in healthy models and what was missed."""
    from clinic.commands.console import console

    out = console()
    for each in (_rules(table, held_out), _kinds(table, held_out)):
        out.print(each)
    for side in ("seen", "held_out") if held_out else ("seen",):
        healthy, planted = table["healthy"][side], table["planted"][side]
        print(
            f"{side}: {healthy['with_a_cause']} of {healthy['models']} healthy models with a cause, "
            f"{healthy['median_findings']:g} findings each (median); "
            f"{planted['cause']} of {planted['harmful']} harmful faults among the first three causes"
        )
    for model, found in table["models"].items():
        if found["causes"] and (held_out or not found["held_out"]):
            print(f"healthy, but named: {model}: {', '.join(found['causes'])}")
    for plant in plants:
        if plant.harm and plant.outcome != "cause":
            named = ", ".join(f"{each['level']} {each['rule']}" for each in plant.told.findings) or "nothing"
            what = ", ".join(plant.elements[:2])
            print(
                f"{plant.outcome}: {plant.kind} {plant.strength:.3g} in {plant.model}: {what} ({plant.harm}); {named}"
            )
    for model in table["untried"]:
        print(f"no time for every rule: {model}")
    for said in table["stumbled"]:
        print(f"stumbled: {said}")


def _named(models: list[Healthy], parts: list[str]) -> list[Healthy]:
    return [model for model in models if not parts or any(part in model.name for part in parts)]


def _chosen(all_: list[Task], names: list[str]) -> list[Task]:
    """Only the plants of these kinds, where some are named."""
    return [task for task in all_ if not names or task.kind in names]


def _share(counts: dict[str, int]) -> str:
    more = f" +{counts['later'] + counts['hint']}" if counts["later"] + counts["hint"] else ""
    return f"{counts['cause']}/{counts['harmful']}{more}" if counts["harmful"] else ""


def _rules(table: dict[str, Any], held_out: bool) -> Any:
    from rich.table import Column, Table

    sides = ["seen", "held_out"] if held_out else ["seen"]
    made = Table("rule", *sides, "false", "beside", Column("s", justify="right"))
    for row in table["rules"]:
        shares = [_share(row[side]) for side in sides]
        made.add_row(
            row["rule"], *shares, str(len(row["false"]) or ""), str(row["beside"] or ""), f"{row['seconds']:.2f}"
        )
    return made


def _kinds(table: dict[str, Any], held_out: bool) -> Any:
    from rich.table import Table

    sides = ["seen", "held_out"] if held_out else ["seen"]
    made = Table("planted", "rule", *sides, "harmless", "beside")
    for row in table["kinds"]:
        if row["no_place"] or any(row[side]["harmful"] + row[side]["harmless"] for side in sides):
            beside = ", ".join(f"{rule} {count}" for rule, count in row["beside"].items())
            harmless = sum(row[side]["harmless"] for side in sides)
            made.add_row(row["kind"], row["rule"], *(_share(row[side]) for side in sides), str(harmless or ""), beside)
    return made
