"""The parts that a record and its sweeps share: names, edits, and a number taken from a signal."""

from __future__ import annotations

from typing import Annotated, Literal

import mujoco
from pydantic import BaseModel, ConfigDict, Field, model_validator

Identifier = Annotated[str, Field(pattern=r"^[a-z][a-z0-9]*(?:-[a-z0-9]+)*$")]
Name = Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]*$")]
VISIBLE = r"[^\s\u200b-\u200f\u2060\ufeff]"
Text = Annotated[str, Field(min_length=1, pattern=VISIBLE)]
Interval = tuple[float, float]
WARNINGS = [name.removeprefix("mjWARN_") for name in mujoco.mjtWarning.__members__ if name.startswith("mjWARN_")]
Take = Literal["final", "first", "min", "max", "mean", "span", "onset"]


class Strict(BaseModel):
    """A mapping in which an unknown key is an error."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)


class Edit(Strict):
    """Text to replace; the text must occur exactly once in the model or script."""

    find: Text = Field(description="The text to replace, exactly as it stands in the file, once.")
    replace: str = Field(description="What to write in its place; empty deletes it.")

    @model_validator(mode="after")
    def _changes(self) -> Edit:
        if self.find == self.replace:
            raise ValueError("the edit changes nothing||a `replace` that differs from `find`||write the repaired text")
        return self


class Taken(Strict):
    """One number taken from a signal."""

    signal: Name = Field(description="The name of a signal of this record.")
    take: Take = Field(
        default="final",
        description="Which number of the trace: its `final`, `first`, `min`, `max` or `mean` value, its "
        "`span` (max - min), or its `onset`: the time in s at which it first differs from zero.",
    )
    window: Interval | None = Field(default=None, description="Only samples with t0 <= time <= t1, in s.")
