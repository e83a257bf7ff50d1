"""Blocks of text on a printed page: lines that fit a width, and labels that keep apart."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any

from .typesetting import mathtext

__all__ = [
    "GREY",
    "LINE",
    "followed",
    "link_lines",
    "separate_labels",
    "text_width",
    "wrapped",
    "write_lines",
]

LINE = 1.32 / 72
"""Height of a line of text in inches, for each point of its font size."""
GREY = "#444444"
"""Colour of small print."""
_POINTS_PER_INCH = 72.0


def followed(link: str) -> str | None:
    """Return a link that a click in the file may follow, None for a query without an address."""
    return link if "://" in link else None


def _renderer(figure: Any) -> Any:
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    return FigureCanvasAgg(figure).get_renderer()


def text_width(text: str, size: float, weight: str = "normal") -> float:
    """Return the width of a text in inches, with its symbols as `mathtext` sets them."""
    from matplotlib.font_manager import FontProperties
    from matplotlib.textpath import text_to_path

    line = mathtext(text)
    font = FontProperties(size=size, weight=weight)
    # not of a renderer, whose letters have whole pixels
    width, *_ = text_to_path.get_text_width_height_descent(line, font, "$" in line)
    return float(width) / _POINTS_PER_INCH


def wrapped(text: str, width: float, size: float) -> list[str]:
    """Return the lines of a text, each at most as wide as `width` [in], in a font size [pt]."""
    return _fitted(re.findall(r"\S+\s*", text), width, size)


def link_lines(link: str, width: float, size: float) -> list[str]:
    """Return the lines of an address, which may end behind each ampersand."""
    return _fitted(re.findall(r"[^&]+&?", link), width, size)


def _fitted(parts: Iterable[str], width: float, size: float) -> list[str]:
    lines: list[str] = []
    for part in parts:
        if lines and text_width((lines[-1] + part).rstrip(), size) <= width:
            lines[-1] += part
        else:
            lines.append(part)
    return [line.rstrip() for line in lines]


def write_lines(
    figure: Any, place: tuple[float, float], lines: Iterable[str], size: float, **options: Any
) -> float:
    """Write lines of text below each other.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        Of its final size.
    place : (float, float)
        Left end and top of the first line, in inches from the lower left corner.
    lines : iterable of str
    size : float
        Font size [pt].
    **options
        Of `Figure.text`.

    Returns
    -------
    float
        Top of the line that would follow, in inches.
    """
    width, height = figure.get_size_inches()
    x, y = place
    for line in lines:
        # a line stands on 0.28 of its height, which its descenders need
        base = y - 0.78 * LINE * size
        figure.text(
            x / width, base / height, mathtext(line), fontsize=size, va="baseline", **options
        )
        y -= LINE * size
    return y


def separate_labels(axes: Any) -> None:
    """Move labels of Matplotlib axes up or down until none covers another one.

    A label for which there is no free place nearby stays where it is.
    """
    renderer = _renderer(axes.figure)
    taken: list[Any] = []
    for label in axes.texts:
        home = label.xyann
        box = label.get_window_extent(renderer)
        step = 1.1 * box.height * _POINTS_PER_INCH / axes.figure.dpi
        for shift in (0, 1, -1, 2, -2, 3, -3):
            label.xyann = home[0], home[1] + shift * step
            box = label.get_window_extent(renderer)
            inside = axes.bbox.y0 - 1 <= box.y0 and box.y1 <= axes.bbox.y1 + 1
            if inside and not any(box.overlaps(other) for other in taken):
                break
        else:
            label.xyann = home
        taken.append(box)
