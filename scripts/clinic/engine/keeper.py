"""A process that answers orders, a line each, and stays for the next one: what it has imported serves them all."""

from __future__ import annotations

import atexit
import os
import subprocess
import threading
from collections.abc import Callable
from contextlib import suppress


class Keeper:
    """Started at the first order, and anew where it has ended, as it does with the thread that it came from.

    Args:
        start: Starts the process, with pipes for text at its stdin and stdout.
    """

    def __init__(self, start: Callable[[], subprocess.Popen[str]]) -> None:
        self.start, self.lock = start, threading.Lock()
        self.process: subprocess.Popen[str] | None = None
        self.owner = 0
        atexit.register(self.dismiss)

    def ask(self, order: str) -> str:
        """The answer to a line of text; empty if the process ended over it twice."""
        with self.lock:
            for _ in range(2):
                if answer := self._asked(order):
                    return answer
        return ""

    def dismiss(self) -> None:
        """Ends the process; a fork of this one leaves it to its parent."""
        process, self.process = self.process, None
        if process is not None and self.owner == os.getpid():
            process.kill()
            with suppress(BrokenPipeError):
                process.communicate()

    def _asked(self, order: str) -> str:
        if self.process is None or self.owner != os.getpid():
            self.process, self.owner = self.start(), os.getpid()
        assert self.process.stdin is not None
        assert self.process.stdout is not None
        answer = ""
        try:
            with suppress(BrokenPipeError):
                self.process.stdin.write(order + "\n")
                self.process.stdin.flush()
                answer = self.process.stdout.readline()
            return answer
        finally:
            if not answer:
                self.dismiss()
