"""A model's text before the engine sees it: one file, nothing that leads out of it, and no engine that never ends.

MuJoCo reads what `include` and `file` name from wherever they point. It leaves a DOCTYPE and its entities alone, but a
model has no use for them. A few characters can ask it for more time or memory than there is; so a text of a case
compiles first in a process of its own.
"""

from __future__ import annotations

import json
import os
import resource
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from xml.parsers import expat

from clinic.engine.keeper import Keeper
from clinic.record.yaml_lines import CONTROL, named

SECONDS = 20
MEMORY = 2 * 2**30
PIPE = 4096
LATE = (-signal.SIGXCPU, -signal.SIGKILL)
FOLDERS = ("meshdir", "texturedir", "assetdir")


class ModelError(ValueError):
    """A model's text that is refused; `line` counts from 1."""

    def __init__(self, line: int, found: str, expected: str, repair: str) -> None:
        self.line, self.found, self.expected, self.repair = line, found, expected, repair
        super().__init__(line, found, expected, repair)

    def __str__(self) -> str:
        return f"{self.found}, line {self.line}"


@dataclass(frozen=True)
class Reference:
    """An attribute that names a file or a folder."""

    line: int
    element: str
    attribute: str
    value: str

    def __str__(self) -> str:
        return f'<{self.element} {self.attribute}="{self.value}">'


def references(xml: str) -> list[Reference]:
    """Every attribute of a text that makes the engine read something else, as far as the text can be read.

    Raises:
        ModelError: For a DOCTYPE, or a character that cannot be shown.
    """
    found: list[Reference] = []
    for line, element, attributes in _elements(xml):
        for name, value in attributes.items():
            if strange := CONTROL.search(value):
                told = f"{named(strange[0])} in {name} of <{element}>"
                raise ModelError(line, told, "text that can be read", "delete it")
            if name.startswith("file") or name in FOLDERS:
                found.append(Reference(line, element, name, value))
    return found


def check_alone(xml: str) -> None:
    """Refuses a text that names a file.

    Raises:
        ModelError: For the first reference or DOCTYPE.
    """
    for reference in references(xml):
        raise ModelError(
            reference.line,
            str(reference),
            "a model in one file, that names no other",
            "write it out: elements, `vertex` of a mesh, `builtin` of a texture, `elevation` of a height field",
        )


def malformed(xml: str) -> ModelError | None:
    """Why the text is not well-formed XML, or None. MuJoCo's own parser accepts some that is not."""
    try:
        _parser().Parse(xml.encode("utf-8", "surrogatepass"), True)
    except expat.ExpatError as error:
        return ModelError(error.lineno, expat.errors.messages[error.code], "well-formed XML", "correct the model")
    return None


def probe(xml: str) -> None:
    """Compiles a text, and makes one step, in a process of its own.

    Raises:
        ValueError: With what MuJoCo says of it.
        ModelError: If that process is ended, or needs more than SECONDS of the processor or MEMORY bytes.
    """
    said, code = _asked(xml)
    if code:
        how = f"takes more than {SECONDS} s" if code in LATE else f"ends the process, with exit code {code}"
        raise ModelError(1, f"a model that {how}", "one that MuJoCo compiles and steps", "remove half of the model")
    if said:
        raise ValueError(said)


def _asked(xml: str) -> tuple[str, int]:
    """What is said of a text, and the exit code of the process that tried it."""
    answer = KEEPER.ask(json.dumps([xml, SECONDS]))
    said, code = json.loads(answer) if answer else ("", -signal.SIGKILL)
    return said, code


def _keeper() -> subprocess.Popen[str]:
    """The process that compiles."""
    return subprocess.Popen(
        [sys.executable, "-m", "clinic.engine.mjcf"],
        cwd=tempfile.gettempdir(),
        env={**os.environ, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )


KEEPER = Keeper(_keeper)


def _serve() -> None:
    """Answers each line, a text as JSON, with what was said of it and the exit code of the process that tried it."""
    import mujoco  # noqa: F401

    for line in sys.stdin:
        reader, writer = os.pipe()
        if (pid := os.fork()) == 0:
            os.write(writer, _tried(*json.loads(line)).encode("utf-8", "replace")[:PIPE])
            os._exit(0)
        os.close(writer)
        code = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
        with os.fdopen(reader, "rb") as pipe:
            print(json.dumps([pipe.read().decode("utf-8", "replace"), code]), flush=True)


def _tried(xml: str, seconds: int) -> str:
    """What the engine says of a text; empty when it steps."""
    import mujoco

    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    for kind, limit in ((resource.RLIMIT_DATA, MEMORY), (resource.RLIMIT_CPU, seconds), (resource.RLIMIT_CORE, 0)):
        resource.setrlimit(kind, (limit, limit))
    mujoco.set_mju_user_warning(lambda _: None)
    try:
        model = mujoco.MjModel.from_xml_string(xml)
        mujoco.mj_step(model, mujoco.MjData(model))
    except Exception as error:
        return str(error) or type(error).__name__
    return ""


def _parser() -> expat.XMLParserType:
    made = expat.ParserCreate("utf-8")

    def refuse(*_: object) -> None:
        line = made.CurrentLineNumber
        raise ModelError(line, "a DOCTYPE", "elements and their attributes", "remove it, and write its entities out")

    made.StartDoctypeDeclHandler = refuse
    return made


def _elements(xml: str) -> Iterator[tuple[int, str, dict[str, str]]]:
    found: list[tuple[int, str, dict[str, str]]] = []
    parser = _parser()
    parser.StartElementHandler = lambda name, attributes: found.append((parser.CurrentLineNumber, name, attributes))
    with suppress(expat.ExpatError):
        parser.Parse(xml.encode("utf-8", "surrogatepass"), True)
    yield from found


if __name__ == "__main__":
    _serve()
