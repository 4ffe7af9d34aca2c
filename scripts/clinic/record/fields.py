"""The record of a case: the fields of `case.yaml`, their types and their meaning.

The descriptions below are the record's reference; `clinic reference` prints them as Markdown.
"""

from __future__ import annotations

import difflib
from typing import Annotated, Literal

from packaging.specifiers import InvalidSpecifier, SpecifierSet
from pydantic import AfterValidator, Field, model_validator

from clinic.record.families import families, likely_families
from clinic.record.parts import Check, Edit, Identifier, Interval, Name, Strict, Text
from clinic.record.signal import Signal
from clinic.record.sweep import Sweep

FileName = Annotated[str, Field(pattern=r"^[A-Za-z0-9_-]+\.(?:csv|json|mjs|py|txt|xml|yaml)$")]
WORDS = {"number", "title", "symptom", "diagnosis", "cause", "fix", "lesson", "no_sweep", "formulas"}
WORDS |= {"tags", "phrases", "family", "manual", "see", "telling", "exempt", "mentions", "loose"}
"""The fields on which no run depends."""
FILM_SECONDS = 6.0  # how long a film lasts of which the record says nothing
Element = Literal["actuator", "body", "camera", "dof", "geom", "joint", "sensor", "site", "tendon"]
Law = Literal["lasting", "steady", "typed"]


def _known_family(name: str) -> str:
    """The name itself, if a family has it."""
    if name not in families():
        near = difflib.get_close_matches(name, families(), 2, 0.6) or likely_families(name)[:3]
        repair = f"write {' or '.join(near)}" if near else "choose one"
        raise ValueError(f"{name}, which is no family||one of {', '.join(families())}||{repair}")
    return name


def _specifier(text: str) -> str:
    """The text itself, if it says which releases are meant."""
    try:
        SpecifierSet(text)
    except InvalidSpecifier:
        raise ValueError(f"{text}, which names no releases||such as <3.13 or ==3.9.*||correct it") from None
    return text


Releases = Annotated[str, AfterValidator(_specifier)]
FamilyName = Annotated[str, AfterValidator(_known_family), Field(json_schema_extra={"enum": list(families())})]
ManualPage = Annotated[str, Field(pattern=r"^[A-Za-z0-9_/]+\.html(?:#[a-z0-9-]+)?$")]


class Telling(Strict):
    """What tells a case from the others of its family: one measurement, which holds for its broken model alone."""

    cause: Text | None = Field(
        default=None, max_length=90, description="The cause in a few words; the title when absent."
    )
    says: Text = Field(description="What is measured, in words; of a code case, what to look for.")
    expr: Text | None = Field(
        default=None, description="A number, or one for each element: Python over what the family's `probe` measures."
    )
    unit: str = Field(default="", description="Its unit; empty for a pure number.")
    of: Element | None = Field(default=None, description="What kind of element each of the numbers belongs to.")
    above: float | None = Field(default=None, description="Holds where the largest number is greater.")
    below: float | None = Field(default=None, description="Holds where the smallest number is smaller.")
    also: list[FamilyName] = Field(
        default=[],
        description="Further families in which it tells; what its own family's `probe` measures is measured there too.",
    )
    still: dict[Identifier, Text] = Field(
        default={}, description="Fixes after which it holds nevertheless, each with the reason."
    )
    threads: int = Field(default=0, ge=0, description="In how many threads we met the cause: the likelier comes first.")

    @model_validator(mode="after")
    def _one_bound(self) -> Telling:
        given = sum(bound is not None for bound in (self.above, self.below))
        if given != (self.expr is not None):
            found, expected = f"{given} bounds", "one of above, below beside `expr`; none without it"
            raise ValueError(f"{found}||{expected}||keep one bound, or remove it")
        return self


class RunSpec(Strict):
    """How to start the simulation and drive it."""

    duration: float = Field(gt=0, le=120, description="Simulated time in s; the run is duration / timestep steps.")
    keyframe: str | None = Field(default=None, description="The keyframe to start from; qpos0 when absent.")
    qpos: dict[str, float] = Field(default={}, description="Start positions by joint, for joints with one qpos.")
    qvel: dict[str, float] = Field(default={}, description="Start velocities by joint, for joints with one dof.")
    ctrl: dict[str, float | list[Interval]] = Field(
        default={},
        description="Control by actuator: a constant, or [time in s, value] pairs, linear in between.",
    )


class Picture(Strict):
    """The still image of a case."""

    camera: Text | None = Field(default=None, description="The camera to render from; a view of all when absent.")
    time: float | None = Field(
        default=None, ge=0, le=120, description="When, in s of simulated time; half-way through the run when absent."
    )
    scene: FileName | None = Field(default=None, description="Code cases: the scene to render, from its keyframe 0.")
    shows: dict[Text, Text] = Field(
        default={},
        description="Code cases: joints of the scene, and the signals that say where they are; an image a sample.",
    )


