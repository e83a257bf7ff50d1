"""Charts and figures that plot themselves in a notebook, with HoloViews and without it."""

import subprocess
import sys

import numpy as np
import pytest

from rotorstab import BASE_CASE, campbell_diagram, critical_speeds, floquet_solution, lumped
from rotorstab.charts import campbell_chart, multiplier_chart
from rotorstab.paper import figure_2, own_regions

SYSTEM = lumped(BASE_CASE, 0.0)


@pytest.fixture
def chart():
    curves = campbell_diagram(SYSTEM, np.linspace(0.0, 4.0, 41))
    return campbell_chart(curves, 2.0, critical_speeds(SYSTEM))


def legend_of(figure):
    return [item.label.value for legend in figure.legend for item in legend.items]


def test_a_chart_plots_itself_with_a_title_and_a_legend(chart):
    hv = pytest.importorskip("holoviews")
    overlay = chart.plot()
    assert isinstance(overlay, hv.Overlay)
    assert [element.label for element in overlay] == [layer.label for layer in chart.layers]
    whirl = overlay.get(0).split(datatype="columns")
    for path, line in zip(whirl, chart.layer("whirl").curves(), strict=True):
        np.testing.assert_array_equal(path["y"], line.y)
    figure = hv.render(overlay, backend="bokeh")
    assert figure.title.text == "Campbell diagram"
    assert legend_of(figure) == [
        "backward whirl (B)",
        "forward whirl (F)",
        "synchronous, |ω̄| = Ω̄",
        "present setting",
    ]


def test_a_chart_without_groups_of_lines_and_a_square_one_plot_themselves():
    hv = pytest.importorskip("holoviews")
    figure = hv.render(
        multiplier_chart(floquet_solution(SYSTEM, 1.0, 0.1, 1.3)).plot(), backend="bokeh"
    )
    assert figure.width == figure.height


def test_a_figure_plots_its_panels():
    hv = pytest.importorskip("holoviews")
    figure = own_regions(SYSTEM, BASE_CASE.shear, (0.0, 1.0), (0.0, 0.5))
    layout = figure.plot()
    assert isinstance(layout, hv.Layout)
    assert len(layout) == 2
    drawn = hv.render(list(layout)[1], backend="bokeh")
    assert drawn.title.text == "(b) Ω̄ = 1"
    assert legend_of(drawn) == ["α_s = 0", "α_s = 0.5"]
    hv.render(figure_2(points=11).plot(), backend="bokeh")


@pytest.mark.parametrize("missing", ["holoviews", "bokeh"])
def test_without_a_drawing_library_the_error_says_how_to_get_it(missing):
    code = (
        f"import sys; sys.modules[{missing!r}] = None\n"
        "from rotorstab.paper import figure_2\n"
        "figure = figure_2(points=11)\n"
        "for part in (figure, figure.panels[0]):\n"
        "    try:\n"
        "        part.plot()\n"
        "    except ImportError as error:\n"
        "        print(error)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    line = (
        f"rotorstab.drawing.notebook needs {missing}, which is not installed: "
        "pip install 'rotorstab[app]'"
    )
    assert done.stdout.splitlines() == [line, line], done.stderr
