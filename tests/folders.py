"""Models in several folders, of which MuJoCo finds all files by the path and not by the text."""

from __future__ import annotations

from pathlib import Path

CORNER = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
PART = "<asset><mesh name='part' file='{}'/></asset><worldbody><geom type='mesh' mesh='part'/></worldbody>"
FOLDERS: dict[str, dict[str, str]] = {
    "a file that is not in the folder of meshes": {
        "parts/part.obj": CORNER,
        "robots/arm/part.xml": f"<mujoco>{PART.format('../../parts/part.obj')}</mujoco>",
        "robots/arm/model.xml": "<mujoco><compiler meshdir='../../parts'/><include file='part.xml'/></mujoco>",
    },
    "a file beside an included one of an included one": {
        "parts/one/part.obj": CORNER,
        "parts/part.xml": f"<mujoco>{PART.format('one/part.obj')}</mujoco>",
        "parts/scene.xml": "<mujoco><include file='part.xml'/></mujoco>",
        "robots/arm/model.xml": "<mujoco><include file='../../parts/scene.xml'/></mujoco>",
    },
}


def write_model(folder: Path, files: dict[str, str]) -> Path:
    """Writes the files into a folder; the model's path."""
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return folder / "robots/arm/model.xml"