Overlay = Literal[
    "contact_points", "contact_forces", "joint_axes", "body_frames", "inertia", "actuators", "transparent", "cameras"
]


class Film(Strict):
    """The film of the broken model beside the first fix: the picture's camera, same clock."""

    duration: float | None = Field(default=None, gt=0, description="Simulated time filmed, in s; the run's by default.")
    speed: float = Field(default=1.0, gt=0, le=20, description="Simulated seconds a second; below 1 is slow motion.")
    overlays: list[Overlay] = Field(default=[], description="What MuJoCo draws over the scene to show the cause.")


class Checks(Strict):
    """What `it is broken` and `it is well` mean, measured."""

    broken: list[Check] = Field(min_length=1, description="All hold for the broken variant, not for a fix.")
    fixed: list[Check] = Field(min_length=1, description="All hold for every fix; one fails for the others.")


class TrialChecks(Strict):
    """Checks whose bounds differ in a trial; the record's own where absent."""

    broken: list[Check] | None = Field(default=None, min_length=1, description="In place of the record's `broken`.")
    fixed: list[Check] | None = Field(default=None, min_length=1, description="In place of the record's `fixed`.")


class Formula(Strict):
    """An equation for the page, held against the runs."""

    says: Text = Field(description="Its sides, of symbols: `k_p * q = m * g * L / 2 * cos(q)`; `~` for nearly equal.")
    where: dict[str, Text] = Field(
        default={},
        description="What the symbols are: arithmetic over signals (their final values; `speed_max` is another take), "
        "`timestep` and `duration`; for a sweep also its parameters, `outcome`, `prediction` and its rivals.",
    )
    of: Text = Field(
        default="broken", description="Where the sides must agree: a variant, or every point of `sweep.ID`."
    )
    within: float = Field(
        default=0.01, gt=0, le=0.1, description="The largest difference, as a share of the largest side."
    )


class Trial(Strict):
    """Another situation in which every fix must hold and the broken variant be broken: a load, a start, a command."""

    id: Identifier = Field(description="Lower-case words joined by hyphens; unique among the trials.")
    title: Text = Field(max_length=90, description="What is different, as a short phrase: *Twice the load*.")
    start: dict[str, float] = Field(default={}, description="Numbers of the run's start by path: `joint(a).qpos[0]`.")
    set: dict[str, float] = Field(default={}, description="Numbers of the compiled model: `model.opt.gravity[2]`.")
    ctrl: dict[str, float | list[Interval]] = Field(default={}, description="Controls in place of the run's.")
    duration: float | None = Field(default=None, gt=0, le=120, description="Simulated time in s; the run's if absent.")
    file: FileName | None = Field(default=None, description="Code cases: the file that `edits` change; the script.")
    edits: list[Edit] = Field(default=[], description="Code cases: changes of the script, or of a file it reads.")
    checks: TrialChecks | None = Field(default=None, description="Checks whose bounds differ here.")
    contrast: bool = Field(
        default=False,
        description="Whether, by its own `checks`, the broken variant works, or a fix fails or shows what changed.",
    )

    @model_validator(mode="after")
    def _contrast_checks(self) -> Trial:
        if self.contrast and self.checks is None:
            raise ValueError("a `contrast` without `checks`||`checks` of its own||add `checks`, or remove `contrast`")
        return self


class Task(Strict):
    """What belongs to the task; a repair leaves bodies, masses, gravity and what is measured alone."""

    may: list[Text] = Field(
        default=[],
        description="What a repair of this case may change besides contacts, solver, gains and damping, as "
        "`joint(elbow).range`; a kind alone, `actuator`, allows more of that kind, and an element alone, `geom(cup)`, "
        "that it is taken away.",
    )


class Remedy(Strict):
    """A named set of edits."""

    id: Identifier = Field(description="Lower-case words joined by hyphens; unique in the record.")
    title: Text = Field(description="What the edits do, in the imperative.")
    edits: list[Edit] = Field(min_length=1, max_length=5, description="Applied to the broken text, in order.")


class Fix(Remedy):
    """A repair: makes `checks.fixed` true and `checks.broken` false."""

    redundant: str | None = Field(default=None, description="Why some of the edits alone also repair, if they do.")


class Refuted(Remedy):
    """A remedy people try, shown not to work."""

    why: Text = Field(description="Why it does not work, for the page; may hold measured numbers.")


