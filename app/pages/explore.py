"""Explore: the instability chart, the load–frequency chart and the Campbell diagram."""

from __future__ import annotations

from typing import Any

from rotorstab.charts import Chart

from ..analysis import CHARTS, solve
from ..state import State
from ..verdict import verdict
from .base import Page

__all__ = ["Explore"]


class Explore(Page):
    """The three live charts, the key numbers and the verdict in words."""

    key = "explore"
    title = "Explore"
    chart_keys = CHARTS

    def compute(self, state: State, settled: bool = True) -> dict[str, Chart]:
        """Return the three charts; the map of growth is coarser while sliders move."""
        return solve(state, settled).charts

    def visible(self, state: State) -> dict[str, bool]:
        """Return the layers of the instability chart that can be switched."""
        return {
            "growth": state.show_growth,
            "disagreement": state.show_disagreement,
            "Bolotin region": state.show_bolotin,
            "boundary": state.show_bolotin,
            "boundary name": state.show_bolotin,
        }

    def answer(self, state: State, settled: bool = True) -> dict[str, Any]:
        """Return the key numbers and the verdict."""
        result = solve(state, settled)
        return {"numbers": result.numbers, "verdict": verdict(result.floquet), "settled": settled}
