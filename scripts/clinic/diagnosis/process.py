"""A diagnosis in a process of its own, bounded in time and memory; begun anew where the engine dies of the model."""

from __future__ import annotations

import base64
import math
import os
import pickle
import subprocess
import sys
import threading
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from clinic.diagnosis.diagnose import examine
from clinic.diagnosis.finding import KILLED, LATE, Diagnosis, ending
from clinic.diagnosis.ignores import unknown
from clinic.diagnosis.rules import rules
from clinic.diagnosis.start import Start, StartError
from clinic.diagnosis.texts import decoded, read_file, read_texts
from clinic.record.families import families

LIMIT = 60  # s of processor time, for one process
PATIENCE = 300.0  # s by the clock, for one that waits, or has to
MEMORY = 4 * 2**30  # bytes
KILL, XCPU = 9, 24  # the signals with which the system ends what it has no memory, and no time for
DEATHS = 5  # of the engine, after which the diagnosis ends
MEASURING = "what the symptom's page measures"
CHILD = (sys.executable, "-m", "clinic.diagnosis.process")


class DiagnosisError(ValueError):
    """A model that cannot be diagnosed, in a sentence."""


@dataclass(frozen=True)
class Request:
    """What the process is asked: a model's text, what to call it, the folder that its files are found from."""

    text: str
    name: str
    folder: str
    assets: Mapping[str, bytes]
    symptom: str
    measurement: str
    start: Start | None
    select: tuple[str, ...]
    ignore: tuple[str, ...]
    model: Any = None  # the `mujoco.MjModel` that a program made of the text


def diagnose(
    source: Any,
    *,
    assets: Mapping[str, bytes] | None = None,
    symptom: str = "",
    start: Start | None = None,
    select: Collection[str] = (),
    ignore: Collection[str] = (),
    tell: Callable[[str], None] = lambda _: None,
) -> Diagnosis:
    """Diagnoses a reader's model.

    Args:
        source: The path of an MJCF or URDF file; a text, which begins with `<`; an `mujoco.MjSpec`; or a pair of an
            `mujoco.MjModel` and the path or text that it was compiled from. The text is what is diagnosed; a hint says
            where the model has other numbers.
        assets: Files that the model names, by name, where they lie on no disk.
        symptom: The family of symptoms that is seen (`clinic/record/families.toml`); its causes come first, and what
            the program of its page measures is told with them.
        start: Keyframe, controls, duration and seed; where left out, the model's start, and then its first keyframe.
        select: Rules to try; all where empty.
        ignore: Rules not to try.
        tell: Is called with the id of each rule before it is tried.

    Raises:
        DiagnosisError: If the model cannot be read, is given in another form, or does not have the start; or if another
            argument is not what it may be.
    """
    check_rules(select, ignore)
    _check(symptom, start)
    model, source = _pair(source)
    text, name, folder = _read(source)
    given = {key: value if isinstance(value, bytes) else str(value).encode() for key, value in (assets or {}).items()}
    request = Request(text, name, folder, given, symptom, _code_of(symptom), start, tuple(select), tuple(ignore), model)
    died: dict[str, str] = {}
    while True:
        made, trying, said = _asked(replace(request, ignore=(*request.ignore, *died)), tell)
        if made is not None:
            return ending(made, died, name)
        died[trying] = said
        if not trying or len(died) > DEATHS:
            doing = f"while trying {trying}" if trying else "while compiling the model"
            ended = {
                LATE: f"no answer in {LIMIT} s of processor time, or in {PATIENCE:g} s by the clock,",
                KILLED: "the system ended the process, as it does where memory runs out,",
                "": "MuJoCo ended the process",
            }.get(said, said)
            raise DiagnosisError(f"{name}: {ended} {doing}")


def check_rules(select: Collection[str], ignore: Collection[str]) -> None:
    """Whether there are these rules, and some of them are left.

    Raises:
        DiagnosisError: If not, with the nearest rule.
    """
    for given in (select, ignore):
        if isinstance(given, str):
            raise DiagnosisError(f"{given!r}: expected a list of rules")
    for rule in (*select, *ignore):
        if rule not in rules():
            raise DiagnosisError(unknown(rule))
    if not set(select or rules()) - set(ignore):
        raise DiagnosisError(f"ignore {','.join(ignore)}: no rule is left")


def _check(symptom: str, start: Start | None) -> None:
    if symptom and symptom not in families():
        raise DiagnosisError(f"symptom {symptom}: expected one of {', '.join(families())}")
    if start and not 0 < start.duration < math.inf:
        raise DiagnosisError(f"duration {start.duration}: expected a time in s")


def _code_of(symptom: str) -> str:
    """The program of a symptom's page; the records of the cases are read for it only where a symptom is named."""
    if not symptom:
        return ""
    from clinic.diagnosis.symptom import code_of

    return code_of(symptom)


def _pair(source: Any) -> tuple[Any, Any]:
    """A model and its source; None for the one where only the other is given. dm_control has a class around a model."""
    if not isinstance(source, tuple) or len(source) != 2:
        return None, source
    model = getattr(source[0], "ptr", source[0])
    if type(model).__name__ != "MjModel":
        raise DiagnosisError(f"({type(model).__name__}, ...): expected a pair of an MjModel and its path or text")
    return model, source[1]


