"""The paper's figures, and exact against linear stiffness for any Φ and μ: cached, shared."""

from __future__ import annotations

from functools import cache, lru_cache

from rotorstab import critical_load
from rotorstab.charts import Chart, error_loads, stiffness_charts
from rotorstab.figures import FIGURES, FLOQUET_FIGURES, Figure

__all__ = ["error_table", "paper_figure", "stiffness_comparison"]


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


@cache
def paper_figure(number: int, floquet: bool = False) -> Figure:
    """Return a figure of the paper by its number, with Floquet's answer where it has one."""
    with_floquet = floquet and number in FLOQUET_FIGURES
    return FIGURES[number](floquet=True) if with_floquet else FIGURES[number]()
