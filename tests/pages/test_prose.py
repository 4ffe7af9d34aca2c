"""Prose: numbers from the evidence, formulas as MathML."""

from __future__ import annotations

import math

import pytest
from clinic.pages.text.markup import code, fence, line
from clinic.pages.text.prose import ProseError, fill, markdown, mistakes, resolve
from clinic.proof.evidence import Evidence
from clinic.proof.sweep import Agreement, Point, SweepEvidence
from clinic.record.prose import number, quantity, rounded_up
from helpers import evidence_of_variants, variant_evidence

BROKEN = variant_evidence(
    height_m=[0.0, 0.5, 0.04991],
    angle_rad=[0.0, math.pi / 6],
    share_=[0.25],
    period_s=[0.0125],
    force_N=[None],
).model_copy(update={"messages": ["WARNING: it exploded.", "again"]})
EVIDENCE = evidence_of_variants(
    broken=BROKEN,
    no_gravity=variant_evidence("fix", height_m=[2.0]),
    script=variant_evidence("fix", error_=[1.0]).model_copy(update={"timestep": None, "steps": None}),
)
SPACE = "\u00a0"


@pytest.fixture
def evidence() -> Evidence:
    return EVIDENCE


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [
        pytest.param(0, 3, "0", id="zero"),
        pytest.param(-0.0, 3, "0", id="minus-zero"),
        pytest.param(4, 3, "4", id="whole"),
        pytest.param(12345, 3, "12345", id="whole-numbers-are-not-rounded"),
        pytest.param(-19.123, 3, "−19.1", id="negative"),
        pytest.param(0.0498922, 3, "0.0499", id="small"),
        pytest.param(0.0498922, 5, "0.049892", id="more-digits"),
        pytest.param(1.5, 3, "1.50", id="zeros-are-significant"),
        pytest.param(1234.5, 3, "1234", id="more-places-than-digits"),
        pytest.param(9.996, 3, "10.0", id="rounds-up-to-another-place"),
        pytest.param(0.9996, 3, "1.00", id="rounds-up-to-one"),
        pytest.param(0.00099, 3, f"9.90{SPACE}×{SPACE}10⁻⁴", id="tiny"),
        pytest.param(-1.234e-10, 2, f"−1.2{SPACE}×{SPACE}10⁻¹⁰", id="tinier"),
        pytest.param(123456.7, 3, f"1.23{SPACE}×{SPACE}10⁵", id="huge"),
        pytest.param(2e5, 3, f"2.00{SPACE}×{SPACE}10⁵", id="huge-and-whole"),
    ],
)
def test_number(value: float, digits: int, text: str) -> None:
    assert number(value, digits) == text


@pytest.mark.parametrize(
    ("unit", "text"),
    [
        pytest.param("", "1.50", id="pure-number"),
        pytest.param("m", f"1.50{SPACE}m", id="unit-does-not-wrap"),
        pytest.param("N m", f"1.50{SPACE}N{SPACE}m", id="nor-does-a-product"),
        pytest.param("°", "1.50°", id="degrees"),
    ],
)
def test_quantity(unit: str, text: str) -> None:
    assert quantity(1.5, unit) == text


@pytest.mark.parametrize(
    ("field", "text"),
    [
        pytest.param("broken.height.final", f"0.0499{SPACE}m", id="number"),
        pytest.param(" broken.height.final|mm ", f"49.9{SPACE}mm", id="converted"),
        pytest.param("broken.height.final | mm | 2", f"50{SPACE}mm", id="converted-with-two-digits"),
        pytest.param("broken.height.max | cm", f"50{SPACE}cm", id="cm"),
        pytest.param("broken.angle.final | deg", "30.0°", id="deg"),
        pytest.param("broken.period.final | ms", f"12.5{SPACE}ms", id="ms"),
        pytest.param("broken.share.final | percent", f"25{SPACE}%", id="percent"),
        pytest.param("broken.height.onset", f"2{SPACE}s", id="onset-is-a-time"),
        pytest.param("broken.height.onset | ms", f"2000{SPACE}ms", id="onset-in-ms"),
        pytest.param("broken.timestep", f"1{SPACE}s", id="timestep"),
        pytest.param("broken.duration", f"3{SPACE}s", id="duration"),
        pytest.param("no-gravity.height.final", f"2{SPACE}m", id="another-variant"),
        pytest.param("broken.warning", "WARNING: it exploded.", id="warning"),
        pytest.param("engine", "4.0.0", id="engine"),
    ],
)
def test_field(evidence: Evidence, field: str, text: str) -> None:
    assert resolve(field, evidence) == text


