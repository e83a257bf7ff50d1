"""The instability chart of a pin beside the present one."""

import numpy as np
import pytest

from app.pages.explore import COMPARISON
from app.session import Session
from app.state import State
from app.state.address import MOST_PINS


@pytest.fixture(scope="module")
def shared():
    return Session()


@pytest.fixture
def session(shared):
    """A session with one pin at the default settings, and another spin speed now."""
    for number in range(1, MOST_PINS + 1):
        shared.respond({"type": "unpin", "number": number})
    shared.respond({"type": "reset"})
    shared.respond({"type": "pin", "label": "first"})
    change(shared, spin_speed=1.0)
    return shared


def change(session, **values):
    return session.respond({"type": "change", "values": values})


def test_there_is_a_choice_for_each_pin():
    pins = [f"pin {number}" for number in range(1, MOST_PINS + 1)]
    assert State.param.compared.objects == ["none", *pins]


def test_the_chart_of_a_pin_has_the_same_axes_and_colours(session):
    edge = session.pages["explore"].charts["instability"].sources["pinned edge"].data
    answer = change(session, compared="pin 1")
    assert answer["side_by_side"] == {"now": "Now: Ω̄ = 1", "pin": "first: Ω̄ = 2"}
    charts = session.pages["explore"].charts
    now, beside = charts["instability"].figure, charts[COMPARISON].figure
    assert (now.x_range, now.y_range) == (beside.x_range, beside.y_range)
    tops = {
        charts[key].renderers["unstable"].glyph.fill_color.transform.high
        for key in ("instability", COMPARISON)
    }
    assert len(tops) == 1
    # it shows what the outlines of the pin in the present chart bound
    np.testing.assert_array_equal(
        charts[COMPARISON].sources["tongue edge"].data["xs"][0], edge["xs"][0]
    )
    change(session, disk_mass=2.0)  # which grows faster
    session.respond({"type": "colours", "fit": True})
    scales = [
        charts[key].renderers["unstable"].glyph.fill_color.transform
        for key in ("instability", COMPARISON)
    ]
    assert scales[0].high == scales[1].high != tops.pop()
    session.respond({"type": "colours", "fit": False})


def test_a_zoom_and_a_growth_per_period_hold_for_both(session):
    change(session, compared="pin 1", growth_unit="per period")
    charts = session.pages["explore"].charts
    charts["instability"].figure.x_range.update(start=1.0, end=2.0)
    window = {"left": 1.0, "right": 2.0, "low": 0.0, "high": 1.0}
    session.respond({"type": "window", "chart": "instability", **window})
    x = np.concatenate(charts[COMPARISON].sources["tongue edge"].data["xs"])
    assert 1.0 <= np.nanmin(x) < np.nanmax(x) <= 2.0
    titles = {charts[key].figure.right[0].title for key in ("instability", COMPARISON)}
    assert len(titles) == 1
    assert "T" in titles.pop()
    session.respond({"type": "view"})
    x_range = charts[COMPARISON].figure.x_range
    assert (x_range.start, x_range.end) == (0.0, 6.0)


def test_titles_are_in_SI_where_the_charts_are(session):
    answer = change(session, compared="pin 1", units="SI")
    assert answer["side_by_side"]["now"].startswith("Now: Ω = ")
    assert answer["side_by_side"]["now"].endswith("rpm")


def test_the_link_has_the_choice_and_a_pin_that_goes_takes_its_chart_along(session):
    answer = change(session, compared="pin 1")
    assert "side=pin+1" in answer["query"]
    answer = session.respond({"type": "unpin", "number": 1})
    assert answer["side_by_side"] is None
    assert answer["values"]["compared"] == "none"
    assert change(session, compared="pin 2")["side_by_side"] is None
