"""The errors of reduced finite elements, and what a reduction keeps exactly."""

import numpy as np
import pytest

from benchmarks.bench_finite_element import random_cases, slowest_whirls, whirl_errors
from rotorstab import (
    BASE_CASE,
    TABLE_1_SI,
    ShaftDisk,
    boundary_frequencies,
    critical_load,
    finite_element,
    whirl_frequencies,
)

BARE = {"disk_mass": 0.0, "diametral_inertia": 0.0, "polar_inertia": 0.0}
BEAM = ShaftDisk(shear=0.0, slenderness=0.0, **BARE)
TABLE_1, _ = ShaftDisk.from_si(**TABLE_1_SI)


# as stated in the docstring of `finite_element`
LARGEST_ERROR = {3: 1e-2, 4: 1.5e-3, 5: 1e-3, 6: 5e-4, 8: 5e-5}
USUAL_ERROR = {3: 3e-3, 4: 5e-4, 5: 2e-4, 6: 5e-5, 8: 3e-6}


@pytest.mark.parametrize("rigid", [True, False])
def test_reduction_error_over_the_ranges_of_the_sliders_is_as_stated(rigid):
    cases = random_cases(25, seed=12, rigid=rigid)
    for modes, errors in whirl_errors(cases, tuple(LARGEST_ERROR)).items():
        assert len(errors) > 60
        assert errors.max() < LARGEST_ERROR[modes]
        assert np.quantile(errors, 0.95) < USUAL_ERROR[modes]


@pytest.mark.parametrize(("modes", "stated"), [(4, 5e-5), (6, 5e-7)])
def test_reduction_error_of_bolotin_boundaries(modes, stated):
    worst = 0.0
    for rotor in (BASE_CASE, TABLE_1):
        buckling = float(critical_load(rotor.shear))
        pulsating = np.array([0.0, 0.4, 0.8]) * buckling
        for tangency in (0.0, 1.0):
            for spin in (0.0, 2.0):
                full, reduced = (
                    boundary_frequencies(
                        finite_element(rotor, spin, tangency, modes=count),
                        0.5 * buckling,
                        pulsating,
                    )[:, :4]
                    for count in (None, modes)
                )
                worst = max(worst, np.abs(reduced / full - 1).max())
    assert stated / 10 < worst < stated


def test_the_tip_is_first_in_reduced_coordinates():
    full = finite_element(BASE_CASE, 0.0)
    for modes in (2, 4, 6, 12):
        reduced = finite_element(BASE_CASE, 0.0, modes=modes)
        for force in np.eye(2):
            wanted = np.linalg.solve(full.elastic, np.r_[np.zeros(38), force])[-2:]
            ours = np.linalg.solve(reduced.elastic, np.r_[force, np.zeros(modes - 2)])[:2]
            assert ours == pytest.approx(wanted, rel=1e-3)


@pytest.mark.parametrize(
    "rotor",
    [
        ShaftDisk(
            shear=0.3, disk_mass=2.0, diametral_inertia=0.3, polar_inertia=0.6, slenderness=0.3
        ),
        ShaftDisk(
            shear=0.9, disk_mass=1.0, diametral_inertia=0.5, polar_inertia=1.0, slenderness=0.9
        ),
        BEAM,
    ],
    ids=["stocky", "extreme", "beam"],
)
def test_six_modes_serve_any_rotor(rotor):
    buckling = float(critical_load(rotor.shear))
    for tangency, loads in ((0.0, (-1.0, 0.0, 0.9)), (1.0, (-1.0, 0.5))):
        for spin in (0.0, 2.0):
            full = finite_element(rotor, spin, tangency)
            reduced = finite_element(rotor, spin, tangency, modes=6)
            for load in loads:
                wanted = slowest_whirls(full, load * buckling)
                assert slowest_whirls(reduced, load * buckling) == pytest.approx(wanted, rel=1e-3)


def test_one_element_can_only_be_reduced_to_itself():
    full, same = (finite_element(BASE_CASE, 1.0, elements=1, modes=modes) for modes in (None, 2))
    assert same.mass == pytest.approx(full.mass)
    assert same.geometric == pytest.approx(full.geometric)


def test_all_modes_reproduce_the_full_model():
    full = finite_element(BASE_CASE, 2.0, 1.0, elements=4)
    same = finite_element(BASE_CASE, 2.0, 1.0, elements=4, modes=8)
    assert whirl_frequencies(same, 1.5) == pytest.approx(whirl_frequencies(full, 1.5), rel=1e-8)
