"""The window of a growth map: what is drawn in it, and what is left out."""

import numpy as np
import pytest

from app.results.analysis import solve
from app.results.limits import Detail
from app.results.model import Model, Operation
from app.results.views import View
from app.results.window import Window, floquet_map
from app.state import State
from rotorstab import BASE_CASE, ShaftDisk
from tests.testing.example_rotors import P, W


def window(view, rotor=BASE_CASE, **options):
    """The base case or another rotor at Ω̄ = 2 and half of the buckling load."""
    return Window(Operation(Model(rotor, **options), 2.0, 0.0, 0.5 * P, P, W), View(*view))


@pytest.mark.parametrize("options", [{}, {"external_damping": 0.01}, {"law": "exact"}])
@pytest.mark.parametrize("detail", [Detail.COARSE, Detail.FULL])
def test_every_model_has_edges_while_it_moves_and_at_rest(options, detail):
    made = floquet_map(window((1.0, 3.0, 0.0, 1.0), **options), detail)
    edges = made.edges
    assert (edges.function > 0).any()
    assert np.isfinite(edges.across).sum() > 20
    assert edges.function.shape == made.rates.shape
    # the grid reaches the border of the window, and the map has the same growth at its pixels
    ends = edges.excitation_frequencies[[0, -1]], edges.pulsating_loads[[0, -1]]
    np.testing.assert_allclose(ends, [[W, 3 * W], [0.0, P]])
    row, column = (
        np.searchsorted(grid, pixels - 1e-9)
        for grid, pixels in (
            (edges.pulsating_loads, made.growth.pulsating_loads),
            (edges.excitation_frequencies, made.growth.excitation_frequencies),
        )
    )
    np.testing.assert_array_equal(made.rates[np.ix_(row, column)], made.growth.growth)


def test_a_window_of_larger_loads_has_edges_of_its_own():
    edges = floquet_map(window((1.0, 3.0, 0.6, 0.8)), Detail.COARSE).edges
    np.testing.assert_allclose(edges.pulsating_loads[[0, -1]], [0.6 * P, 0.8 * P])
    assert np.isfinite(edges.across).sum() > 20


def test_a_finer_map_holds_all_that_a_coarser_one_does():
    whole = window((0.0, 6.0, 0.0, 1.0))
    coarse, full = (floquet_map(whole, detail) for detail in Detail)
    assert coarse.growth.growth.size < full.growth.growth.size
    assert coarse.growth.refined == 0 < full.growth.refined
    # the slowest loads keep their errors: each of their pixels would take as long as thousands
    small = full.growth.excitation_frequencies < 0.1 * W
    known = np.isfinite(full.growth.growth)
    assert full.growth.error[:, ~small][known[:, ~small]].max() <= 1e-5
    assert known[:, small].any()


@pytest.mark.parametrize("options", [{}, {"kind": "finite elements"}])
def test_below_the_outlines_the_chart_says_that_it_is_not_drawn(options):
    whole = window((0.0, 6.0, 0.0, 1.0), **options)
    for detail in (Detail.COARSE, Detail.FULL):
        made = floquet_map(whole, detail)
        assert 0.1 * W < made.drawn_from < 0.9 * W
        assert made.edges.excitation_frequencies[0] == pytest.approx(made.drawn_from)
        for line in made.edges.thin:
            assert np.nanmin(line.excitation_frequencies) >= made.drawn_from
    zoomed = window((2.0, 3.0, 0.0, 1.0), **options)
    assert floquet_map(zoomed, Detail.COARSE).drawn_from == 0.0


def test_finite_elements_whose_whirls_cannot_be_separated_are_drawn_with_all_of_them():
    stout = ShaftDisk(shear=0.1, disk_mass=2.0, diametral_inertia=0.5, polar_inertia=1.0)
    part = window((1.0, 6.0, 0.0, 1.0), stout, kind="finite elements")
    made = floquet_map(part, Detail.COARSE)
    assert (made.edges.function > 0).any()
    assert made.growth.growth.shape == (16, 64)
    assert made.of_all_whirls


def test_the_chart_names_what_is_not_drawn():
    for state, detail, text in (
        (State(), Detail.COARSE, "computed at rest"),
        (State(), Detail.FULL, "not drawn: load too slow"),
    ):
        chart = solve(state, detail).charts["instability"]
        assert text in chart.layer("not computed").columns["name"]
        assert text in chart.layer("reason").columns["name"]
    whole = solve(State(lowest_frequency=1.0), Detail.COARSE).charts["instability"]
    assert not len(whole.layer("not computed").columns["name"])
