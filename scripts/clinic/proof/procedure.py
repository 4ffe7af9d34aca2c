"""A family's procedure: a program that takes a model's path and says which of the family's causes it has, if any.

It is made from the records of the family's cases; the build runs it on every model of the family, broken and repaired.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Sequence

from clinic.engine.script import run_script
from clinic.engine.variant import variants
from clinic.record.case import Case
from clinic.record.families import families
from clinic.record.parts import Strict
from clinic.record.problem import Problem

NONE = "no row applies"
HEAD = '''\
"""{title}: which cause is it? python which.py model.xml"""
import sys
import mujoco
import numpy as np
spec = mujoco.MjSpec.from_file(sys.argv[1])
model = spec.compile()
data = mujoco.MjData(model)
if model.nkey:
    mujoco.mj_resetDataKeyframe(model, data, 0)
mujoco.mj_forward(model, data)
'''
MEASUREMENT = """\
{probe}
rows = [  # the case, its cause, what is measured, its unit, of what, the sign of its bound, the bound
{rows}
]
told = []
for case, cause, values, unit, kind, sign, bound in rows:
    values = sign * np.atleast_1d(values).astype(float)
    if np.isnan(values).all():
        continue
    k = np.nanargmax(values)
    element = model.joint(model.dof_jntid[k]) if kind == "dof" else getattr(model, kind)(k) if kind else None
    print(f"{{case}} = {{sign * values[k] + 0:.4g}} {{unit}}".rstrip() \
+ (f", {{kind}} {{element.name}}" if element else ""))
    told += [f"it is {{case}}: {{cause}}"] * bool(values[k] > sign * bound)
print(*told or ["it is none of these: {none}"], sep=", and ")
"""
DRIVER = """
import contextlib, io, json, pathlib, runpy, sys
said = {}
for path in sorted(pathlib.Path(".").glob("*.xml")):
    sys.argv = ["which.py", str(path)]
    with contextlib.redirect_stdout(io.StringIO()) as out:
        runpy.run_path("which.py")
    said[path.stem] = out.getvalue()
print(json.dumps(said))
"""
LINE = re.compile(r"^(?P<case>[a-z0-9-]+) = (?P<value>[^\s,]+)", re.MULTILINE)
TOLD = re.compile(r"(?:^|, and )it is ([a-z0-9-]+): ", re.MULTILINE)


class Answer(Strict):
    """What the procedure says of one model.

    Attributes:
        values: What each row measured, by case; none where a model has nothing to measure.
        told: The cases whose rows apply.
        printed: The text.
    """

    values: dict[str, float]
    told: list[str]
    printed: str


class Differential(Strict):
    """What tells a family's causes apart, and that it does.

    Attributes:
        code: The procedure; empty where no measurement on a model tells.
        answers: What it says of every model of `asked`.
    """

    code: str
    answers: dict[str, Answer]


def members(family: str, cases: Iterable[Case]) -> list[Case]:
    """The cases of a family, and those of others that tell in it too, likeliest first."""
    own = [
        case
        for case in cases
        if family in (case.record.family, *(tells.also if (tells := case.record.telling) else ()))
    ]
    return sorted(own, key=lambda case: (-(case.record.telling.threads if case.record.telling else 0), *case.rank))


def measured(cases: Iterable[Case]) -> list[Case]:
    """Those of which a measurement on a model tells."""
    return [case for case in cases if case.record.telling is not None and case.record.telling.expr is not None]


def procedure(family: str, cases: Iterable[Case]) -> str:
    """The program of a family, over the measurements of these of its cases."""
    return HEAD.format(title=families()[family].title) + measurement(family, cases)


def measurement(family: str, cases: Iterable[Case]) -> str:
    """What the program does once it has `model`, and `data` at its start; it needs `mujoco` and `np` besides."""
    own, rows = measured(cases), []
    for case in own:
        telling = case.record.telling
        assert telling is not None
        sign, bound = (1, telling.above) if telling.above is not None else (-1, telling.below)
        name, kind = json.dumps(telling.cause or case.record.title, ensure_ascii=False), telling.of or ""
        rows.append(f'    ("{case.slug}", {name}, {telling.expr}, "{telling.unit}", "{kind}", {sign}, {bound}),')
    probes = dict.fromkeys(
        families()[each].probe.strip() for each in (family, *(case.record.family or family for case in own))
    )
    return MEASUREMENT.format(probe="\n".join(filter(None, probes)), rows="\n".join(rows), none=NONE)


def asked(cases: Iterable[Case]) -> dict[str, str]:
    """The models that a procedure is asked about, by `case` for the broken one and `case--fix` for a repaired one."""
    return {
        case.slug if variant.kind == "broken" else f"{case.slug}--{variant.id}": variant.text
        for case in measured(cases)
        for variant in variants(case)
        if variant.kind != "refuted"
    }


def run_procedure(code: str, models: dict[str, str]) -> dict[str, Answer]:
    """What a procedure says of each of the models, given as text.

    Raises:
        ScriptError: If it does not run.
    """
    files = {f"{name}.xml": text for name, text in models.items()} | {"which.py": code}
    return {name: read(printed) for name, printed in json.loads(run_script(DRIVER, files, "driver.py")).items()}


def read(printed: str) -> Answer:
    """What a procedure printed."""
    values = {match["case"]: float(match["value"]) for match in LINE.finditer(printed)}
    return Answer(values=values, told=TOLD.findall(printed), printed=printed)


def procedure_problems(cases: Sequence[Case], said: dict[str, Answer]) -> Iterator[Problem]:
    """Law 8: a row applies to its own case's broken model, to no other of the family, and not after its repairs."""
    by_slug = {case.slug: case for case in cases}
    for name, answer in said.items():
        slug, _, fix = name.partition("--")
        own = by_slug[slug]
        for case in measured(cases):
            telling = case.record.telling
            assert telling is not None
            applies, wanted = case.slug in answer.told, case is own and not fix
            if case is own and fix in telling.still:
                wanted = True
                if not applies:
                    repair = "remove it"
                    yield case.problem(("telling", "still", fix), "a fix after which it does not hold", "one", repair)
                    continue
            if applies != wanted:
                state = "holds" if applies else "does not hold"
                value = f"{answer.values[case.slug]:.4g}" if case.slug in answer.values else "nothing measured"
                found = f"{state} for {slug}{f' repaired by {fix}' if fix else ''} ({value})"
                expected = "a measurement that holds for its own broken model alone"
                repair = "correct its `expr` or bound, or say in `still` why it holds after a repair"
                yield case.problem(("telling",), found, expected, repair)
