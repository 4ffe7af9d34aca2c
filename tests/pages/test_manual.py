"""Links into the manual of the installed version."""

from __future__ import annotations

from pathlib import Path

import mujoco
import pytest
from clinic.pages.text.manual import address, anchors, manual_problems, title
from clinic.record.case import load_case
from helpers import tiny_case

PHRASES = "phrases: [box falls through floor]"


def problems(folder: Path, pages: str) -> list[str]:
    case = tiny_case(folder, (PHRASES, f"{PHRASES}\nmanual: [{pages}]"))
    return [f"{problem.where}: {problem.found}; {problem.repair}" for problem in manual_problems(case)]


def test_addresses_are_those_of_the_installed_version() -> None:
    assert address("XMLreference.html") == f"https://mujoco.readthedocs.io/en/{mujoco.__version__}/XMLreference.html"


@pytest.mark.parametrize(
    ("page", "expected"),
    [
        ("XMLreference.html#body-geom-contype", "XML Reference: contype"),
        ("XMLreference.html#body-quat", "XML Reference: quat"),
        ("XMLreference.html#body-geom-solimp", "XML Reference: solimp"),
        ("XMLreference.html#body-camera", "XML Reference: body/camera"),
        ("modeling.html#corientation", "Modeling: Frame orientations"),
        ("modeling.html#frame-orientations", "Modeling: Frame orientations"),
        ("computation/index.html", "Computation"),
    ],
)
def test_a_link_says_where_it_leads(page: str, expected: str) -> None:
    assert title(page) == expected


def test_pages_and_anchors_that_do_not_exist_are_problems(tmp_path: Path) -> None:
    assert anchors("nothing.html") == {}
    assert problems(tmp_path / "good", "XMLreference.html#body-geom-contype, modeling.html") == []
    assert problems(tmp_path / "bad", "XMLreference.html#body-geom-contypes, nothing.html") == [
        "manual[0]: #body-geom-contypes, which XMLreference.html does not have; "
        "write XMLreference.html#body-geom-contype",
        "manual[1]: nothing.html, which is not there; correct the page",
    ]


def test_every_link_of_the_clinic_leads_somewhere(slug: str, root: Path) -> None:
    assert list(manual_problems(load_case(root / "cases" / slug))) == []
