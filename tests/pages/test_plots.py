"""Figures: read back from the SVG."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from itertools import pairwise
from pathlib import Path

import pytest
from clinic.pages.figures.palette import BROKEN, FIXED, GRID, INK
from clinic.pages.figures.plots import plots
from clinic.proof.evidence import Evidence, VariantEvidence
from clinic.proof.sweep import Point, summarise
from clinic.record.case import Case
from helpers import evidence_of_variants, script_case, tiny_case, variant_evidence

RAMP = [0.0, 0.1, 0.2, 0.3]


@pytest.fixture(scope="module")
def case(tmp_path_factory: pytest.TempPathFactory) -> Case:
    return tiny_case(tmp_path_factory.mktemp("plots"))


def heights(broken: list[float | None], *fixes: list[float | None]) -> Evidence:
    made: dict[str, VariantEvidence] = {"broken": variant_evidence(height_m=broken)}
    made |= {f"fix_{k}": variant_evidence("fix", height_m=fix) for k, fix in enumerate(fixes, 1)}
    return evidence_of_variants(**made)


def drawn(case: Case, evidence: Evidence) -> str:
    return plots(case, evidence)["plot.svg"].decode()


def texts(svg: str) -> list[str]:
    """What the figure says; glyphs are drawn as paths, with the text in a comment."""
    return re.findall(r"<!-- (.*?) -->", svg)


def curves(svg: str) -> list[tuple[str, list[tuple[float, float]]]]:
    """The dash and the points of every curve that is clipped to the axes, grid lines left out."""
    found = []
    for path in ET.fromstring(svg).iter("{http://www.w3.org/2000/svg}path"):
        style = path.get("style", "")
        if path.get("clip-path") and "stroke-width: 1.8" in style:
            dash = re.search(r"stroke-dasharray: ([^;]*)", style)
            numbers = [float(x) for x in re.findall(r"-?[\d.]+", path.get("d", ""))]
            found.append((dash[1] if dash else "", list(zip(numbers[::2], numbers[1::2], strict=True))))
    return found


def test_every_colour_of_a_figure_has_another_on_a_dark_page(case: Case) -> None:
    svg = drawn(case, heights(RAMP, RAMP[::-1]))
    rules, styles = svg.partition("</style>")[0], "".join(re.findall(r'style="([^"]*)"', svg.partition("</style>")[2]))
    assert {INK, GRID, BROKEN, FIXED[0]} <= set(re.findall("#[0-9a-f]{6}", styles))
    for colour in re.findall(r"(?:fill|stroke): #[0-9a-f]{6}", styles):
        assert f'[style*="{colour}"]' in rules


def test_the_same_evidence_gives_the_same_bytes(case: Case) -> None:
    first, second = (plots(case, heights(RAMP, RAMP[::-1])) for _ in range(2))
    assert first == second
    assert set(first) == {"plot.svg"}


def test_nothing_is_loaded_from_elsewhere_and_no_date_is_written(case: Case) -> None:
    svg = drawn(case, heights(RAMP, RAMP))
    assert re.findall(r'href="(?!#)[^"]*"', svg) == []
    assert "<dc:date>" not in svg


def test_axes_and_curves_are_named_and_curves_differ_by_their_dash(case: Case) -> None:
    svg = drawn(case, heights(RAMP, RAMP, RAMP, RAMP, RAMP))
    assert {"time [s]", "height of the box [m]", "broken", "fix-1", "fix-4"} <= set(texts(svg))
    dashes = [dash for dash, _ in curves(svg)]
    assert dashes[0] == ""
    assert len(set(dashes)) == 5


def test_refuted_remedies_are_not_drawn(case: Case) -> None:
    evidence = evidence_of_variants(
        broken=variant_evidence(height_m=RAMP), slower=variant_evidence("refuted", height_m=RAMP)
    )
    assert "slower" not in texts(drawn(case, evidence))


def test_points_are_where_the_samples_are(case: Case) -> None:
    ((_, rising), (_, falling)) = curves(drawn(case, heights(RAMP, RAMP[::-1])))
    steps = [after - before for (before, _), (after, _) in pairwise(rising)]
    assert steps == pytest.approx([steps[0]] * 3, abs=1e-4)
    assert [y for _, y in rising] == pytest.approx([y for _, y in falling[::-1]], abs=1e-4)
    assert rising[0][1] > rising[-1][1], "SVG counts downwards"


def test_a_hole_in_the_samples_is_a_gap(case: Case) -> None:
    svg = drawn(case, heights([0.0, 0.1, None, 0.3, 0.4], RAMP))
    assert [len(points) for _, points in curves(svg)] == [4, 4]
    assert "nan" not in svg.lower()


def test_an_explosion_does_not_flatten_the_others(case: Case) -> None:
    svg = drawn(case, heights([0.0, 0.1, 0.5, 1e6], RAMP))
    _, (_, fix) = curves(svg)
    assert fix[0][1] - fix[-1][1] > 3, "on a linear axis it would be a ten-thousandth"
    said = texts(svg)
    assert {"0", "1", "1\u00a0×\u00a010⁶"} <= set(said)
    assert "$" not in "".join(said)


def swept_texts(tmp_path: Path, *values: float) -> list[str]:
    """What the figure of a logarithmic sweep with these outcomes says."""
    vary = f"{{name: x, find: '0.5', replace: '{{}}', values: {list(values)}, scale: log}}"
    sweep = f"sweep:\n  size:\n    title: t\n    text: t\n    vary: [{vary}]\n    outcome: {{signal: error}}\n"
    sweep += "    prediction: {label: x, expr: x, within: 0.01}\n"
    case = script_case(tmp_path, ("no_sweep: There is nothing to vary.\n", sweep))
    points = [Point(at={"x": x}, outcome=x, holds=None, predicted={"prediction": x}) for x in values]
    evidence = evidence_of_variants(broken=variant_evidence(error_m=[0.5]))
    evidence = evidence.model_copy(update={"sweep": {"size": summarise(case, case.record.sweep["size"], points)}})
    return texts(plots(case, evidence)["sweep-size.svg"].decode())


def test_numbers_at_the_axes_of_a_sweep_are_plain(tmp_path: Path) -> None:
    said = swept_texts(tmp_path, 1.0, 10.0, 100.0)
    assert said.count("1") == said.count("10") == said.count("100") == 2, "at either axis"
    assert "$" not in "".join(said)


def test_an_axis_over_many_decades_names_powers_of_ten_alone(tmp_path: Path) -> None:
    few, many = swept_texts(tmp_path / "few", 1.0, 100.0), swept_texts(tmp_path / "many", 1.0, 1e6)
    assert "2" in few
    assert "2" not in many
    assert "100" in many


def test_what_is_merely_larger_leaves_the_axis_linear(case: Case) -> None:
    (_, broken), _ = curves(drawn(case, heights([0.0, 1.0, 3.0, 10.0], RAMP)))
    heights_drawn = [broken[0][1] - y for _, y in broken]
    assert heights_drawn == pytest.approx([heights_drawn[-1] * x for x in (0, 0.1, 0.3, 1)], abs=1e-4)


def test_what_never_changes_is_shown_as_its_final_values(case: Case) -> None:
    svg = drawn(case, heights([0.25, 0.25], [0.5, 0.5], [None, None]))
    said = texts(svg)
    assert curves(svg) == []
    assert {"broken", "fix-1", "fix-2", "0.250\u00a0m", "0.500\u00a0m", "height of the box [m]"} <= set(said)
    assert any("not measured" in text for text in said)
    assert "time [s]" not in said


def test_samples_of_a_script_are_its_printed_values(case: Case) -> None:
    evidence = heights(RAMP, RAMP)
    variants = {key: v.model_copy(update={"timestep": None, "steps": None}) for key, v in evidence.variants.items()}
    said = texts(drawn(case, evidence.model_copy(update={"variants": variants})))
    assert "printed values, in turn" in said
    assert not [text for text in said if text.endswith(".5")], "there is no value between two values"
