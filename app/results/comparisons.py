"""The paper's figures, and exact against linear stiffness for any Φ and μ: cached, shared."""

from __future__ import annotations

from functools import lru_cache

from rotorstab import critical_load, paper
from rotorstab.charts import Chart, error_loads, stiffness_charts
from rotorstab.paper import FLOQUET_FIGURES, Figure

__all__ = [
    "error_table",
    "figure_known",
    "keep_figure",
    "paper_figure",
    "stiffness_comparison",
]


@lru_cache(maxsize=128)
def stiffness_comparison(shear: float, tangency: float) -> dict[str, Chart]:
    """Return the charts of exact against linear coefficients by key.

    The load range is the paper's: ±p̄_cr axial, ±12.3 follower, in between by μ.
    """
    reach = float(critical_load(shear)) * (1 + tangency * 4.2)
    return {chart.key: chart for chart in stiffness_charts(shear, tangency, (-reach, reach))}


@lru_cache(maxsize=128)
def error_table(shear: float, tangency: float) -> list[list[float]]:
    """Return [tension 1 %, compression 1 %, tension 5 %, compression 5 %] of k̄₁₁ and k̄₂₂."""
    one, five = (error_loads(shear, tangency, level) for level in (0.01, 0.05))
    return [[*map(float, one[i, i]), *map(float, five[i, i])] for i in (0, 1)]


_figures: dict[tuple[int, bool], Figure] = {}


def figure_known(number: int, floquet: bool = False) -> bool:
    """Whether a figure of the paper is there, or takes no time worth a process."""
    return (number, floquet) in _figures or not (floquet and number in FLOQUET_FIGURES)


def keep_figure(number: int, floquet: bool, figure: Figure) -> None:
    """Keep a figure of the paper, also one that another process has made."""
    _figures[number, floquet] = figure


def paper_figure(number: int, floquet: bool = False) -> Figure:
    """Return a figure of the paper by its number, with Floquet's answer where it has one."""
    if (number, floquet) not in _figures:
        keep_figure(number, floquet, paper.paper_figure(number, floquet))
    return _figures[number, floquet]
