"""The measurements of a symptom's page, run on a reader's model."""

from __future__ import annotations

import contextlib
import io
import signal
import warnings
from collections.abc import Iterator, Mapping
from types import FrameType

import mujoco
import numpy as np

from clinic.diagnosis.finding import Measured
from clinic.diagnosis.native import NativeEngine
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.start import Start
from clinic.proof.procedure import measured, measurement, members, read
from clinic.record.case import read_cases
from clinic.record.checkout import cases_root
from clinic.record.families import families

SECONDS = 10  # of the clock, for all measurements of a symptom


def code_of(family: str) -> str:
    """What measures a model for a family; empty where no case of it is told by a measurement on a model."""
    if family not in families():
        return ""
    own = members(family, read_cases(cases_root() / "cases")[0])
    return measurement(family, own) if measured(own) else ""


def measure(family: str, code: str, engine: NativeEngine, texts: Mapping[str, str], start: Start | None) -> Measured:
    """Runs `code` on a model that compiles, at the reader's start; without one at its first key, as the page does."""
    try:
        with _bounded(), warnings.catch_warnings(), contextlib.redirect_stdout(io.StringIO()) as out:
            warnings.simplefilter("ignore")
            spec, native = engine.specified(texts)
            simulation = Simulation(native, start or Start())
            simulation.begin_from(start or Start(key=0 if simulation.count("key") else -1))
            simulation.begin()
            exec(code, {"spec": spec, "model": native.mj, "data": native.mjdata, "mujoco": mujoco, "np": np})
    except Exception as error:  # of an odd model: what one of the measurements cannot deal with
        return Measured(family, {}, (), f"they end with {type(error).__name__}: {' '.join(str(error).split())}")
    said = read(out.getvalue())
    return Measured(family, said.values, tuple(said.told), said.printed)


@contextlib.contextmanager
def _bounded() -> Iterator[None]:
    """Ends what takes longer than `SECONDS`, where the system has an alarm."""

    def late(_signal: int, _frame: FrameType | None) -> None:
        raise TimeoutError(f"they take longer than {SECONDS} s")

    if not hasattr(signal, "SIGALRM"):
        yield
        return
    signal.signal(signal.SIGALRM, late)
    signal.alarm(SECONDS)
    try:
        yield
    finally:
        signal.alarm(0)
