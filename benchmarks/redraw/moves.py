"""The slider values of the benchmark and what each chart must show for them."""

from dataclasses import replace
from functools import lru_cache

import numpy as np

from app.live.chart import _same
from app.pages.base import Stage
from app.pages.explore import Explore
from app.results.default_marker import place_marker
from app.results.limits import Detail
from app.state import State
from rotorstab.drawing import screen

SLIDERS = ("static_load_factor", "spin_speed", "shear")
# layers that a page without Floquet's answer lacks
FLOQUET = ("growth", "disagreement", "unstable", "tongue edge", "thin tongue", "tongue")
RATE = 60  # events/s of a drag
SECONDS = 2


def values(slider, count):
    """Return `count` different values of a slider, on its steps, in a mixed order."""
    parameter = State.param[slider]
    low, high = (round(share * parameter.bounds[1] / parameter.step) for share in (0.05, 0.95))
    steps = np.linspace(low, high, count).round().astype(int)
    if len(set(steps)) < count:
        raise ValueError(f"`count` must be {high - low + 1} or less for {slider}, got {count}")
    order = np.random.default_rng(1).permutation(count)
    return [float(f"{step * parameter.step:.12g}") for step in steps[order]]


def drag(slider, place=0):
    """Return the values of one drag: once up and down the slider, from a place of its own."""
    up = sorted(values(slider, RATE * SECONDS // 2))
    there_and_back = up + up[::-1]
    start = 7 * place % len(there_and_back)
    return there_and_back[start:] + there_and_back[:start]


@lru_cache(maxsize=2048)
def charts(slider=None, value=None, without=(), detail=Detail.COARSE):
    """Return all charts of the page Explore for the default settings with one value changed.

    They are those of a slider that moves, or with `Detail.FULL` those at rest. Some layers may
    be left out.
    """
    state = State()
    if slider:
        errors = state.change({slider: value})
        assert not errors, errors
    place_marker(state)
    page = Explore()
    page.stage = Stage.COMPLETE
    return {
        key: replace(chart, layers=tuple(one for one in chart.layers if one.label not in without))
        for key, chart in page.compute(state, detail).items()
    }


def moving_columns(slider, table, without=()):
    """Return {(chart, layer): names of the columns that differ somewhere in a table of values}."""
    found = {}
    for value in table:
        for key, chart in charts(slider, value, without=without).items():
            for layer in chart.layers:
                first = screen.columns(charts(slider, table[0])[key].layer(layer.label))
                for name, column in screen.columns(layer).items():
                    if not _same(column, first[name]):
                        found.setdefault((key, layer.label), set()).add(name)
    return found


def probe(chart):
    """Return one number that tells which values a chart shows: `probe` of probe.js."""
    total = 0.0
    for layer in chart.layers:
        data = screen.columns(layer)
        for one in ("xs", "ys", "x", "y"):
            column = data.get(one, ())
            while len(column) and not np.isscalar(column[0]):
                column = column[0]
            numbers = [
                float(column[i]) for i in (0, len(column) // 3, len(column) - 1) if len(column)
            ]
            total += sum(number for number in numbers if np.isfinite(number))
    return total


def probes(slider, value, without=(), detail=Detail.COARSE):
    """Return the probe of every chart by its key."""
    made = charts(slider, value, without, detail)
    return {key: probe(chart) for key, chart in made.items()}
