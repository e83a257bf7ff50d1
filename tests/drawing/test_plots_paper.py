"""The drawn figures of the paper: their data, their layout, their bytes."""

from dataclasses import replace

import numpy as np
import pytest

hv = pytest.importorskip("holoviews")
pytest.importorskip("matplotlib")

from app.results.analysis import CHARTS  # noqa: E402
from app.session import Session  # noqa: E402
from rotorstab.charts import chart_figure  # noqa: E402
from rotorstab.drawing.formats import PICTURE_FORMATS  # noqa: E402
from rotorstab.drawing.printed import figure_files, paper_layout  # noqa: E402
from rotorstab.paper import FIGURES, FLOQUET_FIGURES  # noqa: E402


@pytest.mark.parametrize("number", FIGURES)
def test_drawn_lines_and_regions_are_the_arrays(number):
    figure = FIGURES[number]()
    layout = paper_layout(figure)
    assert len(layout) == len(figure.panels)
    for overlay, panel in zip(layout, figure.panels, strict=True):
        curves = [one for one in overlay if isinstance(one, hv.Curve)]
        shades = [one for one in overlay if isinstance(one, hv.Polygons)]
        assert len(curves) == len(panel.series)
        assert len(shades) == len(panel.regions)
        for curve, line in zip(curves, panel.series, strict=True):
            np.testing.assert_array_equal(curve.dimension_values("x"), line.x)
            np.testing.assert_array_equal(curve.dimension_values("y"), line.y)


def test_files_are_of_their_kind_and_the_same_every_time():
    figure = FIGURES[8](points=41)
    first, second = (figure_files(figure, tuple(PICTURE_FORMATS)) for _ in range(2))
    assert first == second
    assert first["pdf"].startswith(b"%PDF-")
    assert b"/CreationDate" not in first["pdf"]
    assert first["png"].startswith(b"\x89PNG")
    assert b"<svg" in first["svg"]
    assert b"<dc:date>" not in first["svg"]


def overlaps(boxes):
    """Return the pairs of boxes that overlap by more than a hair (1.5 of 100 dots an inch)."""
    return [
        (a, b)
        for i, a in enumerate(boxes)
        for b in boxes[i + 1 :]
        if min(a.x1, b.x1) - max(a.x0, b.x0) > 1.5 and min(a.y1, b.y1) - max(a.y0, b.y0) > 1.5
    ]


def nothing_is_covered(figure, monkeypatch):
    from matplotlib import pyplot

    kept = []
    monkeypatch.setattr(pyplot, "close", kept.append)
    figure_files(figure, [])
    monkeypatch.undo()
    drawn = kept[-1]
    drawn.draw_without_rendering()
    renderer = drawn.canvas.get_renderer()
    texts = list(drawn.texts) + [text for one in drawn.legends for text in one.get_texts()]
    for axes in drawn.axes:
        if not axes.get_title():
            continue
        texts += [axes.title, axes.xaxis.label, axes.yaxis.label, *axes.texts]
        for axis in (axes.xaxis, axes.yaxis):
            low, high = sorted(axis.get_view_interval())
            texts += [
                tick.label1
                for tick in axis.get_major_ticks()
                if low - 1e-9 <= tick.get_loc() <= high + 1e-9
            ]
    boxes = [text.get_window_extent(renderer) for text in texts if text.get_text()]
    assert overlaps(boxes) == []
    width, height = drawn.get_size_inches() * drawn.dpi
    for box in boxes:
        assert box.x0 >= 0
        assert box.y0 >= 0
        assert box.x1 <= width
        assert box.y1 <= height
    pyplot.close("all")


@pytest.mark.parametrize(
    ("number", "options"),
    [*((n, {}) for n in FIGURES), *((n, {"floquet": True}) for n in FLOQUET_FIGURES)],
)
@pytest.mark.usefixtures("shared_paper")
def test_no_text_covers_another_or_leaves_the_page(number, options, monkeypatch):
    nothing_is_covered(FIGURES[number](**options), monkeypatch)


def test_drawing_leaves_the_current_backend_alone():
    hv.renderer("bokeh")
    before = hv.Store.current_backend
    hv.Store.set_current_backend("bokeh")
    figure_files(replace(FIGURES[2](points=11)), ["svg"])
    assert hv.Store.current_backend == "bokeh"
    hv.Store.set_current_backend(before)


def test_other_formats_are_refused():
    with pytest.raises(ValueError, match="`file format` must be one of 'pdf', 'svg', 'png'"):
        figure_files(FIGURES[2](points=11), ["jpg"])


def test_no_text_of_an_exported_live_chart_is_cut(monkeypatch):
    session = Session()
    values = {"spin_speed": 1.0, "marker": True, "units": "SI"}
    session.respond({"type": "change", "values": values})
    for name in ("base", "a rather long name of $x"):
        session.respond({"type": "change", "values": {"polar_inertia": 0.1 * len(name)}})
        session.respond({"type": "pin", "label": name})
    session.respond({"type": "change", "values": {"polar_inertia": 1.6, "external_damping": 0.02}})
    drawn = session.pages["explore"].compute(session.state)
    for key in CHARTS:
        figure = chart_figure(drawn[key], {})
        assert "base" in figure.groups()
        nothing_is_covered(figure, monkeypatch)
    assert figure.groups()["marked point"].look != figure.groups()["critical speed"].look
