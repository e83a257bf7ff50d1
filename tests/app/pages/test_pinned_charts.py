"""Pins in the charts: Floquet's outlines, Bolotin's boundaries and whirl curves of a setting."""

import numpy as np
import pytest

from app.pages.explore import Explore
from app.results.growth_maps import keep
from app.results.limits import Detail
from app.results.window import floquet_map
from app.session import Session
from app.state import State
from rotorstab.drawing import contours

WINDOW = {"left": 1.0, "right": 2.0, "low": 0.2, "high": 0.6}


def make_ahead(page, state):
    """Make what another process would make for the pins."""
    for window in page.later(state):
        keep(window, Detail.FULL, floquet_map(window, Detail.FULL))


def outline(chart):
    """The edge of what the chart's own setting makes unstable."""
    return contours.outline(chart.layer("tongue edge"))


def pinned(page, state, **changes):
    """Pin the present setting, then change it."""
    page.compute(state)
    page.handle({"type": "pin", "label": "first"}, state)
    assert state.change(changes) == {}
    make_ahead(page, state)


@pytest.mark.parametrize("view", [None, WINDOW])
def test_the_outline_of_a_pin_is_that_of_its_setting_in_what_is_seen(view):
    state, page = State(), Explore()
    pinned(page, state, spin_speed=1.2, disk_mass=3.0)
    if view:
        page.handle({"type": "window", "chart": "instability", **view}, state)
        make_ahead(page, state)
    own = Explore()
    if view:
        own.handle({"type": "window", "chart": "instability", **view}, State())
    expected = outline(own.compute(State())["instability"])
    columns = page.compute(state, Detail.COARSE)["instability"].layer("pinned edge").columns
    assert columns["name"][0] == "first: edge of what is unstable"
    assert set(columns["role"]) == {"pin 1"}
    np.testing.assert_array_equal(columns["xs"][0], expected[0])
    np.testing.assert_array_equal(columns["ys"][0], expected[1])
    assert page.later(state) == ()


def test_a_pin_is_named_at_its_outline():
    state, page = State(), Explore()
    pinned(page, state, spin_speed=1.2)
    chart = page.compute(state)["instability"]
    label = chart.layer("pin name").columns
    assert (label["name"], label["role"]) == (["first"], ["pin 1"])
    x, y = (chart.layer("pinned edge").columns[axis][0] for axis in ("xs", "ys"))
    # within a pixel of the outline
    near = np.hypot((x - label["x"][0]) / 6.0, (y - label["y"][0]) / 1.0)
    assert np.nanmin(near) < 0.02


def test_the_present_setting_is_not_drawn_twice():
    state, page = State(), Explore()
    pinned(page, state)
    labels = {layer.label for layer in page.compute(state)["instability"].layers}
    assert not {"pinned edge", "pin name"} & labels


def test_a_pin_in_SI_lies_where_its_own_shaft_puts_it():
    state, page = State(units="SI"), Explore()
    own = outline(page.compute(state)["instability"])
    pinned(page, state, shaft_length=0.6, disk_mass=4.0)
    columns = page.compute(state)["instability"].layer("pinned edge").columns
    # a tongue that is thin in one window may be a line of few points in the other one
    x, y = (np.concatenate(columns[axis]) for axis in ("xs", "ys"))
    right, top = np.nanmax(x), np.nanmax(y)
    # the present window in Hz and N ends elsewhere; below both ends the outlines are the same,
    # but for the many thin tongues of slow loads
    inside = (own[0] > 0.2 * right) & (own[0] < 0.5 * right) & (own[1] < 0.5 * top)
    for at in np.flatnonzero(inside)[::7]:
        step = np.hypot((x - own[0][at]) / right, (y - own[1][at]) / top)
        assert np.nanmin(step) < 0.045  # a line of 13 points


def test_pins_follow_a_zoom_of_the_other_charts():
    state, page = State(), Explore()
    pinned(page, state, static_load_factor=0.2)
    window = {"left": 1.0, "right": 1.1, "low": -1.0, "high": 1.0}
    page.handle({"type": "window", "chart": "campbell", **window}, state)
    x = page.compute(state)["campbell"].layer("pins").columns["xs"][0]
    assert np.sum((x >= 1.0) & (x <= 1.1)) > 100


def test_a_move_sends_nothing_of_a_pin_and_the_switches_hide_it():
    session = Session()
    session.respond({"type": "hello"})
    session.respond({"type": "pin", "label": "first"})
    session.respond({"type": "change", "values": {"spin_speed": 1.5}})
    live = session.pages["explore"].charts["instability"]
    before = dict(live.sources["pinned edge"].data)
    assert len(before["xs"]) > 0
    session.respond({"type": "change", "values": {"spin_speed": 1.4}})
    after = live.sources["pinned edge"].data
    assert all(after[name] is column for name, column in before.items())
    session.respond({"type": "change", "values": {"show_growth": False}})
    assert not live.renderers["pinned edge"].visible
    assert not live.renderers["pin name"].visible
    assert live.renderers["pinned boundary"].visible
    session.respond({"type": "unpin", "number": 1})
    assert len(live.sources["pinned edge"].data["xs"]) == 0
