"""What `clinic diagnose` prints, and the file that it writes."""

from __future__ import annotations

import json
import os
import shutil
import sys
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path

from clinic.commands.diagnosis_options import STDIN, OptionError
from clinic.commands.github import workflow_command, workflow_commands
from clinic.commands.sarif import sarif
from clinic.diagnosis.finding import Diagnosis
from clinic.diagnosis.texts import encoded

EXISTS = "--fix {}: it exists; name a new file, or add --force"


def check_output(models: Sequence[str], form: str, fix: str | None, force: bool) -> None:
    """Whether there is a model, and what is asked for can be made of it.

    Raises:
        OptionError: If not.
    """
    if not models or not all(models):  # an empty one is a variable of the shell that is not set
        taken = f"; {fix} is what --fix writes: clinic diagnose {fix} --fix" if fix else ": clinic diagnose robot.xml"
        raise OptionError(f"no model is named{taken}")
    for asked, wanted in ((form == "json", "--format json"), (bool(fix), f"--fix {fix}")):
        if asked and len(models) > 1:
            raise OptionError(f"{wanted} takes one model, not {len(models)}")
    if force and not fix:
        raise OptionError("--force goes with --fix OUT")
    if fix and Path(fix).exists() and not force:
        raise OptionError(EXISTS.format(fix))


def write_fix(model: str, made: Diagnosis, out: Path, force: bool) -> None:
    """Writes the mended model, with its line ends and its encoding; nothing where there is nothing to mend.

    Raises:
        OptionError: If other files would have to change as well, or it cannot be written; what was there is there.
    """
    others = [file for file, text in made.texts.items() if made.fixed[file] != text and file != made.file]
    if others:
        raise OptionError(
            f"--fix {out}: the edits change {', '.join(others)}, which it includes; --fix prints the diff"
        )
    if not made.diff():
        return
    content = Path(model).read_bytes() if model != STDIN else made.texts[made.file].encode()
    try:
        _write(out, encoded(made.fixed[made.file], content), force)
    except FileExistsError:
        raise OptionError(EXISTS.format(out)) from None
    except OSError as error:
        raise OptionError(f"--fix {out}: {error.strerror or error}") from None


def _write(out: Path, content: bytes, force: bool) -> None:
    """Writes all of a file or nothing: a new one, or, where forced, in the place of one that is there."""
    if force and out.exists() and not out.is_file():  # /dev/stdout
        out.write_bytes(content)
        return
    out = out.resolve()
    part = out.with_name(f"{out.name}.{os.getpid()}.part") if force else out
    part.touch(exist_ok=False)
    try:
        part.write_bytes(content)
        if out.exists():
            shutil.copymode(out, part)
        part.replace(out)
    except BaseException:
        part.unlink()
        raise


def say(text: str) -> None:
    """Prints.

    Raises:
        OptionError: If standard output takes no more.
    """
    try:
        print(text, flush=True)
    except BrokenPipeError:
        raise
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # or Python tries again when it ends
        raise OptionError(f"standard output: {error.strerror or error}") from None


def printed(
    made: Sequence[tuple[str, Diagnosis]], failed: Sequence[tuple[str, str]], form: str, diff: bool, every: bool
) -> str:
    """What is printed of diagnoses, by their models, and of what could not be diagnosed, and why."""
    found = [("" if model == STDIN else str(Path(model).parent), each) for model, each in made]
    if form == "json":
        return "".join(json.dumps(each.data(), indent=1, ensure_ascii=False, allow_nan=False) for _, each in made)
    if form == "sarif":
        return json.dumps(
            sarif(found, [said for _, said in failed], version("mujoco-clinic")), indent=1, ensure_ascii=False
        )
    if form == "github":
        wrong = [workflow_command("error", model, 1, "cannot be run", said) for model, said in failed]
        return "\n".join([line for folder, each in found for line in workflow_commands(folder, each)] + wrong)
    if diff:
        diffs = "".join(each.diff() for _, each in made).removesuffix("\n")
        return diffs or "\n".join(dict.fromkeys(_nothing_to_change(*each) for each in made))
    several = len(made) + len(failed) > 1
    return "\n\n".join((f"{model}\n" if several else "") + each.text(every) for model, each in made)


def _nothing_to_change(model: str, made: Diagnosis) -> str:
    """Why there is no diff: what a hint's edit would do is told, and it is left to the reader."""
    hints = dict.fromkeys(each.rule for each in made.hints if each.edit and each.after is not None)
    if made.causes or not hints:
        return "nothing to change"
    have = "the hints {} have edits" if len(hints) > 1 else "the hint {} has an edit"
    return f"No cause, so nothing is changed; {have.format(', '.join(hints))}: clinic diagnose {model}"
