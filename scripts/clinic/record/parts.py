"""The parts that a record and its sweeps share: names, edits, and a number taken from a signal, compared or not."""

from __future__ import annotations

from typing import Annotated, Literal

import mujoco
from pydantic import BaseModel, ConfigDict, Field, model_validator

Identifier = Annotated[str, Field(pattern=r"^[a-z][a-z0-9]*(?:-[a-z0-9]+)*$")]
Name = Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]*$")]
Text = Annotated[str, Field(pattern=r"[^\s\u200b-\u200f\u2060\ufeff]")]
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


class Comparison(Strict):
    """A bound for a number."""

    above: float | None = Field(default=None, description="Holds when the number is greater.")
    below: float | None = Field(default=None, description="Holds when the number is smaller.")
    between: Interval | None = Field(default=None, description="Holds when low <= number <= high.")
    equals: float | None = Field(default=None, description="Holds when |number - equals| <= within.")
    within: float | None = Field(default=None, ge=0, description="The tolerance of `equals`; 0 when absent.")

    @model_validator(mode="after")
    def _one_comparison(self) -> Comparison:
        given = [name for name in ("above", "below", "between", "equals") if getattr(self, name) is not None]
        if len(given) != 1:
            found, expected = " and ".join(given) or "no comparison", "exactly one of above, below, between, equals"
            raise ValueError(f"{found}||{expected}||keep one comparison a check")
        if self.within is not None and self.equals is None:
            raise ValueError("within without equals||`within` beside `equals`||add `equals`, or remove `within`")
        for name in ("between", "window"):
            pair: Interval | None = getattr(self, name, None)
            if pair is not None and pair[0] >= pair[1]:
                raise ValueError(f"{name}: {list(pair)}||a low bound below the high bound||swap the two numbers")
        return self


class Check(Taken, Comparison):
    """One number taken from a signal, compared with a bound."""