class Record(Strict):
    """One broken simulation: what is seen, what is wrong, what repairs it, and the proof."""

    number: int | None = Field(
        default=None, ge=1, le=99_999, description="Unique; readers say *case 7*. Without one, after the others."
    )
    title: Text = Field(max_length=90, description="The symptom as a sentence, without a full stop.")
    model: FileName | None = Field(default=None, description="The broken model. Exactly one of `model`, `script`.")
    script: FileName | None = Field(default=None, description="The broken script: Python, or for Node `.mjs`.")
    files: list[FileName] = Field(default=[], description="Further files of the folder that the script reads.")
    symptom: Text = Field(description="What is seen, before anything is known. The only field shown unfolded.")
    diagnosis: Text = Field(description="What to measure, and what it says.")
    snippet: str | None = Field(default=None, description="Code run in the case's folder, shown under Diagnosis.")
    cause: Text = Field(description="Why it happens.")
    fix: Text = Field(description="How to repair it.")
    lesson: Text = Field(description="What to remember.")
    tags: list[Identifier] = Field(min_length=1, description="Topics: contact, joint, actuator, camera, units, ...")
    phrases: list[Text] = Field(min_length=1, description="What people type into a search engine; feeds the search.")
    family: FamilyName | None = Field(default=None, description="The symptom whose other causes it is told apart from.")
    manual: list[ManualPage] = Field(
        default=[], description="Pages of MuJoCo's manual, each as `modeling.html#anchor`."
    )
    see: list[Identifier] = Field(default=[], description="Related cases, by folder name.")
    telling: Telling | None = Field(default=None, description="What tells this case from others of its family.")
    exempt: dict[Law, Text] = Field(default={}, description="Laws that this case need not obey, each with the reason.")
    mentions: list[Text] = Field(
        default=[], description="Names of MuJoCo's that prose mentions and that none of the case's files has."
    )
    loose: dict[Text, Text] | None = Field(
        default=None,
        description="Why no check need notice when a number that matters is halved or doubled, by the attribute or the "
        "part of a line that holds it: `{'axis=\"0 0 1\"': reason}`; `{}` if checks notice each.",
    )
    run: RunSpec | None = Field(default=None, description="How to start and drive a model; none for a script.")
    signals: dict[Name, Signal] = Field(min_length=1, description="Named measurements; the first one is plotted.")
    checks: Checks = Field(description="The pair of predicates for every variant.")
    warnings: list[str] = Field(default=[], description="What the broken model makes MuJoCo warn of: BADQACC, ...")
    fixes: list[Fix] = Field(min_length=1, description="At least one repair; the first is the one plotted.")
    refuted: list[Refuted] = Field(default=[], description="Remedies people try that do not work.")
    trials: list[Trial] = Field(default=[], description="Other situations in which the checks are asked as well.")
    task: Task = Field(default=Task(), description="What a repair may change besides what every repair may.")
    older: dict[Releases, Text] = Field(
        default={}, description='What older releases of MuJoCo do otherwise, and why: `{"<3.13": reason}`.'
    )
    sweep: dict[Identifier, Sweep] = Field(default={}, description="Sweeps by name.")
    formulas: dict[Name, Formula] = Field(default={}, description="Equations for prose: `{{ formula.NAME }}`, by name.")
    no_sweep: str | None = Field(default=None, description="Why no sweep would tell anything; not beside `sweep`.")
    film: Film | None = Field(default=None, description="Of a model; when absent, a film of the whole run.")
    picture: Picture = Field(default=Picture(), description="The still image on the page and on the home page's card.")

    @model_validator(mode="after")
    def _model_or_script(self) -> Record:
        if (self.model is None) == (self.script is None):
            found = "both model and script" if self.model else "neither model nor script"
            raise ValueError(f"{found}||exactly one of `model`, `script`||name the file that holds the bug")
        if (self.model is None) != (self.run is None):
            found, repair = (
                ("model without run", "add `run: {duration: 1}`") if self.model else ("script with run", "remove `run`")
            )
            raise ValueError(f"{found}||`run` beside `model`, and only there||{repair}")
        if self.script is not None and not self.script.endswith((".py", ".mjs")):
            raise ValueError(f"{self.script}||a script in Python, .py, or for Node, .mjs||rename the script")
        return self

    @property
    def lacking(self) -> dict[str, str]:
        """Fields that grade A asks for and the record is without, with what is not known for want of each."""
        wanted = {
            "trials": (self.trials, "whether a repair holds in another situation"),
            "loose": (self.loose is not None, "whether a check notices when a number is halved or doubled"),
            "family": (self.family, "which other causes its symptom has"),
            "telling": (self.telling, "what tells it from them"),
            "sweep": (self.sweep or self.no_sweep, "whether the cause is a law"),
        }
        return {name: unknown for name, (given, unknown) in wanted.items() if not given}

    @property
    def heading(self) -> str:
        """The title after the number, if there is one."""
        return self.title if self.number is None else f"{self.number}. {self.title}"

    @property
    def filmed(self) -> Film | None:
        """The film to be made: the record's own, or for a model without one its whole run in FILM_SECONDS."""
        if self.run is None or self.film is not None:
            return self.film
        return Film(speed=self.run.duration / FILM_SECONDS)

    @property
    def language(self) -> Literal["python", "javascript"]:
        """The language of the script and of the snippet."""
        return "javascript" if self.source.endswith(".mjs") else "python"

    @property
    def source(self) -> str:
        """The name of the file that the edits change."""
        return self.model or self.script or ""