def _read(source: Any) -> tuple[str, str, str]:
    if hasattr(source, "to_xml"):
        try:
            return source.to_xml(), "MjSpec", str(getattr(source, "modelfiledir", "") or os.getcwd())
        except ValueError as error:
            said = str(error).strip()
            raise DiagnosisError(
                f"MjSpec: it does not compile, and so has no XML; give the text instead: {said}"
            ) from None
    if isinstance(source, str) and source.lstrip("\ufeff \t\r\n").startswith("<"):
        return source, "model.xml", os.getcwd()
    if not isinstance(source, (str, Path)):
        raise DiagnosisError(f"{type(source).__name__}: expected a path, a text, an MjSpec, or a pair (model, xml)")
    path = Path(source).absolute()
    if path.is_char_device() or path.is_block_device():  # /dev/zero ends never
        raise DiagnosisError(f"{source}: not a regular file")
    try:
        return decoded(path.read_bytes())[0], path.name, str(path.parent)
    except OSError as error:
        raise DiagnosisError(f"{source}: {error.strerror or error}") from None
    except ValueError as error:
        raise DiagnosisError(f"{source}: not a text in UTF-8: {error}") from None


def _asked(request: Request, tell: Callable[[str], None]) -> tuple[Diagnosis | None, str, str]:
    """The answer of a process; or None, the rule that was being tried, and the clinic's own mistake, LATE or KILLED."""
    found = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}  # what this process can import
    pipe = subprocess.PIPE
    child = subprocess.Popen(CHILD, stdin=pipe, stdout=pipe, stderr=subprocess.DEVNULL, env=found)
    if sys.platform == "linux":
        import resource

        resource.prlimit(child.pid, resource.RLIMIT_CPU, (LIMIT, LIMIT + 1))
    late = threading.Event()

    def end() -> None:
        late.set()
        child.kill()

    timer = threading.Timer(PATIENCE, end)
    timer.start()
    trying, status = "", 0
    try:
        assert child.stdin is not None
        assert child.stdout is not None
        child.stdin.write(base64.b64encode(pickle.dumps(request)) + b"\n")
        child.stdin.flush()
        for line in child.stdout:
            kind, _, rest = line.strip().partition(b" ")
            if kind == b"trying":
                tell(rest.decode())
                trying = rest.decode().partition(":")[0]
            if kind == b"made":
                return pickle.loads(base64.b64decode(rest)), trying, ""
            if kind == b"failed":
                return None, trying, rest.decode()
            if kind == b"wrong":
                raise DiagnosisError(rest.decode())
        status = child.wait()
    except BrokenPipeError:
        pass
    finally:
        timer.cancel()
        child.kill()
        child.communicate()
    return None, trying, LATE if late.is_set() or status == -XCPU else KILLED * (status == -KILL)


def _end_with_who_asked() -> None:
    """Ends this process where the one that asked is gone, and its end of the pipe with it."""
    while os.read(0, 1):
        pass
    os._exit(1)


def main() -> None:
    """Answers one request."""
    if sys.platform == "linux":
        import resource

        resource.setrlimit(resource.RLIMIT_DATA, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    from clinic.diagnosis.native import NativeEngine

    request: Request = pickle.loads(base64.b64decode(sys.stdin.buffer.readline()))
    threading.Thread(target=_end_with_who_asked, daemon=True).start()
    os.chdir(request.folder)

    def read(name: str) -> str | None:
        there = request.assets.get(name)
        return there.decode(errors="replace") if there is not None else read_file(name)

    engine = NativeEngine(request.assets)
    try:
        texts = read_texts(request.text, request.name, read)
        made = examine(
            engine,
            texts,
            symptom=request.symptom,
            start=request.start,
            select=request.select,
            ignore=request.ignore,
            tell=lambda rule: print(f"trying {rule}", flush=True),
        )
        if request.model is not None and not made.error:
            from clinic.diagnosis.given import changed

            others = {each: text for each, text in texts.items() if each != request.name}
            hints = changed(request.model, engine.compile(request.text, others).mj, request.name)
            made = replace(made, hints=(*hints, *made.hints))
        if request.measurement and not made.error and MEASURING not in request.ignore:
            from clinic.diagnosis.symptom import measure

            print(f"trying {MEASURING}", flush=True)
            told = measure(request.symptom, request.measurement, engine, made.texts, request.start)
            made = replace(made, measured=told)
    except (MemoryError, RecursionError) as error:
        deep = isinstance(error, RecursionError)
        why = "its elements stand too deep within one another" if deep else "there is not memory enough"
        said = error if "MuJoCo" in str(error) else f"the model is too large: {why}"
        print(f"wrong {request.name}: {said}", flush=True)
        return
    except StartError as error:
        print(f"wrong {request.name}: {error}", flush=True)
        return
    except Exception as error:  # ours, and not to be taken for the engine's
        print("failed", " ".join(f"{type(error).__name__}: {error}".split()), flush=True)
        return
    sys.stdout.buffer.write(b"made " + base64.b64encode(pickle.dumps(made)) + b"\n")


if __name__ == "__main__":
    main()
