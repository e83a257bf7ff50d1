"""What every page of the dashboard offers to the session."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from dataclasses import dataclass, field, replace
from enum import Enum
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

import panel as pn

from rotorstab.charts import Chart

from ..live.chart import LiveChart
from ..results.growth_maps import keep
from ..results.limits import Detail
from ..results.views import Frame
from ..results.window import Window, floquet_map
from ..state import State
from ..state.address import PinnedInputs

__all__ = ["FRAGMENTS", "Need", "Page", "Reply", "Stage"]

FRAGMENTS = Path(__file__).parent.parent / "assets" / "pages"


class Stage(Enum):
    """How much of a page there is yet; what can wait does not delay the first picture."""

    OPENING = "the document is being built, and the browser has sent no message"
    GREETED = "the browser has sent its first message, and paints its first picture"
    COMPLETE = "the browser has sent another message"


@dataclass(frozen=True)
class Need:
    """A call that takes long and must be made before an answer, and what keeps its result.

    Another process makes the call: its function, arguments and result can be pickled, and its
    arguments be hashed.
    """

    function: Callable[..., Any]
    arguments: tuple[Any, ...]
    keep: Callable[[Any], None]


@dataclass(frozen=True)
class Reply:
    """How a message is answered.

    Parameters
    ----------
    content : mapping
        What the browser is sent at once.
    file : Future or None
        A file that is being made, or several.
    file_content : callable
        Returns what the browser is sent of the file.
    follow_up : (Need or None, callable) or None
        What must be made first, and a function that then returns the rest of the answer.
    failure : mapping
        What the browser is sent, with the reason, if the file or what is needed cannot be made.
    errors : mapping of str to str
        The reason for each input that was refused.
    reset_view : bool
        Whether every zoom is undone.
    """

    content: Mapping[str, Any] = field(default_factory=dict)
    file: Future[Any] | None = None
    file_content: Callable[[Any], Mapping[str, Any]] = dict
    follow_up: tuple[Need | None, Callable[[], Reply]] | None = None
    failure: Mapping[str, Any] = field(default_factory=dict)
    errors: Mapping[str, str] = field(default_factory=dict)
    reset_view: bool = False


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
    stage = Stage.COMPLETE
    # whether a lesson runs beside the charts, which then show its step and nothing else
    in_lesson = False

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
        return {f"{self.key}_{key}".replace("-", "_"): place for key, place in self._places.items()}

    def compute(self, state: State, detail: Detail = Detail.FULL) -> dict[str, Chart]:
        """Return the page's charts for the present inputs, coarser while they move."""
        raise NotImplementedError

    def answer(self, state: State, detail: Detail = Detail.FULL) -> dict[str, Any]:
        """Return what the browser is sent besides the charts, as plain values."""
        return {}

    def awaited(self, state: State) -> Window | None:
        """Return the window whose full map is not there yet, if the page shows one."""
        return None

    def later(self, state: State) -> tuple[Window, ...]:
        """Return the windows of further maps that the page shows once they are made."""
        return ()

    def need(self, state: State) -> Need | None:
        """Return what must be made before the full charts are computed quickly, if anything."""
        window = self.awaited(state) or next(iter(self.later(state)), None)
        if window is None:
            return None
        wanted = window, Detail.FULL
        return Need(floquet_map, wanted, partial(keep, *wanted))

    @property
    def teaches(self) -> bool:
        """Whether this page runs a lesson beside the charts."""
        return False

    def resize(self, message: Mapping[str, Any]) -> bool:
        """Note how large a chart is, if a message tells it; return whether more is to be drawn."""
        return False

    def cache_key(self) -> tuple[Any, ...]:
        """Return, hashable, what besides the inputs decides what the charts show."""
        return ()

    def handle(self, message: Mapping[str, Any], state: State) -> Reply:
        """Answer a message that only this page knows."""
        return Reply()

    def take_address(self, arguments: Mapping[str, Sequence[bytes | str]]) -> None:
        """Note what an address holds for this page besides inputs and pins."""

    def address_pairs(self, state: State) -> Mapping[str, str]:
        """Return what the address holds for this page besides inputs and pins."""
        return {}

    def pin_inputs(self) -> Sequence[PinnedInputs]:
        """Return the pins, for the address."""
        return ()

    def set_address_pins(self, pins: Sequence[PinnedInputs]) -> None:
        """Note the pins of an address; `restore_next_pin` solves them one by one."""

    def restore_next_pin(self) -> str | None:
        """Solve one pin of the address.

        Return None if no pin was waiting, else the pin's name and reason if it has no answer, else
        an empty text.
        """
        return None

    def sidebar_answer(self, state: State) -> dict[str, Any]:
        """Return what this page adds to every answer, whichever page is in view."""
        return {}

    def visible(self, state: State) -> dict[str, bool]:
        """Return by label whether the user has switched a layer on."""
        return {}

    def frames(self, state: State) -> dict[str, Frame]:
        """Return the ranges of the charts that may show a part of themselves."""
        return {}

    def show(self, state: State, detail: Detail = Detail.FULL) -> None:
        """Build the charts on the first call, patch them on every later one."""
        charts = self.compute(state, detail)
        frames = self.frames(state) if charts else {}
        for key, seen in charts.items():
            chart, frame = seen, frames.get(key)
            if frame is not None:
                # a zoom is the browser's: the chart keeps the ranges to which a reset returns
                chart = replace(seen, x_range=frame.home.x, y_range=frame.home.y)
            if key in self.charts:
                if frame is not None:
                    # before the ranges move: BokehJS cuts them at the bounds that it has then
                    self.charts[key].keep_within(frame.bounds)
                self.charts[key].show(chart)
            else:
                self.charts[key] = live = LiveChart(chart)
                # before Panel copies the sizes of the figure
                self.built(key, live)
                self._places[key][:] = [pn.pane.Bokeh(live.figure, sizing_mode="stretch_both")]
                if frame is not None:
                    live.keep_within(frame.bounds)
            self.charts[key].set_visible(self.visible(state))

    def built(self, key: str, chart: LiveChart) -> None:
        """Complete a chart that has just been built."""

    def reset_view(self) -> None:
        """Undo every zoom."""
        for chart in self.charts.values():
            chart.reset_view()
