"""The errors of reduced rotors, as `Rotor.system` states them."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import eigh

from rotorstab import PRESETS, AxialLoad, growth_rate, resonances, whirl_frequencies
from tests.testing.rotors import FRISWELL_597, FRISWELL_599, FRISWELL_681, OIL_FILM, UNEQUAL, rpm

# as stated in the docstring of `rotor_system`
LARGEST_ERROR = {4: 5e-3, 6: 3e-3, 8: 5e-4, 10: 5e-5}


def whirl_error(rotor, modes):
    """Return the largest error of the `modes` slowest whirls of each plane."""
    buckling = rotor.critical_load()
    count = modes * (1 if rotor.is_isotropic else 2)
    resting = rotor.system(0.0)
    slowest = np.abs(whirl_frequencies(resting, 0.0)).min()
    worst = 0.0
    for speed in (0.0, slowest, 3 * slowest):
        full, reduced = (rotor.system(speed, modes=given) for given in (None, modes))
        for load in np.linspace(-0.9, 0.9, 5) * buckling:
            whirl, ours = (whirl_frequencies(one, load) for one in (full, reduced))
            whirl = whirl[np.argsort(np.abs(whirl))][:count]
            distance = np.abs(whirl[:, None] - ours).min(axis=1)
            worst = max(worst, (distance / np.maximum(np.abs(whirl), 0.1 * slowest)).max())
    return worst


@pytest.mark.parametrize(
    "rotor",
    [FRISWELL_597, FRISWELL_599, FRISWELL_681, UNEQUAL, OIL_FILM],
    ids=["two disks", "overhung", "thin", "unequal", "oil film"],
)
@pytest.mark.parametrize("modes", LARGEST_ERROR)
def test_errors_are_as_stated(rotor, modes):
    assert whirl_error(rotor, modes) < LARGEST_ERROR[modes]


def test_a_follower_load_needs_more_modes():
    rotor = replace(FRISWELL_599, load=AxialLoad(tangency=1.0))
    axial = FRISWELL_599.critical_load()
    full, *reduced = (rotor.system(rpm(1000), modes=modes) for modes in (None, 6, 10))
    whirl, *others = (whirl_frequencies(one, 0.8 * axial) for one in (full, *reduced))
    slow = np.abs(whirl) < 700
    errors = [np.abs(whirl[slow, None] - ours).min(axis=1).max() for ours in others]
    assert errors[0] < 0.5
    assert errors[1] < 1e-3


def test_growth_in_a_tongue_of_the_reduced_rotor():
    buckling = FRISWELL_599.critical_load()
    growths = []
    for modes in (None, 6):
        system = FRISWELL_599.system(rpm(4000), modes=modes)
        tongue = resonances(system, 0.3 * buckling, 0.1 * buckling)["1B+1F"]
        assert tongue.centre / math.tau == pytest.approx(24.3519, abs=2e-4)
        growths.append(growth_rate(system, 0.3 * buckling, 0.1 * buckling, tongue.centre))
    assert growths[1] == pytest.approx(growths[0], rel=1e-4)


@pytest.mark.parametrize("rotor", [FRISWELL_597, UNEQUAL, PRESETS["cantilever"]])
def test_shapes_of_reduced_coordinates_are_those_of_the_rotor(rotor):
    """The first mode at rest, drawn from the full and from the reduced system."""
    drawn = []
    for modes in (None, 8):
        system, shapes = rotor.system(0.0, modes=modes), rotor.shapes(modes=modes)
        assert shapes.deflection.shape == (len(shapes.positions), system.size)
        half = system.size // (2 if system.planes else 1)
        part = slice(system.size - half, system.size)  # the softer plane, W
        mode = eigh(system.elastic[part, part], system.mass[part, part])[1][:, 0]
        deflection, slope = (one[:, part] @ mode for one in (shapes.deflection, shapes.slope))
        largest = deflection[np.abs(deflection).argmax()]
        drawn.append((deflection / largest, slope / largest))
        assert np.all(shapes.deflection[shapes.positions == 0.0] == 0) == bool(rotor.clamps)
    for full, reduced in zip(*drawn, strict=True):
        assert reduced == pytest.approx(full, abs=2e-3 * np.abs(full).max())
    # the slope of the drawing is that of the section, but for a little shear
    change = np.gradient(drawn[0][0], shapes.positions)[1:-1]
    assert change == pytest.approx(drawn[0][1][1:-1], abs=0.1 * np.abs(change).max())


def test_every_speed_and_load_has_the_same_basis():
    slow, fast = (UNEQUAL.system(speed, modes=3) for speed in (0.0, 500.0))
    for name in ("mass", "gyroscopic", "elastic", "geometric"):
        assert np.array_equal(getattr(slow, name), getattr(fast, name))
