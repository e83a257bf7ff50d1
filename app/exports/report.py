"""A one-page report of the Explore view: self-contained HTML, made to be printed."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

from rotorstab import Scales

from ..lessons.markdown import plain
from ..state import SI_INPUTS, SYMBOLS, State, Use, names_for
from ..words.si import key_numbers, load_in, shown_scales

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


def _table(rows: Sequence[tuple[str, str]]) -> str:
    cells = "".join(
        f"<tr><td>{plain(name)}</td><td>{plain(value)}</td></tr>" for name, value in rows
    )
    return f"<table>{cells}</table>"


def _label(name: str) -> str:
    unit = SI_INPUTS.get(name, "")
    words = State.param[name].label, SYMBOLS.get(name, ""), f"[{unit}]" if unit else ""
    return " ".join(word for word in words if word)


def _shown(value: Any) -> str:
    if value is None:
        return "none"
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def page_address(text: object) -> str:
    """Return the page's own address as the browser sent it, or an empty text if it is none."""
    form = r"https?://(?:[\w.-]{1,253}|\[[\da-fA-F:]{2,45}\])(?::\d{1,5})?(?:/[\w./~%-]{0,300})?"
    return text if isinstance(text, str) and re.fullmatch(form, text, re.ASCII) else ""


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
        The verdict and the other paragraphs.
    pictures : mapping of str to str
        SVG documents by title, the first one wide.
    query : str
        The view's address query.
    address : str
        The page's address without a query, from `page_address`.
    """
    scales = shown_scales(state)
    settings = [
        (_label(name), _shown(getattr(state, name)))
        for name in names_for(Use.REPORTED)
        if scales is not None or name not in SI_INPUTS
    ]
    half_way = -(-len(settings) // 2)
    charts = [
        f"<h2>{escape(title)}</h2>{svg[svg.index('<svg') :]}" for title, svg in pictures.items()
    ]
    half_wide = "".join(f"<div>{chart}</div>" for chart in charts[1:])
    return f"""<!DOCTYPE html>
<html lang="en">
<head><meta charset="utf-8"><title>rotorstab report</title><style>{_STYLE}</style></head>
<body>
<h1>Parametric instability of a shaft–disk rotor</h1>
{"".join(f"<p>{plain(paragraph)}</p>" for paragraph in words)}
<div class="wide">{charts[0]}</div>
<div class="two">{half_wide}</div>
<div class="three">
<h2 class="across">Parameters</h2><h2>Key numbers</h2>
{_table(settings[:half_way])}{_table(settings[half_way:])}{_table(_key_rows(numbers, scales))}
</div>
<footer>{_units_words(state)}: length L, bending stiffness EI and line mass ρA are 1. Floquet
decides what is unstable; a Bolotin region is a first approximation. Made with rotorstab; this view:
{_link(address, query)}</footer>
</body></html>
"""


def _key_rows(numbers: Mapping[str, Any], scales: Scales | None) -> list[tuple[str, str]]:
    """Return names and values of the key numbers, in SI with scales."""
    if scales is None:
        rows = [(label, _shown(numbers[name])) for name, label in _NUMBERS.items()]
        shown, hertz = numbers, ""
    else:
        shown, hertz = key_numbers(scales, numbers), " [Hz]"
        newtons = f" [{load_in(scales)[1]}]"
        rows = [
            (
                # without the bar of the non-dimensional
                label.replace("\u0304", "") + (hertz if name == "fundamental" else newtons),
                _shown(shown[name]),
            )
            for name, label in _NUMBERS.items()
        ]
    for name, (real, imaginary) in shown["whirl"].items():
        growth = ""
        if imaginary and scales is None:
            growth = f" {imaginary:+.6g}j"
        elif imaginary:
            word = "decays" if imaginary > 0 else "grows"
            growth = f", {word} by {abs(imaginary):.6g} 1/s"
        rows.append((f"whirl frequency {name}{hertz}", f"{real:.6g}{growth}"))
    return rows


def _units_words(state: State) -> str:
    if shown_scales(state) is None:
        return "Non-dimensional"
    return (
        f"In SI for a shaft of {state.shaft_length:g} m, {state.shaft_diameter:g} mm; parameters "
        "without a unit are non-dimensional"
    )


def _link(address: str, query: str) -> str:
    """Return the address of the view, as a link where the page's own address is known."""
    view = escape(f"{address}?{query}")
    return f'<a href="{view}">{view}</a>' if address else view
