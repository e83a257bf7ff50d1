"""What every page of the dashboard offers to the session."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

import panel as pn

from rotorstab.charts import Chart

from ..live.chart import LiveChart
from ..results.growth_maps import keep
from ..results.limits import Detail
from ..results.window import Window, floquet_map
from ..state import State
from ..state.address import PinnedInputs

__all__ = ["FRAGMENTS", "Need", "Page", "Reply"]

FRAGMENTS = Path(__file__).parent.parent / "assets" / "pages"


@dataclass(frozen=True)
class Need:
    """What takes long and must be there before an answer: a call, and what keeps its result.

    Function, arguments and result can be pickled, and the arguments be hashed: another process
    makes the call.
    """

    function: Callable[..., Any]
    arguments: tuple[Any, ...]
    keep: Callable[[Any], None]


@dataclass(frozen=True)
class Reply:
    """What is answered to a message: `now`, and what follows.

    `later` is a file that is being made, `wrap` returns what the browser is sent of it. `then`
    returns the rest of the answer, once what it needs is there. `failed` is sent, with the reason,
    where what follows cannot be made.
    """

    now: Mapping[str, Any] = field(default_factory=dict)
    later: Future[Any] | None = None
    wrap: Callable[[Any], Mapping[str, Any]] = dict
    reset_view: bool = False
    keep_colours: bool | None = None
    then: tuple[Need | None, Callable[[], Reply]] | None = None
    failed: Mapping[str, Any] = field(default_factory=dict)


class Page:
    """A page with live charts, built when it is first opened.

    A subclass gives `key`, `title`, the keys of its charts, `compute` and perhaps `answer`.
    Its layout is the HTML file of its key in `assets/pages`.
    """

    key: ClassVar[str]
    title: ClassVar[str]
    chart_keys: ClassVar[tuple[str, ...]] = ()
    # types of messages that this page answers whichever page is in view
    takes: ClassVar[frozenset[str]] = frozenset()
    # whether the page's document is still being built, before the browser's first message
    opening = False

    def __init__(self) -> None:
        self.charts: dict[str, LiveChart] = {}
        self._places = {
            key: pn.Column(sizing_mode="stretch_both", margin=0) for key in self.chart_keys
        }

    @classmethod
    def fragment(cls) -> str:
        """Return the page's Jinja text, which embeds its roots by name."""
        return (FRAGMENTS / f"{cls.key}.html").read_text(encoding="utf-8")

    def roots(self) -> dict[str, Any]:
        """Return the page's Panel roots by the name its layout uses."""
        return {f"{self.key}_{key}".replace("-", "_"): one for key, one in self._places.items()}

    def compute(self, state: State, detail: Detail = Detail.REFINED) -> dict[str, Chart]:
        """Return the page's charts for the present inputs, coarser while they move."""
        raise NotImplementedError

    def answer(self, state: State, detail: Detail = Detail.REFINED) -> dict[str, Any]:
        """Return what else the browser needs, as plain values."""
        return {}

    def awaited(self, state: State) -> Window | None:
        """Return the window whose full map must be made before `show` is quick, if any."""
        return None

    def need(self, state: State) -> Need | None:
        """Return what must be made before the full charts are computed quickly, if anything."""
        window = self.awaited(state)
        if window is None:
            return None
        wanted = window, Detail.REFINED
        return Need(floquet_map, wanted, partial(keep, *wanted))

    def stamp(self) -> tuple[Any, ...]:
        """Return what tells the charts from others of the same inputs; all of it can be hashed."""
        return ()

    def handle(self, message: Mapping[str, Any], state: State) -> Reply:
        """Answer a message that only this page knows."""
        return Reply()

    def kept(self) -> Sequence[PinnedInputs]:
        """Return the pins, for the address."""
        return ()

    def expect(self, pins: Sequence[PinnedInputs]) -> None:
        """Take the pins of an address; `restore_next` solves them one by one."""

    def restore_next(self) -> str | None:
        """Solve one pin of the address.

        Return None if no pin was waiting, else the pin's name and reason if it has no answer, else
        an empty text.
        """
        return None

    def beside(self, state: State) -> dict[str, Any]:
        """Return what this page adds to the answers of the page in view."""
        return {}

    def visible(self, state: State) -> dict[str, bool]:
        """Return which layers are shown or hidden by choice."""
        return {}

    def show(self, state: State, detail: Detail = Detail.REFINED) -> None:
        """Build the charts on the first call, patch them on every later one."""
        for key, chart in self.compute(state, detail).items():
            if key in self.charts:
                self.charts[key].show(chart)
            else:
                live = LiveChart(chart)
                self._places[key][:] = [pn.pane.Bokeh(live.figure, sizing_mode="stretch_both")]
                self.charts[key] = live
                self.built(key, live)
            self.charts[key].set_visible(self.visible(state))

    def built(self, key: str, chart: LiveChart) -> None:
        """Do what a chart needs once, when it has been built."""

    def keep_colours(self, keep: bool) -> None:
        """Let the scales of the maps only grow, or let them go."""
        for chart in self.charts.values():
            chart.keep_colours(keep)

    def reset_view(self) -> None:
        """Undo every zoom."""
        for chart in self.charts.values():
            chart.reset_view()
