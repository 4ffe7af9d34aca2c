"""Exhibits: everything a case's page shows that had to be run or drawn, as files; made once and cached."""

from __future__ import annotations

import io
import os
from collections.abc import Iterable

import joblib
import mujoco
from PIL import Image as Pictures

from clinic.cache import Cache, Files, key_of
from clinic.case import Case
from clinic.evidence import Evidence, collect
from clinic.plots import figures
from clinic.problem import CaseError
from clinic.render import Image, RenderError, image
from clinic.simulate import compile_model, state_at
from clinic.variant import Variant, variants

PROSE = {"number", "title", "symptom", "diagnosis", "cause", "fix", "lesson", "tags", "phrases", "see"}


def exhibits(case: Case, cache: Cache) -> Files:
    """The case's evidence.json, plots and pictures.

    Raises:
        CaseError: If the case cannot be run.
    """
    experiment = case.record.model_dump(mode="json", exclude=PROSE)
    key = key_of(case.slug, case.record.number, experiment, case.texts)
    return cache.remember(key, lambda: make(case))


def make(case: Case) -> Files:
    """Runs and draws everything anew."""
    evidence = collect(case)
    return {
        "evidence.json": (evidence.model_dump_json(exclude_none=False) + "\n").encode(),
        **figures(case, evidence),
        **pictures(case),
    }


def pictures(case: Case) -> Files:
    """The still images: `broken.webp`, and `fixed.webp` of the first fix where the model is the case's."""
    made: Files = {}
    try:
        if case.record.model is None:
            if case.record.picture.scene is not None:
                made["broken.webp"] = webp(scene_image(case))
        else:
            broken, fixed, *_ = variants(case)
            made = {"broken.webp": webp(still(case, broken)), "fixed.webp": webp(still(case, fixed))}
    except RenderError:
        return {}
    return made


def still(case: Case, variant: Variant) -> Image:
    """A variant at the picture's time, from the picture's camera."""
    record = case.record
    assert record.run is not None
    model = compile_model(variant.text)
    return image(model, state_at(model, record.run, record.picture.time), record.picture.camera)


def scene_image(case: Case) -> Image:
    """A code case's scene, in its first keyframe where it has one."""
    picture = case.record.picture
    assert picture.scene is not None
    model = compile_model(case.texts[picture.scene])
    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_forward(model, data)
    return image(model, data, picture.camera)


def webp(pixels: Image) -> bytes:
    """The image, compressed."""
    out = io.BytesIO()
    Pictures.fromarray(pixels).save(out, format="webp", quality=85, method=6)
    return out.getvalue()


def all_exhibits(cases: Iterable[Case], cache: Cache) -> dict[str, Files]:
    """The exhibits of every case, by slug; cases that are not cached are run in parallel processes.

    Raises:
        CaseError: With the problems of all cases that cannot be run.
    """
    results = joblib.Parallel(n_jobs=jobs())(joblib.delayed(_attempt)(case, cache) for case in cases)
    problems = [problem for _, _, error in results for problem in error]
    if problems:
        raise CaseError(problems)
    return {slug: files for slug, files, _ in results}


def jobs() -> int:
    """How many processes to run: CLINIC_JOBS, or one a processor."""
    return int(os.environ.get("CLINIC_JOBS", joblib.cpu_count()))


def evidence_of(files: Files) -> Evidence:
    """The evidence among a case's exhibits."""
    return Evidence.model_validate_json(files["evidence.json"])


def _attempt(case: Case, cache: Cache) -> tuple[str, Files, tuple[object, ...]]:
    try:
        return case.slug, exhibits(case, cache), ()
    except CaseError as error:
        return case.slug, {}, error.problems
