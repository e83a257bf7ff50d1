"""The charts of the influence coefficients and of the linear law's errors."""

import numpy as np
import pytest

from rotorstab import critical_load
from rotorstab.charts.stiffness import stiffness_charts

NAME = 0.08  # of a chart's height: a line of text of 16 pixels on 200


@pytest.mark.parametrize("shear", [0.0, 0.0192, 0.05, 0.1])
@pytest.mark.parametrize("reach", [0.5, 1.0, 2.0, 5.2, None])
def test_no_name_on_the_error_chart_is_crossed_by_the_line_of_a_level(shear, reach):
    """Its errors and levels are in per cent."""
    largest = (reach or 0.0) * float(critical_load(shear))
    errors = stiffness_charts(shear, 0.0, (-largest, largest) if reach else None)[-1]
    bottom, top = errors.y_range
    height = NAME * (top - bottom)
    levels = [y[0] for y, role in _lines(errors) if role == "level"]
    assert levels == [1.0, 5.0]
    names = errors.layer("names").columns
    for y, side in zip(names["y"], names["side"], strict=True):
        low, high = (y - height, y) if side == "lower left" else (y, y + height)
        assert bottom <= low
        assert high <= top + height / 2
        assert not [level for level in levels if low < level < high]


@pytest.mark.parametrize("tangency", [0.0, 0.5, 1.0])
def test_the_laws_part_before_the_usual_range_ends(tangency):
    """The charts of the paper's rotor show the difference of the laws."""
    for chart in stiffness_charts(0.0192, tangency)[:-1]:
        low, high = chart.y_range
        exact, linear = (curve.y for curve in chart.curves("lines"))
        seen = (exact > low) & (exact < high)
        assert np.abs(exact - linear)[seen].max() > 0.05 * (high - low), chart.key


def _lines(chart):
    columns = chart.layer("errors").columns
    return zip(columns["ys"], columns["role"], strict=True)
