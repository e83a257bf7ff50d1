"""The paper's figures, and exact against linear stiffness for any Φ and μ: cached, shared."""

from __future__ import annotations

from rotorstab import paper
from rotorstab.charts import Chart, error_loads, stiffness_charts
from rotorstab.paper import FIGURES, FLOQUET_FIGURES, Figure

from .caches import Store, shared_cache

__all__ = [
    "error_table",
    "figure_known",
    "keep_figure",
    "paper_figure",
    "stiffness_comparison",
]


@shared_cache(128)
def stiffness_comparison(shear: float, tangency: float) -> dict[str, Chart]:
    """Return the charts of exact against linear coefficients by key, up to the pole."""
    return {chart.key: chart for chart in stiffness_charts(shear, tangency)}


@shared_cache(128)
def error_table(shear: float, tangency: float) -> list[list[float]]:
    """Return [tension 1 %, compression 1 %, tension 5 %, compression 5 %] of k̄₁₁ and k̄₂₂."""
    one, five = (error_loads(shear, tangency, level) for level in (0.01, 0.05))
    return [[*map(float, one[i, i]), *map(float, five[i, i])] for i in (0, 1)]


figures: Store[tuple[int, bool], Figure] = Store("comparisons.figures", 2 * len(FIGURES))
"""The figures of the paper, by number and whether Floquet's answer is part of it."""


def figure_known(number: int, floquet: bool = False) -> bool:
    """Whether a figure of the paper is there, or takes no time worth a process."""
    return (number, floquet) in figures or not (floquet and number in FLOQUET_FIGURES)


def keep_figure(number: int, floquet: bool, figure: Figure) -> None:
    """Keep a figure of the paper, also one that another process has made."""
    figures.keep((number, floquet), figure)


def paper_figure(number: int, floquet: bool = False) -> Figure:
    """Return a figure of the paper by its number, with Floquet's answer where it has one."""
    return figures.get((number, floquet), lambda: paper.paper_figure(number, floquet))