@pytest.mark.parametrize(
    ("field", "found", "repair"),
    [
        pytest.param(
            "brokn.height.final", "{{ brokn.height.final }}: brokn is no variant", "write broken", id="variant"
        ),
        pytest.param("broken.hight.final", "{{ broken.hight.final }}: hight is no signal", "write height", id="signal"),
        pytest.param("broken.height.finl", "{{ broken.height.finl }}: finl is no take", "write final", id="take"),
        pytest.param("broken.height", "{{ broken.height }}: nothing is no take", "correct the field", id="no-take"),
        pytest.param("", "{{  }}: nothing is no variant", "correct the field", id="nothing"),
        pytest.param(
            "broken.height.final | deg",
            "the filter deg on broken.height.final in m",
            "change the filter",
            id="filter-of-another-unit",
        ),
        pytest.param(
            "broken.share.final | kilo",
            "the filter kilo on broken.share.final in no unit",
            "change the filter",
            id="unknown-filter",
        ),
        pytest.param(
            "broken.height.final | 0",
            "the filter 0 on broken.height.final in m",
            "change the filter",
            id="no-digits",
        ),
        pytest.param(
            "broken.force.final",
            "{{ broken.force.final }}",
            "name something else, or remove the field",
            id="what-was-not-measured",
        ),
        pytest.param(
            "no-gravity.warning",
            "{{ no-gravity.warning }}",
            "name something else, or remove the field",
            id="no-warning",
        ),
        pytest.param(
            "script.timestep",
            "{{ script.timestep }}: timestep is no signal",
            "correct the field",
            id="timestep-of-a-script",
        ),
    ],
)
def test_field_that_resolves_to_nothing(evidence: Evidence, field: str, found: str, repair: str) -> None:
    with pytest.raises(ProseError) as caught:
        resolve(field, evidence)
    assert (caught.value.found, caught.value.repair) == (found, repair)


def test_fill_replaces_every_field_and_nothing_else(evidence: Evidence) -> None:
    text = "From {{ broken.height.max }} to `{{broken.height.final|mm}}`, in {one} go."
    assert fill(text, evidence) == f"From 0.500{SPACE}m to `49.9{SPACE}mm`, in {{one}} go."


def test_mistakes_are_told_all(evidence: Evidence) -> None:
    text = "{{ a.b.c }} {{ broken.height.max }} $\\frac{$ {{ broken.b.c }} `$\\frac{$` {{ broken.height.max }"
    assert [error.found for error in mistakes(text, evidence)] == [
        "{{ a.b.c }}: a is no variant",
        "{{ broken.b.c }}: b is no signal",
        "{{ broken.height.max }",
        "$\\frac{$: NoAvailableTokensError",
    ]


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        pytest.param("a <b>c</b>", "a &lt;b>c&lt;/b>", id="tags"),
        pytest.param("`<geom/>` and <geom/>", "`<geom/>` and &lt;geom/>", id="code"),
        pytest.param("```xml\n<geom/>\n```\n<x>", "```xml\n<geom/>\n```\n&lt;x>", id="fences"),
        pytest.param("``a ` <b>`` <c>", "``a ` <b>`` &lt;c>", id="double-ticks"),
        pytest.param("It costs $5 and $6.", "It costs $5 and $6.", id="money"),
        pytest.param("`$x$`", "`$x$`", id="formula-in-code"),
        pytest.param(r"\$x\$ here", r"\$x\$ here", id="escaped"),
    ],
)
def test_markdown(evidence: Evidence, text: str, shown: str) -> None:
    assert markdown(text, evidence) == shown


