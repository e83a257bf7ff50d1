"""Charts that nobody has opened yet, drawn ahead while the process has nothing else to do.

HoloViews needs a fifth of a second for each kind of chart, once in a process. The charts of Explore
are drawn before a worker serves; whoever opens another page first would wait for its charts.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

from ..background.processes import background
from ..background.threads import Scheduler
from ..live.drawing import draw
from ..results.analysis import solve
from ..results.comparisons import paper_figure
from ..results.limits import Detail
from ..results.paper_charts import paper_charts
from ..state import State
from .explore import COMPARISON
from .own_rotor import OwnRotor
from .stiffness import Stiffness

__all__ = ["Warming", "warming"]

QUIET = 2.0
"""Seconds without a message of any session after which a chart is drawn ahead."""
PAUSE = 0.5
"""Seconds between two of them."""
_FIGURES = (6, 3)
"""Figures of the paper: the one that is shown first, and one with a fourth panel."""


def _steps() -> Iterator[None]:
    """Draw one chart after the other."""
    state = State()
    for chart in Stiffness().compute(state).values():
        draw(chart)
        yield
    for chart in OwnRotor().compute(state, Detail.COARSE).values():
        draw(chart)
        yield
    for number in _FIGURES:
        figure = paper_figure(number)
        yield
        for chart in paper_charts(figure).values():
            draw(chart)
            yield
    draw(replace(solve(state, Detail.COARSE).charts["instability"], key=COMPARISON))


class Warming:
    """Draws charts ahead, one at a time and once in a process, whichever session drives it."""

    def __init__(self) -> None:
        self._steps = _steps()
        self.done = False

    def follow(self, scheduler: Scheduler) -> None:
        """Draw a chart whenever all sessions are quiet, as long as this session is there."""
        if not self.done:
            scheduler.call_later(PAUSE, partial(self._turn, scheduler))

    def _turn(self, scheduler: Scheduler) -> None:
        if not self.done and background.is_quiet(QUIET):
            self.step()
        self.follow(scheduler)

    def step(self) -> None:
        """Draw the next chart."""
        self.done = next(self._steps, self) is self


warming = Warming()
"""The one of this server process."""
