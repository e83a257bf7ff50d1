"""Symbols in print: bars and indices as mathematics, all other text as it is."""

import pytest

from rotorstab.drawing.typesetting import mathtext


@pytest.mark.parametrize(
    ("text", "printed"),
    [
        ("dynamic load factor β_d", "dynamic load factor $β_{d}$"),
        ("pulsating load Pₜ [N]", "pulsating load $P_{t}$ [N]"),
        ("θ/ωₙ", "θ/$ω_{n}$"),
        ("k̄₁₂ = k̄₂₁", r"$\bar{k}_{12}$ = $\bar{k}_{21}$"),
        ("α_s = 0.5, Ω̄ = 1", r"$α_{s}$ = 0.5, $\bar{Ω}$ = 1"),
        ("0.5 p̄_cr", r"0.5 $\bar{p}_{cr}$"),
        ("σ̄T", r"$\bar{σ}$T"),
        ("my_pin at 5 $", r"my_pin at 5 \$"),
        ("β_dots", "β_dots"),
    ],
)
def test_symbols_are_typeset_and_other_text_is_kept(text, printed):
    assert mathtext(text) == printed


def test_what_is_typeset_can_be_drawn():
    from matplotlib.mathtext import MathTextParser

    text = mathtext("Ω̄ = 1, β_d = 0.1 and 0.5 p̄_cr over k̄₁₂, 5 $")
    assert MathTextParser("path").parse(text).width > 0
