"""A one-page report of the Explore view: self-contained HTML, made to be printed."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

from ..lessons.markdown import plain
from ..state import State
from ..words.si import shown_scales
from .rows import number_rows, parameter_rows, units_sentence

__all__ = ["page_address", "report_html", "report_paragraphs", "view_link"]

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
.wide svg { max-height: 62mm; } .two svg { max-height: 47mm; }
footer { color: #4e5a69; font-size: 7.5pt; line-height: 1.2; margin-top: 2mm;
  overflow-wrap: anywhere; }
a { color: inherit; }
sub { font-size: 0.75em; line-height: 0; } .symbol { font-style: italic; white-space: nowrap; }
@media print { body { margin: 0; } }
"""


def _table(rows: Sequence[tuple[str, str]]) -> str:
    cells = "".join(
        f"<tr><td>{plain(name)}</td><td>{plain(value)}</td></tr>" for name, value in rows
    )
    return f"<table>{cells}</table>"


def page_address(text: object) -> str:
    """Return the page's own address as the browser sent it, or an empty text if it is none."""
    form = r"https?://(?:[\w.-]{1,253}|\[[\da-fA-F:]{2,45}\])(?::\d{1,5})?(?:/[\w./~%-]{0,300})?"
    return text if isinstance(text, str) and re.fullmatch(form, text, re.ASCII) else ""


def view_link(address: object, query: str) -> str:
    """Return the address of a view; only its query where the page's own address is unknown."""
    return f"{page_address(address)}?{query}" if query else page_address(address)


def _point_words(point: Mapping[str, Any]) -> str:
    return f"{point['sentence']} {point['explanation']}".strip()


def report_paragraphs(content: Mapping[str, Any]) -> list[str]:
    """Return the text of the report from what the Explore page answers."""
    paragraphs = [content["verdict"]]
    if content["inspector"]:
        paragraphs.append(f"The marked point: {_point_words(content['inspector'])}")
    if content["pins"]:
        names = ", ".join(pin["name"] for pin in content["pins"]["names"])
        paragraphs.append(f"Thin lines are pinned curves of earlier settings: {names}.")
    return paragraphs


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
    settings = parameter_rows(state)
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
{_table(settings[:half_way])}{_table(settings[half_way:])}{_table(number_rows(numbers, scales))}
</div>
<footer>{units_sentence(state)}: length L, bending stiffness EI and line mass ρA are 1. Floquet
decides what is unstable; a Bolotin region is a first approximation. Made with rotorstab; this view:
{_link(address, query)}</footer>
</body></html>
"""


def _link(address: str, query: str) -> str:
    """Return the address of the view, as a link where the page's own address is known."""
    view = escape(f"{address}?{query}")
    return f'<a href="{view}">{view}</a>' if address else view
