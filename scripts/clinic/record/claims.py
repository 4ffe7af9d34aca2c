"""What a case's sentences claim, and what shows each: its `claims.yaml`."""

from __future__ import annotations

import json
import re

import yaml
from pydantic import Field, ValidationError, model_validator

from clinic.record.field_errors import field_problems
from clinic.record.parts import Strict, Text
from clinic.record.problem import Problem
from clinic.record.prose import FIELD
from clinic.record.yaml_lines import Lines, read_yaml, yaml_problem

CLAIMS = "claims.yaml"
END = re.compile(r"(?<=[.?!])\s+(?=[\w`*$\"“{(])")


class Claim(Strict):
    """A sentence of the prose, and what shows it: code that runs, or MuJoCo's manual."""

    says: Text = Field(description="The sentence, to the letter; the whitespace does not matter.")
    python: str | None = Field(
        default=None,
        description="Code whose `assert`s hold only if the sentence is true. It has `mujoco`, `np`, `load(variant)`, "
        "`formula(name, **symbols)`, `told(variant)`, `measured`, `text`, `output`, `printed`, `record`, `releases`.",
    )
    manual: str | None = Field(default=None, description="A page of MuJoCo's manual: `computation/index.html`.")
    quote: Text | None = Field(default=None, description="The words of that page that say so.")

    @model_validator(mode="after")
    def _shown(self) -> Claim:
        if (self.python is None) == (self.manual is None) or (self.manual is None) != (self.quote is None):
            raise ValueError("no evidence, or two||either `python`, or `manual` and `quote`||name what shows it")
        if self.python is not None and "assert" not in self.python:
            raise ValueError("code that cannot fail||an `assert` that holds only if it is true||write one")
        return self


class Claims(Strict):
    """All sentences of a case's prose, each in one of three lists."""

    claims: list[Claim] = Field(default=[], description="Sentences that are shown by code or by the manual.")
    measured: list[Text] = Field(default=[], description="Sentences that say no more than the fields in them.")
    advice: list[Text] = Field(default=[], description="Sentences that claim nothing: what to do, to look at, to ask.")

    @model_validator(mode="after")
    def _fields(self) -> Claims:
        for sentence in self.measured:
            if not FIELD.search(sentence):
                raise ValueError(f"{flat(sentence)!r} in `measured`||a sentence with a field||move it to `claims`")
        return self

    @property
    def sentences(self) -> list[str]:
        """Those of all three lists, their whitespace made one space."""
        return [flat(each) for each in (*(claim.says for claim in self.claims), *self.measured, *self.advice)]


def read_claims(file: str, text: str) -> tuple[Claims | None, Lines | None, list[Problem]]:
    """The claims in a file's text with its lines, or what is wrong with it."""
    try:
        data, lines = read_yaml(text)
        return Claims.model_validate_json(json.dumps(data, default=str)), lines, []
    except (yaml.MarkedYAMLError, yaml.reader.ReaderError) as error:
        return None, None, [yaml_problem(file, text, error)]
    except ValidationError as error:
        return None, None, list(field_problems(file, lines, error.errors(), data))


def flat(text: str) -> str:
    """The text with each run of whitespace made one space."""
    return " ".join(text.split())


def sentences(prose: str) -> list[str]:
    """The sentences of a field of prose, flat, in order; a formula on lines of its own is inside of one."""
    return END.split(flat(prose))
