"""Two builds of the same files give the same bytes, wherever, whenever and by whomever they are made."""

from __future__ import annotations

from pathlib import Path

import pytest
from project import bytes_of, run, write_project

pytestmark = pytest.mark.xdist_group("kill")
HERE = {"TZ": "UTC", "LC_ALL": "C.UTF-8", "PYTHONHASHSEED": "0", "CLINIC_JOBS": "1", "UMASK": "022"}
THERE = {"TZ": "Asia/Tokyo", "LC_ALL": "C", "PYTHONHASHSEED": "7", "CLINIC_JOBS": "2", "UMASK": "077"}
BUILD = """
import os, sys
from datetime import datetime, timedelta
os.umask(int(os.environ["UMASK"], 8))
if os.environ["CLINIC_JOBS"] == "2":  # another day
    from mkdocs import utils
    real = utils.get_build_datetime
    utils.get_build_datetime = lambda: real() + timedelta(days=400 if "SOURCE_DATE_EPOCH" not in os.environ else 0)
from mkdocs.__main__ import cli
cli(["build", "--strict"])
"""
RC = "font.size: 20\nlines.linewidth: 5\nsvg.fonttype: none\nsavefig.dpi: 30\npath.simplify: False\n"


def built(folder: Path, environment: dict[str, str]) -> dict[str, str]:
    done = run(folder, "-c", BUILD, **environment)
    assert done.returncode == 0, done.stderr
    return bytes_of(folder / "site")


def test_two_builds_are_equal_to_the_last_byte(tmp_path: Path) -> None:
    one = write_project(tmp_path / "one")
    other = write_project(tmp_path / "some where" / "ünder another name")
    home = tmp_path / "home" / ".config" / "matplotlib"
    home.mkdir(parents=True)
    (home / "matplotlibrc").write_text(RC, encoding="utf-8")
    (other / "matplotlibrc").write_text(RC, encoding="utf-8")

    first = built(one, {**HERE, "SITE_URL": "https://example.org/clinic/"})
    second = built(other, {**THERE, "SITE_URL": "https://example.org/clinic/", "HOME": str(tmp_path / "home")})

    assert {name for name in first | second if first.get(name) != second.get(name)} == set()
    assert {"cases/falling-box/film.mp4", "sitemap.xml.gz", "javascripts/search/index.js"} <= first.keys()
    assert not list(tmp_path.rglob("MUJOCO_LOG.TXT"))
    told = str(tmp_path).encode()
    assert not [path for path in (other / "site").rglob("*") if path.is_file() and told in path.read_bytes()]
