"""Triage in a process of its own, bounded in time and memory: whatever a model does to it, the report ends.

Run as a module with a path, it prints each message as a line of JSON behind MARK.
"""

from __future__ import annotations

import json
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from subprocess import DEVNULL, PIPE, Popen

from clinic.record.problem import CaseError, Problem
from clinic.triage.steps import SECONDS, STEPS, report, subject_of, triage

LIMIT = 30.0  # s
MEMORY = 4 * 2**30  # bytes
MARK = "\x1e"
CHILD = (sys.executable, "-m", "clinic.triage.process")


def reports(path: Path, limit: float = LIMIT, child: tuple[str, ...] = CHILD) -> Iterator[str]:
    """The report of each step, as soon as it is made.

    Raises:
        CaseError: If the model cannot be read, or its process ends early or not within `limit` seconds.
    """
    command = [*child, str(path)]
    process = Popen(command, stdin=DEVNULL, stdout=PIPE, stderr=DEVNULL, encoding="utf-8", errors="replace")
    assert process.stdout is not None
    timer = threading.Timer(limit, process.kill)
    timer.start()
    doing = ["reading the model", *(title for title, _ in STEPS.values())]
    try:
        for line in process.stdout:
            if line.startswith(MARK):
                message = json.loads(line[len(MARK) :])
                if "problems" in message:
                    raise CaseError(Problem(**problem) for problem in message["problems"])
                doing.pop(0)
                yield from message["reports"]
        late = timer.finished.is_set()
        code = process.wait()
    finally:
        timer.cancel()
        process.kill()
        process.communicate()
    if doing:
        how = f"no answer within {limit:g} s" if late else f"MuJoCo ended the process (exit code {code})"
        raise CaseError([_problem(path, f"{how}, at: {doing[0]}")])


def main(path: Path) -> None:
    """Prints the report of each step, or the problems of reading the model."""
    if sys.platform == "linux":
        import resource

        resource.setrlimit(resource.RLIMIT_DATA, (MEMORY, MEMORY))
    try:
        subject = subject_of(path)
        _tell(reports=[])
        for observation in triage(subject, SECONDS):
            _tell(reports=[report(observation)])
    except CaseError as error:
        _tell(problems=[vars(problem) for problem in error.problems])
    except Exception as error:
        _tell(problems=[vars(_problem(path, f"{type(error).__name__}: {error}"))])


def _problem(path: Path, found: str) -> Problem:
    return Problem(str(path), 1, "", found, "a model that MuJoCo can run", "remove half of the model")


def _tell(**message: object) -> None:
    print(MARK + json.dumps(message), flush=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
