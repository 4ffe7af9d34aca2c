"""What a diagnosis asks of a physics engine, and nothing more, so that rules run on any binding of MuJoCo.

Arrays are flat sequences of numbers in the order of MuJoCo's own fields: row i of a field with three columns is
`field[3 * i : 3 * i + 3]`. Units are the model's own, SI where the model keeps to it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple, Protocol

FREE, BALL, SLIDE, HINGE = range(4)  # mjtJoint
PLANE, HFIELD, SPHERE, CAPSULE, ELLIPSOID, CYLINDER, BOX, MESH, SDF = range(9)  # mjtGeom
TRN_IN_PARENT, TRN_TENDON, TRN_SITE, TRN_BODY = 1, 3, 4, 5  # mjtTrn
GAIN_FIXED, GAIN_MUSCLE = 0, 2  # mjtGain
BIAS_NONE, BIAS_AFFINE = 0, 1  # mjtBias
DYN_INTEGRATOR, DYN_FILTER, DYN_FILTEREXACT, DYN_MUSCLE = range(1, 5)  # mjtDyn
OBJ_SITE, OBJ_TENDON = 6, 18  # mjtObj
WRAP_JOINT = 1  # mjtWrap
SENS_TOUCH, SENS_FORCE, SENS_TORQUE, SENS_RANGEFINDER, SENS_JOINTPOS, SENS_ACTUATORFRC = 0, 4, 5, 7, 9, 15  # mjtSensor
CAM_FIXED, CAM_TRACK, CAM_TRACKCOM = range(3)  # mjtCamLight
EULER, RK4, IMPLICIT, IMPLICITFAST = range(4)  # mjtIntegrator
PYRAMIDAL, ELLIPTIC = range(2)  # mjtCone
CONSTRAINTS_OFF, CONTACTS_OFF, SPRINGS_OFF, GRAVITY_OFF = 1 << 0, 1 << 4, 1 << 5, 1 << 7  # mjtDisableBit
ACTUATORS_OFF, REFSAFE_OFF, EULERDAMP_OFF = 1 << 11, 1 << 12, 1 << 15
OVERRIDE_ON, ENERGY_ON = 1 << 0, 1 << 1  # mjtEnableBit
DEFAULT_TIMESTEP = 0.002  # s


class CompileError(ValueError):
    """A text that the engine does not compile, in the engine's own words."""


class Contact(NamedTuple):
    """One contact: ids of its geoms, distance in m (negative inside), position in m, normal, normal force in N."""

    geoms: tuple[int, int]
    distance: float
    position: tuple[float, float, float]
    normal: tuple[float, float, float]
    force: float


class Compiled(Protocol):
    """A compiled model with one state of it."""

    def count(self, kind: str) -> int:
        """How many there are of `body`, `joint`, `dof`, `geom`, `site`, `camera`, `actuator`, `sensor`, `key`, ..."""

    def name(self, kind: str, index: int) -> str:
        """An element's name; empty for an unnamed one."""

    def model(self, field: str) -> Sequence[float]:
        """A field of mjModel, such as `jnt_range`; `opt.timestep` and `stat.extent` too."""

    def data(self, field: str) -> Sequence[float]:
        """A field of mjData, such as `qpos`."""

    def write(self, field: str, values: Sequence[float], start: int = 0) -> None:
        """Writes numbers into a field of mjData, from index `start` on."""

    def write_model(self, field: str, values: Sequence[float], start: int = 0) -> None:
        """Writes numbers into a field of mjModel that holds no derived value: `opt.gravity`, `opt.disableflags`."""

    def reset(self, key: int = -1) -> None:
        """Back to the start, or to a keyframe; clears the warnings."""

    def forward(self) -> None:
        """Computes what follows from the state, without a step."""

    def step(self, count: int = 1) -> None:
        """Steps `count` times."""

    def contacts(self) -> list[Contact]:
        """The contacts of the last step or forward."""

    def mass_diagonal(self) -> list[float]:
        """The diagonal of the mass matrix, a number for each degree of freedom, in kg or kg m2."""

    def warnings(self) -> dict[str, int]:
        """How often MuJoCo warned since the reset, by name such as `BADQACC`."""


class Engine(Protocol):
    """A release of MuJoCo."""

    version: str

    def compile(self, main: str, files: Mapping[str, str]) -> Compiled:
        """Compiles a model.

        Args:
            main: The model's text, MJCF or URDF.
            files: Texts that it includes, by path from the model's folder, in place of those on disk.

        Raises:
            CompileError: If MuJoCo does not accept it.
        """
