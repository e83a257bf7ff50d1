"""A one-page report of the Explore view: self-contained HTML, made to be printed."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

from ..lessons.markdown import plain
from ..results.growth import shows_growth
from ..state import SYMBOLS, State
from ..words.si import key_numbers, load_in, named_inputs, shown_scales

__all__ = ["page_address", "report_html"]

_STYLE = """
@page { size: A4; margin: 11mm 14mm; }
body { font: 8.5pt/1.3 system-ui, "Noto Sans", "DejaVu Sans", sans-serif; color: #18202b;
  max-width: 182mm; margin: 8mm auto; }
h1 { font-size: 13pt; margin: 0 0 1mm; } h2 { font-size: 10pt; margin: 2mm 0 0.5mm; }
p { margin: 0 0 1mm; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums;
  font-size: 8pt; line-height: 1.2; }
td { border-bottom: 0.2mm solid #d5dce4; padding: 0.25mm 2mm 0.25mm 0; }
.two { display: grid; grid-template-columns: 1fr 1fr; gap: 0 8mm; }
.three { display: grid; grid-template-columns: 1fr 1fr 1.1fr; gap: 0 6mm; align-items: start; }
.across { grid-column: span 2; }
svg { display: block; width: 100%; height: auto; margin: auto; }
.wide svg { max-height: 68mm; } .two svg { max-height: 52mm; }
footer { color: #4e5a69; font-size: 7.5pt; line-height: 1.2; margin-top: 2mm;
  overflow-wrap: anywhere; }
a { color: inherit; }
sub { font-size: 0.75em; line-height: 0; } .symbol { font-style: italic; white-space: nowrap; }
@media print { body { margin: 0; } }
"""
_NUMBERS = {
    "buckling": "static buckling load p̄_cr",
    "flutter": "flutter load, follower, at this spin",
    "static_load": "static load p̄₀",
    "fundamental": "natural frequency at rest ω_n",
}
_LEFT_OUT = ("marker", "show_", "growth_unit", "stiffness", "initial", "seed", "periods")


def _table(rows: Sequence[tuple[str, str]]) -> str:
    cells = "".join(f"<tr><td>{plain(a)}</td><td>{plain(b)}</td></tr>" for a, b in rows)
    return f"<table>{cells}</table>"


def _label(name: str) -> str:
    field, _, unit = name.partition(" ")
    return f"{State.param[field].label} {SYMBOLS.get(field, '')} {unit}".strip()


def _shown(value: Any) -> str:
    if value is None:
        return "none"
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def page_address(given: object) -> str:
    """Return the page's own address as the browser gave it, or nothing where it is none."""
    form = r"https?://(?:[\w.-]{1,253}|\[[\da-fA-F:]{2,45}\])(?::\d{1,5})?(?:/[\w./~%-]{0,300})?"
    return given if isinstance(given, str) and re.fullmatch(form, given, re.ASCII) else ""


def report_html(
    state: State,
    numbers: Mapping[str, Any],
    words: Sequence[str],
    pictures: Mapping[str, str],
    query: str,
    address: str = "",
) -> str:
    """Return the report.

    Parameters
    ----------
    state : State
    numbers : mapping
        Key numbers of the view.
    words : sequence of str
        The verdict, and what else is said, a paragraph each.
    pictures : mapping of str to str
        SVG documents by title, the first one wide.
    query : str
        The view's address query.
    address : str
        The page's address without a query, from `page_address`.
    """
    settings = [
        (_label(name), _shown(value))
        for name, value in named_inputs(state.inputs()).items()
        if not name.startswith(_LEFT_OUT)
    ]
    scales = shown_scales(state)
    si = scales is not None
    shown = numbers if scales is None else key_numbers(scales, numbers)
    suffix = ("", "") if scales is None else (f" [{load_in(scales)[1]}]", " [Hz]")
    keys = [
        (words_.replace("\u0304", "") + suffix[name == "fundamental"], _shown(shown[name]))
        if si
        else (words_, _shown(shown[name]))
        for name, words_ in _NUMBERS.items()
    ]
    for name, (real, imaginary) in shown["whirl"].items():
        grows = f" {imaginary:+.6g}j" if shows_growth(imaginary) else ""
        if si and grows:
            word = "decays" if imaginary > 0 else "grows"
            grows = f", {word} by {abs(imaginary):.6g} 1/s"
        keys.append((f"whirl frequency {name}{suffix[1]}", f"{real:.6g}{grows}"))
    drawn = [
        f"<h2>{escape(title)}</h2>{svg[svg.index('<svg') :]}" for title, svg in pictures.items()
    ]
    half = "".join(f"<div>{one}</div>" for one in drawn[1:])
    units = (
        f"In SI for a shaft of {state.shaft_length:g} m, {state.shaft_diameter:g} mm; parameters "
        "without a unit are non-dimensional"
        if si
        else "Non-dimensional"
    )
    half_way = -(-len(settings) // 2)
    view = escape(f"{address}?{query}")
    if address:
        view = f'<a href="{view}">{view}</a>'
    return f"""<!DOCTYPE html>
<html lang="en">
<head><meta charset="utf-8"><title>rotorstab report</title><style>{_STYLE}</style></head>
<body>
<h1>Parametric instability of a shaft–disk rotor</h1>
{"".join(f"<p>{plain(one)}</p>" for one in words)}
<div class="wide">{drawn[0]}</div>
<div class="two">{half}</div>
<div class="three">
<h2 class="across">Parameters</h2><h2>Key numbers</h2>
{_table(settings[:half_way])}{_table(settings[half_way:])}{_table(keys)}
</div>
<footer>{units}: length L, bending stiffness EI and line mass ρA are 1. Floquet decides
what is unstable; a Bolotin region is a first approximation. Made with rotorstab; this view:
{view}</footer>
</body></html>
"""
