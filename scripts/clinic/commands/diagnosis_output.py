"""What `clinic diagnose` prints, and the file that it writes."""

from __future__ import annotations

import json
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path

from clinic.commands.diagnosis_options import STDIN, OptionError
from clinic.commands.github import workflow_command, workflow_commands
from clinic.commands.sarif import sarif
from clinic.diagnosis.finding import Diagnosis
from clinic.diagnosis.texts import decoded


def check_output(models: Sequence[str], form: str, fix: str | None, force: bool) -> None:
    """Whether there is a model, and what is asked for can be made of it.

    Raises:
        OptionError: If not.
    """
    if not models:
        taken = f"; {fix} is what --fix writes: clinic diagnose {fix} --fix" if fix else ": clinic diagnose robot.xml"
        raise OptionError(f"no model is named{taken}")
    for asked, wanted in ((form == "json", "--format json"), (bool(fix), f"--fix {fix}")):
        if asked and len(models) > 1:
            raise OptionError(f"{wanted} takes one model, not {len(models)}")
    if force and not fix:
        raise OptionError("--force goes with --fix OUT")
    if fix and Path(fix).exists() and not force:
        raise OptionError(f"--fix {fix}: it exists; name a new file, or add --force")


def write_fix(model: str, made: Diagnosis, out: Path) -> None:
    """Writes the mended model, with its line ends and its encoding; nothing where there is nothing to mend.

    Raises:
        OptionError: If other files would have to change as well, or it cannot be written.
    """
    others = [file for file, text in made.texts.items() if made.fixed[file] != text and file != made.file]
    if others:
        raise OptionError(
            f"--fix {out}: the edits change {', '.join(others)}, which it includes; --fix prints the diff"
        )
    if not made.diff():
        return
    content = Path(model).read_bytes() if model != STDIN else b""
    ends = "\r\n" if b"\r\n" in content else "\n"
    try:
        out.write_text(made.fixed[made.file], encoding=decoded(content)[1], newline=ends)
    except OSError as error:
        raise OptionError(f"--fix {out}: {error.strerror or error}") from None


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
        return "".join(each.diff() for _, each in made).removesuffix("\n") or "nothing to change"
    several = len(made) + len(failed) > 1
    return "\n\n".join((f"{model}\n" if several else "") + each.text(every) for model, each in made)
