"""Healthy models: all MJCF files of `requirements-healthy.txt`'s packages that compile and can move."""

from __future__ import annotations

import hashlib
import json
import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import mujoco

from clinic.record.problem import MissingRequirementError
from clinic.work.cache import Cache, key_of

FOLDER = Path(".cache/healthy")  # of the checkout; `make healthy` fills it
PACKAGES = ("dm_control", "gymnasium", "gymnasium_robotics")
FURTHER = "CLINIC_HEALTHY"  # names further folders of models, as PATH does
SHARED = ("", "assets", "suite", "test_assets")  # folders that hold models of several robots
PUCK = "the puck weighs 1.3e-8 kg; pusher_v5.xml makes it 1,000 times as dense for that"
GYRATION = "b_2 weighs 11.7 g with a radius of gyration of 1.47 m, and its geom is 0.53 m long"
FEET = "the right foot has friction 0.9 and the left 1.9; walker2d_v5.xml gives both 1.9"
FLY = "fruitfly.xml, made from it, excludes rostrum and both halves of labrum, which overlap here and push"
KNOWN = {  # true faults of these models, which are no false alarms: by model and rule, with the reason
    "dm_control/mujoco/testing/assets/arm.xml": {"inertia-unlike-geoms": GYRATION},
    "dm_control/locomotion/walkers/assets/build_fruitfly/assets/drosophila_fused.xml": {"overlap-of-relatives": FLY},
    "gymnasium/envs/mujoco/assets/pusher.xml": {"lighter-than-air": PUCK},
    "gymnasium/envs/mujoco/assets/walker2d.xml": {"twin-place-differs": FEET},
    "gymnasium_robotics/envs/mujoco/assets/pusher.xml": {"lighter-than-air": PUCK},
    "gymnasium_robotics/envs/mujoco/assets/walker2d.xml": {"twin-place-differs": FEET},
}


@dataclass(frozen=True)
class Healthy:
    """A model of other people that compiles and can move.

    Attributes:
        name: Where it lies in its package: `dm_control/suite/cartpole.xml`.
        path: The file.
        dofs: Its degrees of freedom.
    """

    name: str
    path: str
    dofs: int

    @property
    def robot(self) -> str:
        """What the models of one robot have in common: their folder's name, or the first word of their own."""
        *_, folder, file = ("", *self.name.split("/"))
        return re.split(r"[_.\d]", file.removeprefix("coupled_") if folder in SHARED else folder)[0]

    @property
    def held_out(self) -> bool:
        """Whether it is never looked at while a rule is made: a third of the robots, chosen by a hash of the name."""
        return int(hashlib.sha256(self.robot.encode()).hexdigest(), 16) % 3 == 0

    @property
    def known(self) -> dict[str, str]:
        """The faults that it is known to have after all: the rule that should name each, and the reason."""
        return KNOWN.get(self.name, {})


def survey(root: Path, cache: Cache) -> tuple[list[Healthy], dict[str, str]]:
    """The healthy models, and the reason for each file that is left out.

    Args:
        root: The checkout.
        cache: Where it is kept which of them compile.

    Raises:
        MissingRequirementError: If the packages are not there.
    """
    if not (root / FOLDER / ".ready").is_file():
        raise MissingRequirementError(f"the healthy models are not in {FOLDER}: make healthy")
    files = dict(sorted(_files(root)))
    seen = [[name, path.stat().st_size] for name, path in files.items()]
    kept = cache.remember(key_of("survey", seen, of="engine"), lambda: {"models": json.dumps(_sorted(files)).encode()})
    found = json.loads(kept["models"])
    return [Healthy(name, str(files[name]), dofs) for name, dofs in found["healthy"].items()], found["left out"]


def _files(root: Path) -> Iterator[tuple[str, Path]]:
    folders = {package: root.absolute() / FOLDER / package for package in PACKAGES}
    folders |= {
        Path(name).name: Path(name).absolute() for name in filter(None, os.environ.get(FURTHER, "").split(os.pathsep))
    }
    for package, folder in folders.items():
        for path in folder.rglob("*"):
            if path.suffix in (".xml", ".urdf"):
                yield f"{package}/{path.relative_to(folder).as_posix()}", path


def _sorted(files: dict[str, Path]) -> dict[str, dict[str, object]]:
    mujoco.set_mju_user_warning(lambda _: None)
    healthy: dict[str, object] = {}
    left_out: dict[str, object] = {}
    for name, path in files.items():
        try:
            dofs = mujoco.MjModel.from_xml_path(str(path)).nv
        except ValueError as error:
            left_out[name] = str(error).splitlines()[0].replace(f"{path.parent}/", "")
            continue
        if dofs:
            healthy[name] = dofs
        else:
            left_out[name] = "nothing in it can move"
    return {"healthy": healthy, "left out": left_out}
