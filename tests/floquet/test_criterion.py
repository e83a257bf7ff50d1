"""What counts as unstable: the same answer for numbers, points and charts."""

import numpy as np

from rotorstab import BASE_CASE, floquet_solution, lumped, resonances, stability_chart
from rotorstab.floquet.criterion import is_unstable
from tests.testing.example_rotors import P, W


def test_growth_counts_above_its_error_and_above_rounding():
    growth = np.array([1e-9, 1e-7, 1e-7, -1.0, np.nan])
    error = np.array([0.0, 1e-9, 1e-6, 0.0, 1e-9])
    assert is_unstable(growth, error).tolist() == [False, True, False, False, False]


def test_points_and_charts_agree():
    system = lumped(BASE_CASE, 2.0)
    loads, theta = np.linspace(0, 1, 9) * P, np.linspace(1, 5, 17) * W
    points = floquet_solution(system, 0.5 * P, loads[:, None], theta)
    chart = stability_chart(system, 0.5 * P, loads, theta, find_narrow=False)
    assert (chart.unstable == points.unstable).all()


def test_the_nearest_resonance_prefers_a_low_order():
    table = resonances(lumped(BASE_CASE, 2.0), 0.5 * P, 0.1 * P)
    first = table["1B+1F"].centre
    for frequency, order in ((first, 1), (first / 2, 2), (first / 3, 3), (1.05 * first, 1)):
        row, found = table.nearest(frequency, 9)
        assert (row.name, found) == ("1B+1F", order)
    assert table.nearest(first / 3, 1)[1] == 1


def test_a_table_without_tongues_has_no_nearest_resonance():
    system = lumped(BASE_CASE, 2.0)
    rigid = type(system)(
        **{
            **{name: getattr(system, name) for name in system.__dataclass_fields__},
            "geometric": np.zeros((2, 2)),
            "tangency": 0.0,
        }
    )
    assert resonances(rigid, 0.0, 0.1).nearest(1.0, 9) is None
