"""Save picture: the whole view on one page, as seen, with what made it."""

import math
from base64 import b64decode
from dataclasses import replace
from queue import Queue

import matplotlib
import pytest
from matplotlib import pyplot

from app.exports.picture import view_sheet
from app.exports.report import view_link
from app.exports.rows import pin_sentence
from app.exports.seen import as_seen, zooms
from app.live.chart import Zoom
from app.pages.explore import Explore
from app.pages.marked_point import INSPECTOR_CHARTS
from app.results.analysis import CHARTS
from app.session import Session
from app.state import PRESETS, State
from rotorstab.drawing.formats import PICTURE_FORMATS
from rotorstab.drawing.printed import SETTINGS
from rotorstab.drawing.printed_sheet import draw_sheet, sheet_files
from tests.testing.pictures import boxes_of, metadata, overlaps

AT = "https://rotor.example/app"
MARKED = {"marker": True, "marker_frequency": 1.7, "marker_factor": 0.4}
STATES = {
    "no marked point": {"marker": False},
    "SI, damped, marked": {
        "units": "SI",
        **PRESETS["Table 1, 1000 rpm"],
        "external_damping": 0.02,
        "internal_damping": 0.01,
        **MARKED,
    },
    "follower, exact, both laws": {
        "load_type": "follower",
        "law": "exact",
        "stiffness": "both",
        "static_load_factor": 0.3,
        "growth_unit": "per period",
        **MARKED,
    },
}


# a sheet takes ten seconds: one with a marked point and one without it are enough for each change
LONG = ("follower, exact, both laws",)


@pytest.fixture(
    scope="module",
    params=[pytest.param(name, marks=pytest.mark.long if name in LONG else ()) for name in STATES],
    ids=list(STATES),
)
def view(request):
    """A state, Explore with two pins, their sheet, and the texts of the drawn page."""
    page, state = Explore(), State()
    assert state.change(STATES[request.param]) == {}
    for speed, name in ((0.5, "slow"), (3.0, "a rather long name of $x")):
        other = State(**state.inputs() | {"spin_speed": speed})
        assert "was added" in page.handle({"type": "pin", "label": name}, other).content["toast"]
    sheet = view_sheet(page, state, f"{AT}?v=1&as=0.5")
    with matplotlib.rc_context(SETTINGS):
        figure = draw_sheet(sheet)
    boxes = boxes_of(figure)
    pyplot.close(figure)
    return state, page, sheet, boxes


def test_no_text_of_a_picture_covers_another_or_leaves_the_page(view):
    *_, boxes = view
    assert len(boxes) > 80
    assert overlaps(boxes) == []
    width, height = 11.69 * 300, 8.27 * 300
    outside = [
        text.get_text()
        for text, box in boxes
        if min(box.x0, box.y0) < 0 or box.x1 > width or box.y1 > height
    ]
    assert outside == []
    # readable at arm's length
    assert min(text.get_fontsize() for text, _ in boxes) >= 5


def test_a_picture_holds_charts_words_tables_and_link(view):
    state, page, sheet, boxes = view
    answer = page.answer(state)
    assert [chart.key for chart in sheet.charts] == list(CHARTS)
    assert [chart.key for chart in sheet.point_charts] == (
        list(INSPECTOR_CHARTS) if state.marker else []
    )
    assert sheet.sentence == (answer["inspector"]["sentence"] if state.marker else "")
    assert answer["verdict"] in sheet.paragraphs
    assert "slow (Ω̄ = 0.5)" in sheet.paragraphs[-1]
    tables = dict(sheet.tables)
    assert ("The marked point" in tables) == state.marker
    shown = dict(sheet.settings[1])
    assert float(shown["Static load factor α_s"].split()[0]) == state.static_load_factor
    assert any("rpm" in value for value in shown.values()) == (state.units == "SI")
    words = " ".join(text.get_text() for text, _ in boxes)
    assert "as=0.5" in words
    assert "V of the tip" in words or not state.marker
    assert "slow" in words  # the legend names the pins


