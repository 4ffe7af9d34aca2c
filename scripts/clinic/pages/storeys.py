"""The picture of the package on the page *Work on the code*: its folders in order, their modules and their imports."""

from __future__ import annotations

import importlib
import textwrap
from collections import Counter
from collections.abc import Iterator, Sequence
from functools import lru_cache
from html import escape

import grimp

BOX, LANE, ROW = 246, 20, 16  # px
LETTERS = 36  # of a line of modules
FONT, BOLD = 'font-family="sans-serif" font-size="12"', 'font-weight="bold"'
LINE = 'fill="none" stroke="currentColor"'


@lru_cache
def storeys(package: str, folders: tuple[str, ...]) -> str:
    """A package's folders as an SVG of currentColor, and below it what each is for, as Markdown.

    An arrow leads to each folder from those that import it, and a number on it says how many imports these are.

    Args:
        package: The package's name; it is imported.
        folders: Its folders, the first imported by the others.
    """
    graph = grimp.build_graph(package, cache_dir=None)
    modules = sorted(graph.modules - {package})
    imports = Counter(
        (_folder(module), _folder(imported))
        for module in modules
        for imported in graph.find_modules_directly_imported_by(module)
    )
    rows = {folder: _lines(package, folder, modules) for folder in folders}
    said = {
        folder: (importlib.import_module(f"{package}.{folder}").__doc__ or "").split("\n\n")[0] for folder in folders
    }
    meanings = [f"- `{folder}`: {' '.join(text.split())}" for folder, text in said.items()]
    return "\n".join([*_picture(rows, imports), "", *meanings])


def _folder(module: str) -> str:
    """The storey of a module: `record` of `clinic.record.case`."""
    return f"{module}.".split(".")[1]


def _lines(package: str, folder: str, modules: Sequence[str]) -> list[str]:
    """The names of a folder's modules, then of what is in each room in it, in lines of LETTERS."""
    inside = [name.split(".")[2:] for name in modules if name.startswith(f"{package}.{folder}.")]
    rooms = sorted({parts[0] for parts in inside if len(parts) > 1})
    own = ", ".join(parts[0] for parts in inside if len(parts) == 1 and parts[0] not in rooms)
    inner = {room: list(dict.fromkeys(p[1] for p in inside if p[0] == room and len(p) > 1)) for room in rooms}
    texts = [own, *(f"{room}: {', '.join(names)}" for room, names in inner.items())]
    return [line for text in texts for line in textwrap.wrap(text, LETTERS)]


def _picture(rows: dict[str, list[str]], imports: Counter[tuple[str, str]]) -> Iterator[str]:
    """The SVG: a box a folder; in the lanes to the right, the arrow to each folder."""
    folders, tops, y = list(rows), {}, 4
    for folder, lines in rows.items():
        tops[folder], y = y, y + ROW * (len(lines) + 2)
    wide = BOX + LANE * len(folders)
    said = f"The storeys {', '.join(folders)}: each imports only from those before it."
    yield f'<div class="storeys"><svg viewBox="0 0 {wide} {y}" width="100%" role="img" aria-label="{said}" {FONT}>'
    for folder, lines in rows.items():
        yield f'<rect x="1" y="{tops[folder]}" width="{BOX}" height="{ROW * (len(lines) + 1) + 8}" rx="4" {LINE}/>'
        for k, line in enumerate([folder, *lines], start=1):
            yield _words(8, tops[folder] + ROW * k, line, BOLD if k == 1 else "")
    for lane, folder in enumerate(reversed(folders[:-1]), start=1):
        users = [user for user in folders if user != folder and imports[user, folder]]
        x, at, last = BOX + LANE * lane - 8, tops[folder] + ROW - 4, tops[(users or [folder])[-1]] + ROW - 4
        yield f'<path d="M{BOX + 2} {at}l8 -4v8z" fill="currentColor"/>'
        yield f'<path d="M{BOX + 8} {at}H{x}V{last}" stroke-opacity="0.5" {LINE}/>'
        yield from (_words(x + 2, tops[user] + ROW, str(imports[user, folder])) for user in users)
    yield "</svg></div>"


def _words(x: float, y: float, text: str, style: str = "") -> str:
    return f'<text x="{x}" y="{y}" fill="currentColor" {style}>{escape(text)}</text>'
