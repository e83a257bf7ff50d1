"""The page Paper: the charts of each figure, with and without Floquet's, and what is hidden."""

import numpy as np
import pytest

from app.live.chart import LiveChart
from app.pages.paper import Choice, Paper
from app.results import comparisons
from app.results.paper_charts import PANEL_KEYS, floquet_charts, paper_charts
from app.state import State
from rotorstab.drawing import screen
from rotorstab.paper import FIGURES, FLOQUET_FIGURES, paper_figure

pytestmark = pytest.mark.usefixtures("shared_paper")


@pytest.fixture
def paper():
    return Paper()


def ask(paper, number, **choices):
    return paper.handle({"type": "figure", "number": number, "floquet": True, **choices}, State())


def test_no_chart_is_drawn_before_a_figure_is_chosen(paper):
    assert paper.compute(State()) == {}


@pytest.mark.parametrize("number", FIGURES)
def test_floquets_charts_stand_beside_the_papers_own_once_they_are_computed(paper, number):
    comparisons.figures.clear()
    need = ask(paper, number).follow_up
    own = {f"figure-{panel.letter}" for panel in paper_figure(number).panels}
    assert set(paper.compute(State())) == own
    if number not in FLOQUET_FIGURES:
        assert need is None
        return
    comparisons.keep_figure(number, True, paper_figure(number, True))
    assert set(paper.compute(State())) == own | {f"{key}-floquet" for key in own}
    ask(paper, number, floquet=False)
    assert set(paper.compute(State())) == own


def test_a_place_shows_every_figure_after_every_other_one():
    """A chart is drawn once; its columns, names and ranges are patched."""
    places = {}
    for number in [*FIGURES, *FIGURES]:
        charts = paper_charts(paper_figure(number))
        if number in FLOQUET_FIGURES:
            charts |= floquet_charts(paper_figure(number, True))
        assert set(charts) <= set(PANEL_KEYS)
        for key, chart in charts.items():
            live = places.setdefault(key, LiveChart(chart))
            live.show(chart)
            figure = live.figure
            assert (figure.x_range.start, figure.x_range.end) == chart.x_range
            assert (figure.y_range.start, figure.y_range.end) == chart.y_range
            assert figure.xaxis[0].axis_label == chart.x_label
            assert figure.yaxis[0].axis_label == chart.y_label
            for layer in chart.layers:
                shown = dict(live.sources[layer.label].data)
                assert shown.keys() == screen.columns(layer).keys()
                assert len(shown["name"]) == len(layer.columns["name"])


def test_a_hidden_group_leaves_its_curves_and_regions_out(paper):
    comparisons.keep_figure(6, True, paper_figure(6, True))
    ask(paper, 6, hidden="1,7,x")
    assert paper.choice == Choice(6, True, frozenset({"α_s = 0.2"}))
    for key, chart in paper.compute(State()).items():
        groups = {
            group
            for layer in chart.layers
            if layer.kind != "labels"
            for group in layer.columns["group"]
        }
        assert groups == {"α_s = 0", "α_s = 0.5"}, key


@pytest.mark.parametrize("number", [4, 5, 6, 7, 9])
def test_names_of_tongues_stand_inside_the_chart_and_clear_of_each_other(number):
    for chart in floquet_charts(paper_figure(number, True)).values():
        columns = chart.layer("names").columns
        feet = [place for place, side in enumerate(columns["side"]) if side == "foot"]
        left, right = chart.x_range
        letter = 0.02 * (right - left)  # of 350 pixels
        boxes = [
            (
                columns["x"][one],
                columns["x"][one] + letter * len(columns["name"][one]),
                columns["y"][one],
            )
            for one in feet
        ]
        assert all(left <= begin and end <= right for begin, end, _ in boxes)
        for place, (begin, end, height) in enumerate(boxes):
            for other, until, level in boxes[:place]:
                assert end <= other or until <= begin or abs(height - level) > 0.05


def test_filled_areas_are_polygons_without_gaps():
    for chart in floquet_charts(paper_figure(6, True)).values():
        areas = chart.layer("unstable").columns
        assert areas["xs"]
        assert all(np.isfinite(x).all() for x in (*areas["xs"], *areas["ys"]))


@pytest.mark.parametrize(
    ("choice", "fragment"),
    [
        (Choice(8, True), "#paper/8"),
        (Choice(8, False), "#paper/8/paper-only"),
        (Choice(2, False), "#paper/2"),
    ],
)
def test_the_link_of_a_file_names_the_figure(choice, fragment):
    assert choice.fragment == fragment
