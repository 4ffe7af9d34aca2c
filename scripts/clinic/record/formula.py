"""Formulas: LaTeX between dollar signs, set as MathML that holds nothing else."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from functools import lru_cache
from xml.etree import ElementTree

import latex2mathml.converter

from clinic.record.markup import reference
from clinic.record.prose import CODE, FORMULA

SPACE = "http://www.w3.org/1998/Math/MathML"
LONGEST = 1000  # characters; setting one takes as long as it is long, squared
ELEMENTS = re.compile(
    "math|menclose|mfenced|mfrac|mi|mmultiscripts|mn|mo|mover|mpadded|mphantom|mprescripts|mroot|mrow|mspace|msqrt|"
    "mstyle|msub|msubsup|msup|mtable|mtd|mtext|mtr|munder|munderover|none"
)
ATTRIBUTES = re.compile(
    "accent|columnalign|columnlines|columnspacing|depth|display|displaystyle|fence|form|height|linebreak|linethickness|"
    "lspace|mathbackground|mathcolor|mathsize|mathvariant|maxsize|minsize|movablelimits|notation|rowlines|rowspacing|"
    "rspace|scriptlevel|separator|stretchy|voffset|width"
)
VALUE = re.compile(r"[\w.#% +-]*", re.ASCII)
ENTITY = re.compile(r"&(?:#\d+|#x[0-9A-Fa-f]+|[a-z]+);")


class FormulaError(ValueError):
    """A formula that cannot be set."""

    def __init__(self, source: str, reason: str) -> None:
        self.found, self.expected = f"${source}$: {reason}", "a LaTeX formula"
        self.repair = "correct it; in text write \\lt for < and a formula's braces in pairs"
        super().__init__(source, reason)

    def __str__(self) -> str:
        return self.found


def formulas(text: str, rest: Callable[[str], str] = lambda part: part) -> str:
    """The text with `$..$` and `$$..$$` set as MathML, and `rest` applied to what stands between.

    Raises:
        FormulaError: For the first formula that cannot be set.
    """
    made, end = [], 0
    for match in FORMULA.finditer(text):
        made.append(rest(text[end : match.start()]))
        if match["block"]:
            made.append(f'\n\n<div class="formula">{mathml(match["block"], "block")}</div>\n\n')
        else:
            made.append(mathml(match["inline"], "inline"))
        end = match.end()
    return "".join([*made, rest(text[end:])])


def formula_errors(text: str) -> Iterator[FormulaError]:
    """Every formula of a Markdown text that cannot be set."""
    for match in FORMULA.finditer(CODE.sub("", text)):
        try:
            mathml(match["block"] or match["inline"], "inline")
        except FormulaError as error:
            yield error


@lru_cache(4096)
def mathml(source: str, display: str) -> str:
    """One formula.

    Raises:
        FormulaError: If it is no LaTeX, or would put something else than a formula on the page.
    """
    source = " ".join(source.split())
    if len(source) > LONGEST:
        raise FormulaError(source[:40] + " ...", f"{len(source)} characters, of {LONGEST} at most")
    try:
        made: str = latex2mathml.converter.convert(source, display=display)
        root = ElementTree.fromstring(made)
    except (Exception, RecursionError) as error:  # the converter raises many kinds
        raise FormulaError(source, str(error) or type(error).__name__) from None
    if "<!" in made or "<?" in made:  # what the parser passes over
        raise FormulaError(source, "it makes more than a formula")
    for element in root.iter():
        element.tag = element.tag.removeprefix(f"{{{SPACE}}}")
        known = ELEMENTS.fullmatch(element.tag) and all(map(ATTRIBUTES.fullmatch, element.attrib))
        if not known or not all(map(VALUE.fullmatch, element.attrib.values())):
            raise FormulaError(source, "it makes more than a formula")
    root.attrib = {"xmlns": SPACE, **root.attrib}
    read = ElementTree.tostring(root, encoding="unicode")  # as it was read, whatever was written
    return re.sub(r"(?<=>)[^<>]+(?=<)", lambda match: _text(match[0]), read)


def _text(text: str) -> str:
    """What stands between two tags, none of it Markdown; character references stay."""
    parts, end = [], 0
    for match in ENTITY.finditer(text):
        parts += [reference(text[end : match.start()]), match[0]]
        end = match.end()
    return "".join([*parts, reference(text[end:])])
