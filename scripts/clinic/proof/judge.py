"""A reader's model or script judged against a case, in a process of its own: anything may be in the file.

Run as a module with a case's folder and a file, it prints the judgement as JSON.
"""

from __future__ import annotations

import json
import resource
import subprocess
import sys
from dataclasses import asdict, dataclass
from math import isnan
from pathlib import Path

import mujoco

from clinic.engine.checks import expected, judge
from clinic.engine.mjcf import newer_release
from clinic.engine.simulate import compile_model
from clinic.engine.variant import EditError
from clinic.proof.task import changes
from clinic.proof.trials import checks_in, run_trial
from clinic.record.case import Case, load_case
from clinic.record.fields import Trial

SECONDS = 60.0
MEMORY = 4 * 2**30  # bytes


@dataclass(frozen=True)
class Judgement:
    """Whether a text repairs a case.

    Args:
        case: The case's slug.
        error: Why the text cannot be run; empty if it can.
        failed: What does not hold, a sentence for each check, the situation first.
        changes: What was changed of the task, a sentence each.
    """

    case: str
    error: str = ""
    failed: tuple[str, ...] = ()
    changes: tuple[str, ...] = ()

    @property
    def repaired(self) -> bool:
        """Whether every check holds and the task is the same."""
        return not (self.error or self.failed or self.changes)


def judge_file(folder: Path, file: Path, seconds: float = SECONDS) -> Judgement:
    """The judgement of a file against the case in `folder`, made by another process within limits."""
    command = [sys.executable, "-m", "clinic.proof.judge", str(folder), str(file)]
    try:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, timeout=seconds, check=False)
    except subprocess.TimeoutExpired:
        return Judgement(folder.name, f"it takes more than {seconds:g} s")
    try:
        return Judgement(**json.loads(done.stdout.splitlines()[-1]))
    except (ValueError, TypeError, IndexError):
        return Judgement(folder.name, f"MuJoCo ended the process (exit code {done.returncode})")


def judge_text(case: Case, text: str) -> Judgement:
    """The judgement of a text against a case, made here."""
    changed: list[str] = []
    try:
        if case.record.run is not None:
            changed = changes(compile_model(case.text), compile_model(text), case.record.task)
        failed = []
        for trial in (None, *case.record.trials):
            try:
                failed += _failed(case, text, trial)
            except (ValueError, KeyError) as error:  # a KeyError names an element that the text lacks
                if trial is None and not changed:
                    raise
                failed += [_stopped(trial, error)] if trial else []
    except (ValueError, KeyError) as error:
        said = f"{newer_release(str(error), mujoco.__version__)} {error}"
        return Judgement(case.slug, " ".join(said.split()) or type(error).__name__)
    return Judgement(case.slug, failed=tuple(failed), changes=tuple(changed))


def _stopped(trial: Trial, error: Exception) -> str:
    """Why a text that runs cannot be run in a trial."""
    if isinstance(error, EditError):
        return f"The trial '{trial.title}' changes {trial.edits[error.index].find!r}: leave that in the script, once."
    return f"In the trial '{trial.title}' it cannot be run: {' '.join(str(error).split())}"


def _failed(case: Case, text: str, trial: Trial | None) -> list[str]:
    """What does not hold in a trial, or in the record's run."""
    warnings, traces = run_trial(case, text, trial)
    where = f"In the trial '{trial.title}': " if trial else ""
    told = [f"{where}MuJoCo warns of {name}." for name in warnings]
    for check in checks_in(case.record, trial).fixed:
        verdict = judge(check, traces)
        if not verdict.holds:
            signal = case.record.signals[check.signal]
            unit = "s" if check.take == "onset" else signal.unit
            value = verdict.measured
            seen = "cannot be measured" if isnan(value) else f"is {value:.4g} {unit}".rstrip()
            taken = f"{signal.label or check.signal} ({check.take}"
            taken += f", {check.window[0]:g} to {check.window[1]:g} s)" if check.window else ")"
            bound = expected(check, (f"{{:g}} {unit}".rstrip()).format)
            told.append(f"{where}{taken} {seen}; expected {bound}.")
    return told


def main() -> None:
    """Prints the judgement of a file."""
    for kind, limit in ((resource.RLIMIT_DATA, MEMORY), (resource.RLIMIT_CORE, 0)):
        resource.setrlimit(kind, (limit, limit))
    folder, file = Path(sys.argv[1]), Path(sys.argv[2])
    try:
        made = judge_text(load_case(folder), file.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, MemoryError) as error:
        made = Judgement(folder.name, f"{file.name}: {getattr(error, 'strerror', None) or error or 'too large'}")
    print(json.dumps(asdict(made)), flush=True)


if __name__ == "__main__":
    main()
