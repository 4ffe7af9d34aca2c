"""Triage in a process of its own: whatever a model does to the engine, the report ends with a message.

Run as a module with a path, it prints each observation as a line of JSON behind MARK.
"""

from __future__ import annotations

import json
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

from clinic.record.problem import CaseError, Problem
from clinic.triage.run import Budget
from clinic.triage.steps import SECONDS, STEPS, report, subject_of, triage

LIMIT = 30.0
MARK = "\x1e"
CHILD = (sys.executable, "-m", "clinic.triage.child")


def reports(path: Path, limit: float = LIMIT, child: tuple[str, ...] = CHILD) -> Iterator[str]:
    """The report of each step, as soon as it is made.

    Raises:
        CaseError: If the model cannot be read, or its process ends early or not within `limit` seconds.
    """
    process = subprocess.Popen(
        [*child, str(path)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    )
    late = threading.Event()

    def stop() -> None:
        late.set()
        process.kill()

    timer = threading.Timer(limit, stop)
    timer.start()
    at = -1  # which step is being taken
    try:
        assert process.stdout is not None
        for line in process.stdout:
            if line.startswith(MARK):
                message = json.loads(line[len(MARK) :])
                if "read" in message:
                    at = 0
                    continue
                if "problems" in message:
                    raise CaseError(Problem(**problem) for problem in message["problems"])
                at += 1
                yield message["report"]
        code = process.wait()
    finally:
        timer.cancel()
        process.kill()
        process.wait()
        if process.stdout is not None:
            process.stdout.close()
    if at < len(STEPS):
        title = "reading the model" if at < 0 else list(STEPS.values())[at][0]
        how = f"no answer within {limit:g} s" if late.is_set() else f"MuJoCo ended the process (exit code {code})"
        raise CaseError(
            [
                Problem(
                    str(path), 1, "", f"{how}, at: {title}", "a model that MuJoCo can run", "remove half of the model"
                )
            ]
        )


def main(path: Path) -> None:
    """Prints the report of each step, or the problems of reading the model."""
    try:
        subject = subject_of(path)
        _tell({"read": subject.name})
        for observation in triage(subject, Budget(SECONDS)):
            _tell({"report": report(observation)})
    except CaseError as error:
        _tell({"problems": [vars(problem) for problem in error.problems]})


def _tell(message: object) -> None:
    print(MARK + json.dumps(message), flush=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
