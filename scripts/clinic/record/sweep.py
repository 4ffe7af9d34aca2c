"""The sweeps of a record: a parameter varied, an outcome measured, a closed form held against it."""

from __future__ import annotations

from typing import Literal

from pydantic import Field, model_validator

from clinic.record.parts import Comparison, Edit, Identifier, Interval, Name, Strict, Taken, Text


class Parameter(Strict):
    """A number of the model that a sweep varies."""

    name: Name = Field(description="How predictions call it.")
    find: Text = Field(description="The text to replace, once in the base variant's text.")
    replace: Text = Field(description="What to write in its place; `{}` stands for the number.")
    values: list[float] = Field(default=[], description="The numbers, increasing; or give start, stop and count.")
    start: float | None = Field(default=None, description="The first number.")
    stop: float | None = Field(default=None, description="The last number.")
    count: int | None = Field(default=None, ge=2, le=1000, description="How many numbers.")
    scale: Literal["linear", "log"] = Field(default="linear", description="How they are spaced and drawn.")
    unit: str = Field(default="", description="Unit as it is printed.")
    label: str = Field(default="", description="What the axis calls it; the name when absent.")
    marks: dict[Identifier, float] = Field(
        default={}, description="Where a variant stands, if its text does not show it."
    )

    @model_validator(mode="after")
    def _numbers(self) -> Parameter:
        spaced = [value is not None for value in (self.start, self.stop, self.count)]
        if bool(self.values) == all(spaced) or any(spaced) != all(spaced):
            raise ValueError("no numbers, or two kinds||`values`, or all of start, stop, count||keep one of the two")
        ends = [end for end in (self.start, self.stop, *self.values) if end is not None]
        if self.scale == "log" and min(ends) <= 0:
            raise ValueError("a logarithmic scale from or to zero or less||numbers above zero||write `scale: linear`")
        if "{}" not in self.replace:
            raise ValueError(f"{self.replace}||`{{}}` where the number goes||write `{{}}` for the number")
        return self


class Prediction(Strict):
    """A closed form for the outcome of a sweep."""

    label: Text = Field(description="What the legend calls it, in words; the formula stands beside them.")
    expr: Text = Field(
        description="Arithmetic over the parameters, the signals (their final values) and the named model numbers. "
        "For a sweep with `holds`: the value of the first parameter at which the outcome changes."
    )
    within: float = Field(
        gt=0,
        description="The agreement to reach: the largest error allowed; with `holds`, points nearer to the line than "
        "this share of it are not judged, and all others must agree.",
    )
    relative: bool = Field(default=True, description="Whether errors are a share of the prediction.")
    over: Interval | None = Field(default=None, description="Judge only where the first parameter is in this range.")


class Rival(Prediction):
    """A popular explanation, drawn as the wrong one: somewhere it must miss by more than `within`."""

    id: Identifier = Field(description="Names it in prose: `{{ sweep.ID.RIVAL.wrong }}`.")


class Sweep(Strict):
    """The cause as a law: parameters varied, an outcome measured, a prediction drawn over it."""

    title: Text = Field(description="What is varied and what is seen.")
    text: Text = Field(description="Prose under Cause; may hold `{{ sweep.ID.points }}`, `.worst`, `.wrong`, ...")
    base: Identifier = Field(default="broken", description="The variant whose text is varied.")
    edits: list[Edit] = Field(default=[], description="Applied to the base variant before the parameters are.")
    vary: list[Parameter] = Field(min_length=1, max_length=2, description="One or two parameters.")
    duration: float | None = Field(default=None, gt=0, le=60, description="In s, in place of the run's.")
    outcome: Taken = Field(description="The number measured at every point.")
    holds: Comparison | None = Field(default=None, description="Makes of the outcome a yes or no, as a check does.")
    side: Literal["below", "above"] = Field(default="below", description="With `holds`: where, of the line, it is yes.")
    apart: Text | None = Field(
        default=None,
        description="With `holds`: why no point within twice `within` of the line is judged on each side, or why a "
        "model's outcome is not taken at the end of the run.",
    )
    prediction: Prediction = Field(description="The closed form that a law holds to its word.")
    rivals: list[Rival] = Field(default=[], description="Closed forms that are popular and wrong.")
