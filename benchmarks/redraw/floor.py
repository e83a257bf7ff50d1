"""The comparison for a redraw: plain Bokeh sliders that patch the same arrays, computed before.

Served by `bokeh serve`. The figures have the dashboard's sizes (from FLOOR_SIZES), glyphs,
ranges and columns; it does not use Panel, and a callback only looks its arrays up.
"""

import json
import os

from bokeh.io import curdoc
from bokeh.models import ColumnDataSource, HoverTool, Range1d, Slider
from bokeh.plotting import figure

from app.live.chart import LiveChart
from app.state import State
from benchmarks.redraw.moves import FLOQUET, SLIDERS, charts, drag, moving_columns, values
from rotorstab.drawing import screen

COUNT = int(os.environ["FLOOR_COUNT"])
SIZES = json.loads(os.environ["FLOOR_SIZES"])
WITHOUT = () if os.environ.get("FLOOR_FLOQUET", "1") == "1" else FLOQUET
DRAGGED = os.environ.get("FLOOR_DRAGGED", "1") == "1"

figures, sources = {}, {}
for key, chart in charts(without=WITHOUT).items():
    width, height = SIZES[key]
    made = figures[key] = figure(
        name=key,
        width=width,
        height=height,
        x_range=Range1d(*chart.x_range),
        y_range=Range1d(*chart.y_range),
        x_axis_label=chart.x_label,
        y_axis_label=chart.y_label,
        tools="pan,box_zoom,wheel_zoom,save,reset",
        output_backend="canvas",
    )
    looks = LiveChart(chart).figure.renderers
    for layer, look in zip(chart.layers, looks, strict=True):
        source = sources[key, layer.label] = ColumnDataSource(screen.columns(layer))
        renderer = made.add_glyph(source, look.glyph.clone())
        if layer.kind in ("lines", "outlines", "points"):
            made.add_tools(HoverTool(renderers=[renderer], tooltips="@name", visible=False))


def patches(slider, value, moving):
    """Return the columns of each source and the ends of each range for one value."""
    data = []
    for (key, label), names in moving.items():
        columns = screen.columns(charts(slider, value)[key].layer(label))
        data.append((sources[key, label], {name: columns[name] for name in names}))
    ends = [
        (axis, {"start": start, "end": end})
        for key, chart in charts(slider, value).items()
        for axis, (start, end) in (
            (figures[key].x_range, chart.x_range),
            (figures[key].y_range, chart.y_range),
        )
    ]
    return data, ends


def slider_of(name):
    """Return a stock slider whose callback only looks up and sets."""
    parameter = State.param[name]
    low, high = parameter.bounds
    table = [parameter.default, *values(name, COUNT), *(drag(name) if DRAGGED else ())]
    moving = moving_columns(name, table, WITHOUT)
    ready = {value: patches(name, value, moving) for value in table}
    made = Slider(
        name=name, title=name, start=low, end=high, step=parameter.step, value=parameter.default
    )

    def moved(attr, old, new):
        data, ends = ready[new]
        for source, columns in data:
            source.data.update(columns)
        for axis, both in ends:
            axis.update(**both)

    made.on_change("value", moved)
    return made


for name in SLIDERS:
    curdoc().add_root(slider_of(name))
for made in figures.values():
    curdoc().add_root(made)