@pytest.mark.parametrize(
    ("text", "display", "tokens"),
    [
        pytest.param("$x$", "inline", ["<mi>x</mi>"], id="inline"),
        pytest.param("so $a < b$.", "inline", ["<mi>a</mi>", "<mo>&#x0003C;</mo>", "<mi>b</mi>"], id="less-than"),
        pytest.param("$$\n\\frac{a}{2}\n$$", "block", ["<mfrac>", "<mn>2</mn>"], id="block"),
        pytest.param("$x_1$, $x_2$", "inline", ["<msub>"], id="two"),
    ],
)
def test_formula(evidence: Evidence, text: str, display: str, tokens: list[str]) -> None:
    made = markdown(text, evidence)
    assert "$" not in made
    assert f'display="{display}"' in made
    assert [token for token in tokens if token not in made] == []


def test_block_formula_stands_in_a_paragraph_of_its_own(evidence: Evidence) -> None:
    made = markdown("before $$x$$ after", evidence)
    assert made.startswith('before \n\n<div class="formula"><math')
    assert made.endswith("</math></div>\n\n after")


def test_a_formula_holds_nothing_that_markdown_reads(evidence: Evidence) -> None:
    assert not set("[]{}|\\`*_") & set(markdown(r"$\text{a_b*c} \{ x_1 \}$", evidence))


@pytest.mark.parametrize(
    ("act", "shown"),
    [
        pytest.param(code("qpos[3]\n<b>"), "<code>qpos&#91;3&#93; &#60;b></code>", id="code"),
        pytest.param(
            line("a [b] *c* | `d`\n e\u00a0f"), "a &#91;b&#93; &#42;c&#42; &#124; &#96;d&#96;  e\u00a0f", id="line"
        ),
        pytest.param(fence("a\n```\nb\n", "diff"), "````diff\na\n```\nb\n````", id="fence"),
    ],
)
def test_text_to_the_letter(act: str, shown: str) -> None:
    assert act == shown


@pytest.mark.parametrize(
    ("value", "digits", "bound"),
    [
        (0.1276, 1, 0.2),
        (0.1276, 2, 0.13),
        (0.7212, 2, 0.73),
        (5.000000000074e-4, 1, 5e-4),
        (1e-7, 1, 1e-7),
        (0.0, 1, 0.0),
    ],
)
def test_a_bound_is_rounded_up(value: float, digits: int, bound: float) -> None:
    assert rounded_up(value, digits) == pytest.approx(bound, rel=1e-9)


@pytest.mark.parametrize(
    ("worst", "outcome", "unit", "shown"),
    [
        pytest.param(2e-16, 0.4, "", "1%s×%s10⁻⁹", id="a-share"),
        pytest.param(2e-16, 50.0, "rad", "1%s×%s10⁻⁷%srad", id="of-what-is-measured"),
        pytest.param(0.0, 50.0, "rad", "0%srad", id="none"),
        pytest.param(0.0012, 50.0, "rad", "0.002%srad", id="more-than-rounding"),
    ],
)
def test_how_a_machine_rounds_is_not_told(worst: float, outcome: float, unit: str, shown: str) -> None:
    agreement = Agreement(judged=1, wrong=0, worst=worst, good_from=None, unit=unit)
    point = Point(at={"x": 1.0}, outcome=outcome, holds=None, predicted={"prediction": outcome})
    swept = SweepEvidence(points=[point], agreement={"prediction": agreement}, marks={})
    assert fill("{{ sweep.s.worst | 1 }}", EVIDENCE.model_copy(update={"sweep": {"s": swept}})) == shown.replace(
        "%s", SPACE
    )
