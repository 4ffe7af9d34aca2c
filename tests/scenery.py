"""Parts of models that several tests put together."""

from __future__ import annotations

BOX = '<body name="box" pos="0 0 {z}"><freejoint/><geom name="box" type="box" size="0.05 0.05 0.05"{more}/></body>'
FLOOR = '<geom name="floor" type="plane" size="5 5 0.1"/>'
ARM = '<joint axis="0 1 0" damping="1"/><geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.04"/>'
