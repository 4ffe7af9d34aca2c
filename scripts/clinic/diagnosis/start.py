"""How a run begins and is driven."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace


class StartError(ValueError):
    """A start that a model does not have, in a sentence."""


@dataclass(frozen=True)
class Start:
    """How a run begins and is driven.

    Attributes:
        key: A keyframe; -1 for the model's own start.
        ctrl: Controls by actuator, in place of the keyframe's.
        series: Controls by time in s, increasing, each from its time on.
        duration: How long the model is let go, in s.
        seed: Of the poses in which loads are measured.
        keyframe: A keyframe by its name, or its number, in place of `key`.
    """

    key: int = -1
    ctrl: Mapping[str, float] = field(default_factory=dict)
    series: Sequence[tuple[float, Mapping[str, float]]] = ()
    duration: float = 2.0
    seed: int = 0
    keyframe: str = ""

    def resolved(self, keys: Sequence[str], actuators: Sequence[str]) -> Start:
        """The same with its keyframe's number, for a model with such keyframes and actuators.

        Raises:
            StartError: If the model lacks one of them.
        """
        named, key = self.keyframe, self.key
        if named:
            key = keys.index(named) if named in keys else int(named) if named.isdecimal() else len(keys)
        if key >= len(keys):
            having = ", ".join(name or str(number) for number, name in enumerate(keys)) or "no keyframe"
            raise StartError(f"keyframe {named or key}: the model has {having}")
        for name in (name for controls in (self.ctrl, *(row for _, row in self.series)) for name in controls):
            if not name or name not in actuators:
                having = ", ".join(filter(None, actuators)) or "no actuator with a name"
                raise StartError(f"control {name}: the model has {having}")
        return replace(self, key=key, keyframe="")
