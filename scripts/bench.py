"""Times a cold and a warm build and their parts, and prints them as a table. Called by `make bench`."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from collections.abc import Callable
from pathlib import Path

import mujoco
from clinic.cache import Cache, Files
from clinic.case import Case, load_cases
from clinic.checkout import project_root
from clinic.exhibit import all_exhibits, assembled, evidence_of, evidence_task, figure_task, measuring_tasks
from clinic.simulate import compile_model, step_count
from clinic.site import build
from clinic.variant import variants
from rich.console import Console
from rich.table import Table


def timed(work: Callable[[], object]) -> float:
    """Seconds that `work` takes."""
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def parts(cases: list[Case]) -> dict[str, float]:
    """Seconds of each kind of work, made anew one after the other in this process."""
    spent: dict[str, float] = defaultdict(float)
    for case in cases:
        files: dict[str, Files] = {"first": {}, "rest": {}}

        def run(task: object, kind: str, into: str, files: dict[str, Files] = files) -> None:
            spent[kind] += timed(lambda: files[into].update(task.make()))  # type: ignore[attr-defined]

        run(evidence_task(case), "runs and snippets", "first")
        for task in measuring_tasks(case):
            run(task, task.kind, "rest")
        evidence = assembled(case, files["first"], files["rest"])
        run(figure_task(case, evidence), "plots", "rest")
        evidence_of(files["first"])
    return dict(spent)


def bare_steps(cases: list[Case]) -> tuple[int, float]:
    """How many steps the variants' runs make, and the seconds that `mj_step` alone takes for them."""
    total, spent = 0, 0.0
    for case in cases:
        for variant in variants(case) if case.record.run else []:
            model = compile_model(variant.text)
            data, steps = mujoco.MjData(model), step_count(model, case.record.run)
            mujoco.set_mju_user_warning(lambda text: None)
            spent += timed(lambda m=model, d=data, n=steps: mujoco.mj_step(m, d, nstep=n))  # type: ignore[misc]
            total += steps
    return total, spent


def site(root: Path, out: str, cache: str) -> float:
    """Seconds of a strict MkDocs build into `out`."""
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", out]
    environment = {**os.environ, "CLINIC_CACHE": cache}
    return timed(lambda: subprocess.run(command, cwd=root, env=environment, check=True, capture_output=True))


def main() -> None:
    """Prints the table."""
    root = project_root()
    cases = load_cases(root / "cases")
    table = Table("what", "seconds", title=f"{len(cases)} cases, MuJoCo {mujoco.__version__}, {os.cpu_count()} cores")
    with tempfile.TemporaryDirectory() as folder:
        table.add_row("make site, cold", f"{site(root, f'{folder}/site', f'{folder}/cache'):.1f}")
        table.add_row("make site, warm", f"{site(root, f'{folder}/site', f'{folder}/cache'):.1f}")
        cache = Cache(Path(folder, "cache"))
        table.add_row("  of it the pages, warm", f"{timed(lambda: build(root, cache)):.2f}")
        table.add_row(
            "exhibits of all cases, warm", f"{timed(lambda: all_exhibits(cases, cache)):.2f}", end_section=True
        )
    for kind, seconds in sorted(parts(cases).items(), key=lambda item: -item[1]):
        table.add_row(f"{kind}, one process", f"{seconds:.2f}")
    steps, seconds = bare_steps(cases)
    table.add_row(f"mj_step alone, {steps} steps of all variants", f"{seconds:.2f}")
    Console().print(table)


if __name__ == "__main__":
    main()
