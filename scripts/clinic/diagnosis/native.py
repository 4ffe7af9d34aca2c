"""The engine of this process: MuJoCo's Python binding."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from functools import partial
from typing import Any
from weakref import WeakSet

import mujoco
import numpy as np

from clinic.diagnosis.engine import CompileError, Contact
from clinic.diagnosis.texts import read_file
from clinic.engine.releases import mass_matrix

OBJECTS = {"joint": "njnt", "camera": "ncam", "equality": "neq", "actuator": "nu", "dof": "nv", "sensor": "nsensor"}
MAIN, UNOPENED = "clinic-main.xml", "opening file"


class NativeModel:
    """A compiled model with one `mjData`: `load` compiles it, and again where it was dropped for want of memory."""

    def __init__(self, load: Callable[[], mujoco.MjModel], others: WeakSet[NativeModel] | None = None) -> None:
        self.load, self.others, self.out_of_memory = load, others if others is not None else WeakSet(), False
        self._live: tuple[mujoco.MjModel, mujoco.MjData] | None = None
        self._used()
        self.others.add(self)

    @property
    def mj(self) -> mujoco.MjModel:
        return self._used()[0]

    @property
    def mjdata(self) -> mujoco.MjData:
        return self._used()[1]

    def _used(self) -> tuple[mujoco.MjModel, mujoco.MjData]:
        if self._live is None:
            try:
                self._live = self._made()
            except (MemoryError, mujoco.FatalError, ValueError) as error:
                if not isinstance(error, MemoryError) and "allocate" not in str(error):
                    raise
                for each in [*self.others]:
                    each.drop()
                self._live = self._made()
        return self._live

    def _made(self) -> tuple[mujoco.MjModel, mujoco.MjData]:
        model = self.load()
        return model, mujoco.MjData(model)

    def drop(self) -> None:
        """Gives its memory back, and its state with it."""
        self._live = None

    def count(self, kind: str) -> int:
        return int(getattr(self.mj, OBJECTS.get(kind, f"n{kind}")))

    def name(self, kind: str, index: int) -> str:
        return mujoco.mj_id2name(self.mj, getattr(mujoco.mjtObj, f"mjOBJ_{kind.upper()}"), index) or ""

    def model(self, field: str) -> Sequence[float]:
        return _numbers(_field(self.mj, field))

    def data(self, field: str) -> Sequence[float]:
        return _numbers(_field(self.mjdata, field))

    def write(self, field: str, values: Sequence[float], start: int = 0) -> None:
        _write(self.mjdata, field, values, start)

    def write_model(self, field: str, values: Sequence[float], start: int = 0) -> None:
        _write(self.mj, field, values, start)

    def reset(self, key: int = -1) -> None:
        self.out_of_memory = False
        if key >= 0:
            mujoco.mj_resetDataKeyframe(self.mj, self.mjdata, key)
        else:
            mujoco.mj_resetData(self.mj, self.mjdata)

    def forward(self) -> None:
        with self._bounded():
            mujoco.mj_forward(self.mj, self.mjdata)

    def step(self, count: int = 1) -> None:
        with self._bounded():
            mujoco.mj_step(self.mj, self.mjdata, nstep=count)

    @contextmanager
    def _bounded(self) -> Iterator[None]:
        """Where MuJoCo's memory does not hold what a step needs, the run is over, and ends in a warning."""
        try:
            yield
        except mujoco.FatalError:
            self.out_of_memory = True

    def contacts(self) -> list[Contact]:
        made, force = [], np.zeros(6)
        for index, contact in enumerate(self.mjdata.contact):
            mujoco.mj_contactForce(self.mj, self.mjdata, index, force)
            position, normal = contact.pos.tolist(), contact.frame[:3].tolist()
            pair = (int(contact.geom[0]), int(contact.geom[1]))
            made.append(Contact(pair, float(contact.dist), tuple(position), tuple(normal), float(force[0])))
        return made

    def mass_diagonal(self) -> list[float]:
        return [float(number) for number in np.diagonal(mass_matrix(self.mj, self.mjdata))]

    def warnings(self) -> dict[str, int]:
        counts = {
            kind: int(self.mjdata.warning[int(kind)].number)
            for kind in mujoco.mjtWarning.__members__.values()
            if int(kind) < len(self.mjdata.warning)
        }
        over = {"CNSTRFULL": 1, "BADQACC": 1} if self.out_of_memory else {}
        return over | {kind.name.removeprefix("mjWARN_"): count for kind, count in counts.items() if count}


class NativeEngine:
    """The MuJoCo that is installed. Files are found among `assets`, and as from the current folder."""

    version = mujoco.__version__

    def __init__(self, assets: Mapping[str, bytes] | None = None) -> None:
        self.assets = dict(assets or {})
        self.made = WeakSet[NativeModel]()
        mujoco.set_mju_user_warning(lambda _: None)

    def compile(self, main: str, files: Mapping[str, str]) -> NativeModel:
        texts = {name: text.encode() for name, text in files.items()}
        try:
            return self._loaded(mujoco.MjModel.from_xml_string, main, texts)
        except CompileError as error:
            if UNOPENED not in str(error):
                raise
            with suppress(CompileError):
                return self._as_file(main, files)
            raise

    def _as_file(self, main: str, files: Mapping[str, str]) -> NativeModel:
        """The same by absolute paths: MuJoCo loses a `..` of what it puts together of relative folders.

        Included texts that are as on disk are read there: a given one would stand in for all files of its name.
        """
        changed = {MAIN: main} | {name: text for name, text in files.items() if text != read_file(name)}
        texts = {os.path.abspath(name): text.encode() for name, text in changed.items()}
        return self._loaded(mujoco.MjModel.from_xml_path, os.path.abspath(MAIN), texts)

    def specified(self, texts: Mapping[str, str]) -> tuple[mujoco.MjSpec, NativeModel]:
        """A model and its specification, the model's text first and as it is on disk."""
        main, *others = texts
        include = {name: texts[name].encode() for name in others}
        spec = mujoco.MjSpec.from_string(texts[main], include=include, assets=self.assets)
        try:
            return spec, NativeModel(spec.compile)
        except ValueError as error:
            if UNOPENED not in str(error):
                raise
            spec = mujoco.MjSpec.from_file(os.path.abspath(main), assets=self.assets)
            return spec, NativeModel(spec.compile)

    def _loaded(self, load: Callable[..., mujoco.MjModel], main: str, texts: dict[str, bytes]) -> NativeModel:
        try:
            return NativeModel(partial(load, main, self.assets | texts), self.made)
        except (ValueError, mujoco.FatalError) as error:
            raise CompileError(str(error)) from None
        except RuntimeError:  # an exception of C++ that the binding does not know; MuJoCo is of no use after it
            raise MemoryError("MuJoCo stops without a message, as it does where the memory does not suffice") from None


def _field(of: Any, field: str) -> Any:
    for part in field.split("."):
        of = getattr(of, part)
    return of


def _numbers(value: Any) -> Sequence[float]:
    return np.ravel(value).tolist()  # type: ignore[no-any-return]


def _write(of: Any, field: str, values: Sequence[float], start: int) -> None:
    *path, last = field.split(".")
    for part in path:
        of = getattr(of, part)
    array = getattr(of, last)
    if isinstance(array, np.ndarray):
        array.reshape(-1)[start : start + len(values)] = values
    else:
        setattr(of, last, type(array)(values[0]))
