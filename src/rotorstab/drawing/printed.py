"""Figures of the paper drawn with HoloViews: print quality by Matplotlib, or Bokeh.

Vector output needs no browser. The same `Figure` goes to `export` for tables.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from io import BytesIO
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from .._arguments import choice, extra_is_missing

try:
    import holoviews as hv
except ImportError as error:
    raise extra_is_missing(__name__, error) from error

from ..paper import Figure, Panel, Region, Series

__all__ = ["PRINT_FORMATS", "figure_files", "paper_layout"]

PRINT_FORMATS = ("pdf", "svg", "png")

# Okabe–Ito hues; the line style alone tells variants apart in grey print
_COLORS = {"solid": "#0072B2", "dashed": "#D55E00", "dashdot": "#00795A", "dotted": "#7A3E73"}
_MATPLOTLIB_DASH: dict[str, Any] = {
    "solid": "-",
    "dashed": (0, (6, 2.5)),
    "dashdot": (0, (7, 2, 1.4, 2)),
    "dotted": (0, (1.2, 1.4)),
}
_BOKEH_DASH = {"solid": "solid", "dashed": [8, 4], "dashdot": [9, 3, 2, 3], "dotted": [2, 2]}
_SUBSCRIPTS = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")
_PANEL_INCHES = (3.2, 2.6)
_SINGLE_INCHES = (5.6, 3.8)
_WIDE_INCHES = (7.2, 2.75)  # with Floquet: a panel a row, for narrow tongues
_FILL = 0.38
_FLOQUET = "unstable (Floquet)"
_ROUND = "marked point"  # other points are diamonds
_BOLOTIN = "Bolotin region"
_LEGEND = {"frameon": False, "handlelength": 3.4}
_SETTINGS = {
    "font.size": 9.0,
    "font.family": "DejaVu Sans",
    "axes.titlesize": 9.0,
    "axes.labelsize": 9.5,
    "xtick.labelsize": 8.0,
    "ytick.labelsize": 8.0,
    "legend.fontsize": 8.5,
    "pdf.fonttype": 42,
    "svg.fonttype": "path",
    "svg.hashsalt": "rotorstab",  # the same ids in every run
}


def _mathtext(text: str) -> str:
    """Return the text with barred, indexed and Greek symbols as Matplotlib mathtext."""
    text = text.replace("$", r"\$")  # a pin's name may have any sign
    text = re.sub(
        "(.)\u0304([₀-₉]*)",
        lambda m: rf"$\bar{{{m[1]}}}" + (f"_{{{m[2].translate(_SUBSCRIPTS)}}}$" if m[2] else "$"),
        text,
    )
    return re.sub(r"([αβμ])_([sd])", r"$\1_\2$", text).replace("ωₙ", "$ω_n$")


def _axis_label(symbol: str, unit: str) -> str:
    return symbol if unit == "-" else f"{symbol} [{unit}]"


def _color(line: Series | Region) -> str:
    """Return the line's own colour, or its style's."""
    return getattr(line, "color", None) or _COLORS[line.style]


def _point(line: Series, printed: bool) -> str:
    """Return the sign of a single point."""
    if line.group == _ROUND:
        return "o" if printed else "circle"
    return "D" if printed else "diamond"


def _edges(region: Region) -> list[tuple[NDArray[np.float64], NDArray[np.float64]]]:
    """Return the left and the right edge of a region."""
    half = region.x.size // 2
    return [(region.x[part], region.y[part]) for part in (slice(half), slice(half, None))]


def _unstable_hook(panel: Panel, printed: bool) -> Callable[[Any, Any], None]:
    """Return a HoloViews hook that fills and outlines what is unstable.

    A panel has a hundred thin polygons; as HoloViews elements they would take half a minute.
    """

    def draw(plot: Any, _: Any) -> None:
        for group in dict.fromkeys(region.group for region in panel.unstable):
            regions = [region for region in panel.unstable if region.group == group]
            color, style = _color(regions[0]), regions[0].style
            edges = [edge for region in regions for edge in _edges(region)]
            if printed:
                from matplotlib.collections import LineCollection, PolyCollection

                axes = plot.handles["axis"]
                shapes = [np.column_stack([region.x, region.y]) for region in regions]
                axes.add_collection(
                    PolyCollection(
                        shapes,
                        facecolor=color,
                        edgecolor="none",
                        alpha=_FILL,
                        zorder=1,
                        label=group,
                    ),
                    autolim=False,
                )
                # the thinnest tongue is seen by its outline
                axes.add_collection(
                    LineCollection(
                        [np.column_stack(edge) for edge in edges],
                        colors=color,
                        linestyles=[_MATPLOTLIB_DASH[style]],
                        linewidths=0.8,
                        zorder=1.5,
                    ),
                    autolim=False,
                )
            else:
                xs, ys = [region.x for region in regions], [region.y for region in regions]
                plot.state.patches(xs, ys, fill_color=color, fill_alpha=_FILL, line_color=None)
                xs, ys = (list(column) for column in zip(*edges, strict=True))
                plot.state.multi_line(xs, ys, color=color, line_dash=_BOKEH_DASH[style])

    return draw


def _panel_overlay(panel: Panel, backend: str) -> hv.Overlay:
    """Return one panel: shaded regions below, lines above."""
    printed = backend == "matplotlib"
    thin = bool(panel.unstable and panel.regions)  # Bolotin's part steps back
    shade = 0.09 if thin else 0.14
    axes = (panel.x_label, panel.y_label)
    shades = [
        hv.Polygons([{"x": region.x, "y": region.y}], ["x", "y"]).opts(
            **(
                {"facecolor": hv.Cycle([_color(region)]), "edgecolor": "none", "alpha": shade}
                if printed
                else {
                    "fill_color": _color(region),
                    "fill_alpha": shade,
                    "line_alpha": 0.0,
                    "xlabel": axes[0],
                    "ylabel": axes[1],
                }
            ),
            backend=backend,
        )
        for region in panel.regions
    ]
    if panel.grid is not None and not panel.unstable:  # edges say more than pixels
        grid = panel.grid
        values = np.where(grid.values > 0, grid.values, np.nan)
        picture = hv.Image((grid.x, grid.y, values), ["x", "y"], grid.name)
        shades.insert(0, picture.opts(cmap="plasma", backend=backend))
    lines = [
        hv.Curve((line.x, line.y), "x", "y", label=line.group).opts(
            **(
                {"linestyle": _MATPLOTLIB_DASH[line.style], "linewidth": 0.7 if thin else 1.3}
                if printed
                else {"line_dash": _BOKEH_DASH[line.style], "line_width": 1 if thin else 2}
            ),
            color=_color(line),
            alpha=0.5 if thin else 1.0,
            backend=backend,
        )
        for line in panel.series
        if line.x.size > 1
    ]
    lines += [
        hv.Points((line.x, line.y), ["x", "y"]).opts(
            **({"s": 22} if printed else {"size": 8}),
            marker=_point(line, printed),
            color=_color(line),
            backend=backend,
        )
        for line in panel.series
        if line.x.size == 1
    ]
    title = f"({panel.letter}) {panel.title}" if panel.letter else panel.title
    label_x, label_y = _axis_label(axes[0], panel.x_unit), _axis_label(axes[1], panel.y_unit)
    if printed:
        label_x, label_y = _mathtext(label_x), _mathtext(label_y)
    return hv.Overlay([*shades, *lines]).opts(
        hv.opts.Overlay(
            title=title,
            xlabel=label_x,
            ylabel=label_y,
            xlim=panel.x_range,
            ylim=panel.y_range,
            hooks=[_unstable_hook(panel, printed)] if panel.unstable else [],
            show_legend=not printed,
            backend=backend,
            **({"aspect": _PANEL_INCHES[0] / _PANEL_INCHES[1]} if printed else {}),
        )
    )


def _columns(figure: Figure) -> int:
    """Return how many panels stand side by side."""
    if figure.has_floquet:
        return 1
    return 2 if len(figure.panels) in (2, 4) else min(3, len(figure.panels))


def paper_layout(
    figure: Figure, backend: Literal["matplotlib", "bokeh"] = "matplotlib"
) -> hv.Layout:
    """Return a figure as a HoloViews layout, panels side by side.

    Parameters
    ----------
    figure : Figure
        From `rotorstab.paper`.
    backend : {"matplotlib", "bokeh"}
        Which backend's styles it carries; that backend is loaded.

    Returns
    -------
    holoviews.Layout
    """
    hv.renderer(backend)  # loads it where it is not, and leaves the current one current
    layout = hv.Layout([_panel_overlay(panel, backend) for panel in figure.panels])
    columns = _columns(figure)
    if backend == "bokeh":
        return layout.opts(shared_axes=False, backend=backend).cols(columns)
    return layout.opts(shared_axes=False, sublabel_format="", tight=False, backend=backend).cols(
        columns
    )


def _finish(axes: Any, panel: Panel) -> None:
    """Frame, title and labels: above the frame at its top edge, else beside the line."""
    from matplotlib.patheffects import withStroke

    title = _mathtext(f"({panel.letter}) {panel.title}") if panel.letter else ""
    axes.set_title(title, pad=12 if panel.regions else 6)
    axes.set_aspect("auto")
    axes.tick_params(direction="in", top=True, right=True)
    axes.spines[:].set_visible(True)
    for label in panel.labels:
        x, y, backward = label.x, label.y, label.low
        at_top = y >= panel.y_range[1]
        # a label just under the frame would touch it
        below = not at_top and y > panel.y_range[1] - 0.06 * (panel.y_range[1] - panel.y_range[0])
        # to the left of its line, but clear of the axis numbers at the left edge
        leftward = at_top and backward and x > 0.07 * panel.x_range[1]
        axes.annotate(
            label.text,
            (x, y),
            xytext=((-1 if leftward else 1), 2) if at_top else (4, -9 if backward else 3),
            textcoords="offset points",
            ha="right" if leftward else "left",
            va="top" if below else "bottom",
            fontsize=7.0,
            color="#444444",
            annotation_clip=False,
        )
    halo = [withStroke(linewidth=2.2, foreground="white")]
    for mark in panel.marks:
        axes.annotate(
            mark.text,
            (mark.x, mark.y),
            xytext=(3, 0),
            textcoords="offset points",
            ha="left",
            va="bottom",
            rotation=90 if mark.vertical else 0,
            fontsize=7.0,
            fontweight="bold",
            color="#222222",
            path_effects=halo,
        )


def figure_files(figure: Figure, formats: Sequence[str]) -> dict[str, bytes]:
    """Return a figure as the bytes of PDF, SVG and PNG files.

    Parameters
    ----------
    figure : Figure
        From `rotorstab.paper`.
    formats : sequence of {"pdf", "svg", "png"}
        PNG has 300 dots per inch.

    Returns
    -------
    dict of str to bytes
        By format. The same for the same figure and library versions: no date, no random ids.

    Raises
    ------
    ValueError
        For another format.
    """
    for one in formats:
        choice("file format", one, PRINT_FORMATS)
    try:
        import matplotlib
        from matplotlib import pyplot
    except ImportError as error:
        raise extra_is_missing(__name__, error) from error

    heading = f"Figure {figure.number}. {figure.title}" if figure.number else figure.title
    metadata: dict[str, dict[str, Any]] = {
        "pdf": {"CreationDate": None, "ModDate": None, "Title": heading},
        "svg": {"Date": None, "Title": heading},
        "png": {"Title": heading.encode("ascii", "replace").decode()},
    }
    files = {}
    # the calling process may have its own settings: they are put back
    with matplotlib.rc_context(_SETTINGS):
        drawn = hv.render(paper_layout(figure), backend="matplotlib")
        _arrange(drawn, figure, heading)
        for one in formats:
            stream = BytesIO()
            drawn.savefig(stream, format=one, dpi=300, metadata=metadata[one])
            files[one] = stream.getvalue()
        pyplot.close(drawn)
    return files


def _kinds(figure: Figure) -> list[tuple[str, str, float]]:
    """Return name, colour and opacity of the legend's filled areas, where there are two kinds.

    Areas of one colour have it in the legend; those of several, told apart by lines, are grey.
    """
    regions = [region for panel in figure.panels for region in panel.regions]
    if not figure.has_floquet or not regions:
        return []
    unstable = [region for panel in figure.panels for region in panel.unstable]
    found = []
    for name, areas, opacity, grey in (
        (_BOLOTIN, regions, 0.09, 0.14),
        (_FLOQUET, unstable, _FILL, 0.5),
    ):
        colors = {_color(region) for region in areas}
        found.append((name, *((colors.pop(), opacity) if len(colors) == 1 else ("#444444", grey))))
    return found


def _arrange(drawn: Any, figure: Figure, heading: str) -> None:
    """Place the panels, the common legend and the caption of a rendered layout."""
    columns = _columns(figure)
    rows = -(-len(figure.panels) // columns)
    across, down = _PANEL_INCHES if columns > 1 else _SINGLE_INCHES
    if figure.has_floquet:
        across, down = _WIDE_INCHES
    handles, names = _legend_entries(figure)
    entries = _fitting(drawn, handles, names, columns * across)
    lower = 0.35 + 0.18 * -(-len(names) // entries)
    width, height = columns * across, rows * down + lower
    drawn.set_size_inches(width, height)
    axes = [one for one in drawn.axes if one.get_title()]
    for index, (one, panel) in enumerate(zip(axes, figure.panels, strict=True)):
        row, column = divmod(index, columns)
        one.set_position(
            (
                (column * across + 0.62) / width,
                (height - (row + 1) * down + 0.42) / height,
                (across - 0.82) / width,
                (down - 0.8) / height,
            )
        )
        _finish(one, panel)
    drawn.legend(
        handles=handles,
        labels=names,
        loc="lower center",
        bbox_to_anchor=(0.5, 0.24 / height),
        ncols=entries,
        **_LEGEND,
    )
    drawn.text(0.5, 0.1 / height, _mathtext(heading), ha="center", va="bottom", fontsize=9.0)


def _legend_entries(figure: Figure) -> tuple[list[Any], list[str]]:
    """Return the signs and the names of the common legend."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    groups = figure.groups()
    handles: list[Any] = [
        Line2D(
            [],
            [],
            color=_color(line),
            linestyle=_MATPLOTLIB_DASH[line.style] if line.x.size > 1 else "",
            marker="" if line.x.size > 1 else _point(line, True),
        )
        for line in groups.values()
    ]
    names = [_mathtext(group) for group in groups]
    for name, color, alpha in _kinds(figure):
        handles.append(Patch(facecolor=color, alpha=alpha, edgecolor="none"))
        names.append(name)
    return handles, names


def _fitting(drawn: Any, handles: list[Any], names: list[str], width: float) -> int:
    """Return how many entries of the legend go into one row of a width [in]."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    renderer = FigureCanvasAgg(drawn).get_renderer()
    for entries in range(min(5, len(names)), 1, -1):
        legend = drawn.legend(handles=handles, labels=names, ncols=entries, **_LEGEND)
        room = width * drawn.dpi - legend.get_window_extent(renderer).width
        legend.remove()
        if room >= 0:
            return entries
    return 1
