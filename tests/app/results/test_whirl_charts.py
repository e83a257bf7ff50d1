"""The load–frequency chart and the Campbell diagram of the part that a zoom shows."""

import numpy as np
import pytest

from app.results.curves import flutter
from app.results.operation import operation_of
from app.results.views import View
from app.results.whirl_charts import whirl_bounds, whirl_chart
from app.state import State
from rotorstab import whirl_frequencies

SETTINGS = [
    {},
    {"internal_damping": 0.02},
    {"model": "finite elements"},
    {"law": "exact", "load_type": "partly", "tangency": 0.4, "spin_speed": 3.0},
]


def seen_frequencies(chart, mode_name, at):
    """Return Re ω̄ of the lines whose names begin with a mode, at abscissas."""
    columns = chart.layer("whirl").columns
    found = np.full(at.shape, np.nan)
    for x, y, name in zip(columns["xs"], columns["ys"], columns["name"], strict=True):
        if name.startswith(mode_name):
            values = np.interp(at, x, y)  # NaN beside a gap
            found = np.where(np.isnan(found), values, found)
    return found


@pytest.mark.parametrize("setting", SETTINGS)
def test_what_is_seen_of_a_campbell_diagram_is_exact_to_a_part_of_a_pixel(setting):
    operation = operation_of(State(**setting))
    seen = View(1.0, 1.2, -0.8, 1.2)
    chart = whirl_chart("campbell", operation, "linear", seen)
    assert (chart.x_range, chart.y_range) == (seen.x, seen.y)
    at = np.linspace(1.001, 1.199, 97)
    system = operation.model.system(0.0, operation.tangency)
    exact = np.sort(whirl_frequencies(system.at_speed(at), operation.static_load).real, axis=1)
    whole = whirl_chart("campbell", operation, "linear")
    for mode in ("1B", "1F"):
        found = seen_frequencies(chart, mode, at)
        distance = np.abs(exact - found[:, None]).min(axis=1)
        assert np.nanmax(distance) < 1e-3 * (seen.high - seen.low)
        # modes have the names that they have in the whole diagram
        step = seen_frequencies(whole, mode, at)
        np.testing.assert_allclose(found, step, atol=0.02)


def test_curves_are_fine_where_they_bend_at_flutter():
    operation = operation_of(State(load_type="follower"))
    at = flutter(operation.model.rotor, operation.spin_speed)
    system = operation.model.system(operation.spin_speed, 1.0)
    met = float(whirl_frequencies(system, at - 1e-9).real.max())
    width, height = 0.02, 0.4
    seen = View(at - width, at + width, met - height, met + height)
    chart = whirl_chart("load-frequency", operation, "linear", seen)
    # the distance from flutter, far below the pixels of the chart
    loads = at - np.geomspace(1e-9, 0.9 * width, 60)
    exact = whirl_frequencies(system, loads).real.max(axis=1)
    columns = chart.layer("whirl").columns
    line = next(
        (x, y)
        for x, y, name in zip(columns["xs"], columns["ys"], columns["name"], strict=True)
        if name == "2F, follower"
    )
    known = np.isfinite(line[1])
    found = np.interp(loads, line[0][known], line[1][known])
    # samples that are evenly spaced would miss the vertical tangent
    assert np.abs(found - exact).max() < 2e-3 * 2 * height


@pytest.mark.parametrize("setting", SETTINGS)
def test_a_chart_that_is_zoomed_to_all_of_itself_shows_the_same(setting):
    operation = operation_of(State(**setting))
    for key in ("load-frequency", "campbell"):
        whole = whirl_chart(key, operation, "both")
        view = View(*whole.x_range, *whole.y_range)
        seen = whirl_chart(key, operation, "both", view)
        assert {layer.label for layer in seen.layers} == {layer.label for layer in whole.layers}
        names = [set(chart.layer("whirl").columns["name"]) for chart in (whole, seen)]
        assert names[0] == names[1]


def test_a_zoom_beyond_the_chart_ends_before_the_pole_and_at_rest():
    operation = operation_of(State())
    loads, speeds = (
        whirl_bounds(whirl_chart(key, operation, "linear"), operation)
        for key in ("load-frequency", "campbell")
    )
    assert speeds.left == 0.0
    whirl_chart("load-frequency", operation, "exact", loads)  # no error at its right end
    # where the pole of another rotor lies below what is seen, the chart is empty there
    far = View(loads.right + 1, loads.right + 2, 0.0, 1.0)
    assert whirl_chart("load-frequency", operation, "exact", far).x_range == far.x
