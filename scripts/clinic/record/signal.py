"""The signals of a record: where each of its numbers comes from."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag

from clinic.record.parts import Check, Interval, Strict, Text


class Described(Strict):
    """What every signal has besides its source."""

    unit: str = Field(default="", description="Unit as it is printed: m, rad, N, N m, s; empty for a pure number.")
    label: str = Field(default="", description="What a plot's axis and the table call it; the name when absent.")
    said: list[Text] = Field(default=[], description="Further words by which prose speaks of it; see Prose.")


class PathSignal(Described):
    """A number read from MuJoCo after every step, or printed by a script."""

    path: Text = Field(description="A path into MuJoCo's named access; see *Signal paths*.")


class ExpressionSignal(Described):
    """A number computed from other signals, sample by sample."""

    expr: Text = Field(description="Arithmetic over names of path signals: `2 * friction * squeeze`.")


class StartsSignal(Described):
    """The share of start positions, 0 to 1, from which a check holds."""

    measure: Literal["fraction_of_starts"] = Field(description="The kind of measurement.")
    joint: Text = Field(description="The joint whose start position is varied.")
    index: int = Field(default=0, ge=0, description="Which of the joint's qpos entries is varied.")
    offset: Interval = Field(description="Offsets added to the start position, from and to, in the unit of qpos.")
    count: int = Field(ge=2, le=1000, description="How many evenly spaced offsets, both ends included.")
    holds: Check = Field(description="The check, over a path signal, asked of every start.")


class RowSignal(Described):
    """Where a geom stands in a camera's image: the mean row of its pixels, 0 the top edge, 1 the bottom."""

    measure: Literal["image_row"] = Field(description="The kind of measurement.")
    camera: Text = Field(description="The camera that renders the image.")
    geom: Text = Field(description="The geom whose visible pixels are averaged.")


SOURCES = {
    "path": "PathSignal",
    "expr": "ExpressionSignal",
    "fraction_of_starts": "StartsSignal",
    "image_row": "RowSignal",
}


def _source(value: Any) -> str | None:
    """The class of a signal, told by the field that says where its number comes from."""
    if not isinstance(value, dict):
        return type(value).__name__
    return SOURCES.get(next((key for key in ("path", "expr") if key in value), str(value.get("measure"))))


Signal = Annotated[
    Annotated[PathSignal, Tag("PathSignal")]
    | Annotated[ExpressionSignal, Tag("ExpressionSignal")]
    | Annotated[StartsSignal, Tag("StartsSignal")]
    | Annotated[RowSignal, Tag("RowSignal")],
    Discriminator(_source),
]
