"""A diagnosis in a process of its own, bounded in time and memory; begun anew where the engine dies of the model."""

from __future__ import annotations

import base64
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
from clinic.diagnosis.start import Start, StartError
from clinic.diagnosis.texts import decoded, read_file, read_texts

LIMIT = 60.0  # s, for one process
MEMORY = 4 * 2**30  # bytes
KILL = 9  # the signal with which the system ends what it has no memory for
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
            `mujoco.MjModel` and the path or text that it was compiled from.
        assets: Files that the model names, by name, where they lie on no disk.
        symptom: The family of symptoms that is seen (`clinic/record/families.toml`); its causes come first, and what
            the program of its page measures is told with them.
        start: Keyframe, controls, duration and seed; where left out, the model's start, and then its first keyframe.
        select: Rules to try; all where empty.
        ignore: Rules not to try.
        tell: Is called with the id of each rule before it is tried.

    Raises:
        DiagnosisError: If the model cannot be read, is given in another form, or does not have the start.
    """
    text, name, folder = _read(source)
    given = {key: value if isinstance(value, bytes) else str(value).encode() for key, value in (assets or {}).items()}
    request = Request(text, name, folder, given, symptom, _code_of(symptom), start, tuple(select), tuple(ignore))
    died: dict[str, str] = {}
    while True:
        made, trying, said = _asked(replace(request, ignore=(*request.ignore, *died)), tell)
        if made is not None:
            return ending(made, died, name)
        died[trying] = said
        if not trying or len(died) > DEATHS:
            doing = f"while trying {trying}" if trying else "while compiling the model"
            ended = {
                LATE: f"no answer in {LIMIT:g} s",
                KILLED: "the system ended the process, as it does where memory runs out,",
                "": "MuJoCo ended the process",
            }.get(said, said)
            raise DiagnosisError(f"{name}: {ended} {doing}")


def _code_of(symptom: str) -> str:
    """The program of a symptom's page; the records of the cases are read for it only where a symptom is named."""
    if not symptom:
        return ""
    from clinic.diagnosis.symptom import code_of

    return code_of(symptom)


def _read(source: Any) -> tuple[str, str, str]:
    if isinstance(source, tuple) and len(source) == 2:
        return _read(source[1])
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
    late = threading.Event()

    def end() -> None:
        late.set()
        child.kill()

    timer = threading.Timer(LIMIT, end)
    timer.start()
    trying, killed = "", False
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
        killed = child.wait() == -KILL
    except BrokenPipeError:
        pass
    finally:
        timer.cancel()
        child.kill()
        child.communicate()
    return None, trying, LATE if late.is_set() else KILLED * killed


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
        made = examine(
            engine,
            read_texts(request.text, request.name, read),
            symptom=request.symptom,
            start=request.start,
            select=request.select,
            ignore=request.ignore,
            tell=lambda rule: print(f"trying {rule}", flush=True),
        )
        if request.measurement and not made.error and MEASURING not in request.ignore:
            from clinic.diagnosis.symptom import measure

            print(f"trying {MEASURING}", flush=True)
            told = measure(request.symptom, request.measurement, engine, made.texts, request.start)
            made = replace(made, measured=told)
    except (MemoryError, RecursionError) as error:
        print(f"wrong {request.name}: {type(error).__name__}: the model is too large", flush=True)
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