def test_a_chart_is_printed_in_the_window_that_is_seen_without_the_layers_that_are_off():
    session = Session()
    session.respond({"type": "change", "values": {"show_bolotin": False}})
    page = session.pages["explore"]
    x_range = page.charts["instability"].figure.x_range
    x_range.update(start=1.0, end=2.0)
    charts = as_seen(page.compute(session.state), page, session.state, zooms(page))
    assert charts["instability"].x_range == (1.0, 2.0)
    assert charts["instability"].y_range == (0.0, 1.0)
    assert charts["instability"].regions == ()
    assert charts["campbell"].x_range == (0.0, 4.0)
    session.respond({"type": "view"})
    assert zooms(page)["instability"] == Zoom()


@pytest.mark.parametrize("zoomed", [(math.nan, 1.0), (2.0, 1.0), (0.0, math.inf)])
def test_a_zoom_that_is_no_range_is_not_taken(zoomed):
    page, state = Explore(), State()
    charts = page.compute(state)
    seen = as_seen(charts, page, state, {"campbell": Zoom(x=zoomed)})
    assert seen["campbell"].x_range == charts["campbell"].x_range


SENT = "svg"
DRAWN_HERE = [kind for kind in PICTURE_FORMATS if kind != SENT]


@pytest.mark.parametrize("kind", DRAWN_HERE)
def test_every_format_of_the_page_says_what_made_it(kind, files_of_a_view):
    sheet, files = files_of_a_view
    found = metadata(files[kind], kind)
    assert found["link"] == sheet.link
    assert "spin_speed = 1.25; " in found["parameters"]


@pytest.fixture(scope="module")
def files_of_a_view():
    """A sheet and its files, drawn once for all formats but the one that the page sends below."""
    sheet = view_sheet(Explore(), State(spin_speed=1.25, **MARKED), f"{AT}?v=1&as=0.5")
    return sheet, sheet_files(sheet, DRAWN_HERE)


def test_the_page_sends_the_picture_with_link_and_parameters():
    kind = SENT
    session = Session()
    told = Queue()
    session.controls.send = told.put
    session.respond({"type": "change", "values": {"spin_speed": 1.25, **MARKED}})
    answer = session.respond({"type": "picture", "format": kind, "at": AT})
    assert answer["toast"] == f"making rotorstab.{kind} …"
    file = told.get(timeout=120)["file"]
    assert file["name"] == f"rotorstab.{kind}"
    found = metadata(b64decode(file["base64"]), kind)
    assert found["link"] == view_link(AT, session.query())
    assert "spin_speed = 1.25; " in found["parameters"]


@pytest.mark.parametrize(
    ("kind", "chart"), [("pdf", "instability"), ("svg", "response"), ("png", "multipliers")]
)
def test_each_chart_alone_says_what_made_it(kind, chart):
    session = Session()
    told = Queue()
    session.controls.send = told.put
    session.respond({"type": "change", "values": MARKED})
    session.respond({"type": "export", "format": kind, "chart": chart, "at": AT})
    found = metadata(b64decode(told.get(timeout=120)["file"]["base64"]), kind)
    assert found["link"] == f"{AT}?{session.query()}"
    assert "marker_frequency = 1.7; " in found["parameters"]


@pytest.mark.parametrize("kind", ["csv", "gif", 3, None])
def test_another_format_of_the_picture_is_refused(kind):
    assert Session().respond({"type": "picture", "format": kind})["toast"] == "no such file format"


def test_equal_pins_are_named_so():
    page, state = Explore(), State()
    assert pin_sentence(state, ()) == ""
    page.handle({"type": "pin", "label": "same"}, state)
    assert pin_sentence(state, page.pin_inputs()) == "Pinned curves: same (the present settings)."
    sheet = view_sheet(page, state, "?v=1")
    assert replace(sheet, link="").main_figure.panels == sheet.charts
