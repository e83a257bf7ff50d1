"""The finite-element shaft against classical values, exact solutions and the lumped model."""

import numpy as np
import pytest

from rotorstab import (
    BASE_CASE,
    TABLE_1_SI,
    ShaftDisk,
    boundary_frequencies,
    campbell_diagram,
    critical_load,
    critical_speeds,
    finite_element,
    fundamental_frequency,
    linear_stiffness,
    load_frequency_curves,
    lumped,
    whirl_frequencies,
)

BARE = {"disk_mass": 0.0, "diametral_inertia": 0.0, "polar_inertia": 0.0}
BEAM = ShaftDisk(shear=0.0, slenderness=0.0, **BARE)
SHAFT = ShaftDisk(**BARE)
TABLE_1, _ = ShaftDisk.from_si(**TABLE_1_SI)
# roots of 1 + cos x cosh x = 0, squared
CANTILEVER = np.array([3.5160152685, 22.0344915647, 61.6972144135])


def natural_frequencies(system, load=0.0):
    squares = np.linalg.eigvals(np.linalg.solve(system.mass, system.load_stiffness(load)))
    return np.sqrt(np.sort(squares.real))


def lowest_four(system, load):
    """2B, 1B, 1F, 2F: the two nearest to 0 of each direction."""
    whirl = whirl_frequencies(system, load)
    assert np.abs(whirl.imag).max() < 1e-6 * np.abs(whirl).max()
    whirl = whirl.real
    return np.concatenate([whirl[whirl < 0][-2:], whirl[whirl > 0][:2]])


def test_cantilever_beam_has_the_classical_frequencies():
    ours = natural_frequencies(finite_element(BEAM, 0.0, elements=20))[:3]
    assert ours == pytest.approx(CANTILEVER, rel=2e-5)
    assert (ours > CANTILEVER).all()


@pytest.mark.parametrize(
    ("rotor", "order"), [(BEAM, 4), (SHAFT, 2), (BASE_CASE, 2)], ids=["beam", "shaft", "rotor"]
)
def test_frequencies_converge_with_the_mesh(rotor, order):
    meshes = (8, 16, 32)
    values = np.array(
        [natural_frequencies(finite_element(rotor, 0.0, elements=n))[:3] for n in meshes]
    )
    steps = -np.diff(values, axis=0)
    assert (steps > 0).all()
    assert np.log2(steps[0] / steps[1]) == pytest.approx(np.full(3, order), abs=0.25)


def test_mesh_error_at_twenty_elements_is_as_stated():
    worst = 0.0
    for spin in (0.0, 2.0, 5.0):
        twenty, forty, eighty = (
            lowest_four(finite_element(BASE_CASE, spin, elements=n), 0.0) for n in (20, 40, 80)
        )
        limit = (4 * eighty - forty) / 3
        worst = max(worst, np.abs(twenty / limit - 1).max())
    assert 6e-6 < worst < 1.2e-5


@pytest.mark.parametrize("shear", [0.0, 0.0192, 0.2])
def test_buckling_load_is_the_static_one_and_converges(shear):
    def smallest(elements):
        system = finite_element(ShaftDisk(shear=shear, **BARE), 0.0, elements=elements)
        inverse_loads = np.linalg.eigvals(-np.linalg.solve(system.elastic, system.geometric))
        return 1 / inverse_loads.real.max()

    errors = [smallest(elements) / critical_load(shear) - 1 for elements in (5, 10)]
    assert 0 < errors[1] < 2e-3
    assert np.log2(errors[0] / errors[1]) == pytest.approx(4 if shear == 0 else 2, abs=0.1)


def test_two_modes_are_the_lumped_model_with_the_mass_of_the_shaft():
    for tangency in (0.0, 1.0):
        elastic, geometric = linear_stiffness(BASE_CASE.shear, tangency)
        system = finite_element(BASE_CASE, 0.0, tangency, elements=1)
        assert system.elastic == pytest.approx(elastic, rel=1e-10)
        assert system.geometric == pytest.approx(geometric, rel=1e-10)
        reduced = finite_element(BASE_CASE, 0.0, tangency, elements=64, modes=2)
        assert reduced.elastic == pytest.approx(elastic, rel=1e-9)
        assert reduced.geometric == pytest.approx(geometric, rel=1e-3)
        # Hermite's consistent tip mass is 13/35
        beam = finite_element(BEAM, 0.0, modes=2)
        assert beam.mass[0, 0] == pytest.approx(13 / 35)


def test_matrices_are_symmetric_but_for_the_follower_term():
    system = finite_element(BASE_CASE, 1.0, 0.7, elements=4)
    for matrix in (system.mass, system.gyroscopic, system.elastic):
        assert matrix == pytest.approx(matrix.T, abs=1e-12)
    skew = system.geometric - system.geometric.T
    assert skew[-2, -1] == pytest.approx(0.7)
    skew[-2, -1] = skew[-1, -2] = 0
    assert np.abs(skew).max() < 1e-12
    assert np.linalg.eigvalsh(system.mass).min() > 0


def test_an_inclined_straight_shaft_has_the_energies_of_a_rod():
    """The motion v = x, γ = 1 (no bending, no shear) but for the clamped root's own rotation."""
    elements = 200
    system = finite_element(SHAFT, 1.0, elements=elements)
    motion = np.empty(2 * elements)
    motion[0::2] = np.arange(1, elements + 1) / elements
    motion[1::2] = 1.0
    rotary = SHAFT.slenderness**2
    for matrix, energy in (
        (system.mass, 1 / 3 + rotary),
        (system.gyroscopic, 2 * rotary),
        (system.geometric, -1.0),
    ):
        assert motion @ matrix @ motion == pytest.approx(energy, rel=1e-2)


def test_tip_flexibility_is_exact_on_one_element():
    system = finite_element(ShaftDisk(shear=0.1, **BARE), 0.0, elements=1)
    # L³/3EI + L/κGA, L²/2EI, L/EI
    assert np.linalg.inv(system.elastic) == pytest.approx(
        np.array([[1 / 3 + 0.1, 0.5], [0.5, 1.0]])
    )


def test_opposite_spin_swaps_forward_and_backward():
    forward = whirl_frequencies(finite_element(BASE_CASE, 2.0, 1.0, modes=5), 1.0).real
    backward = whirl_frequencies(finite_element(BASE_CASE, -2.0, 1.0, modes=5), 1.0).real
    assert forward == pytest.approx(-backward[::-1], rel=1e-9)


def test_spin_speeds_broadcast():
    speeds = np.array([0.0, 1.0, 2.0])
    together = whirl_frequencies(finite_element(BASE_CASE, speeds, modes=4), 0.5)
    for speed, row in zip(speeds, together, strict=True):
        alone = whirl_frequencies(finite_element(BASE_CASE, speed, modes=4), 0.5)
        assert row == pytest.approx(alone, abs=1e-9)


def test_damping_follows_its_own_fundamental_frequency():
    system = finite_element(BASE_CASE, 1.0, modes=4, external_damping=0.01, internal_damping=0.02)
    bare = finite_element(BASE_CASE, 1.0, modes=4)
    frequency = fundamental_frequency(bare)
    assert system.external_damping == pytest.approx(0.02 * frequency * bare.mass)
    assert system.internal_damping == pytest.approx(0.04 / frequency * bare.elastic)
    still = whirl_frequencies(system.at_speed(0.0), 0.0)
    first = still[np.abs(still).argmin()]
    assert first.imag / np.abs(first) == pytest.approx(0.03, rel=1e-6)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"elements": 0}, r"`elements` must be in \[1, 200\], got 0"),
        ({"elements": 2.5}, r"`elements` must be a whole number in \[1, 200\], got 2.5"),
        ({"modes": 1}, r"`modes` must be in \[2, 40\], got 1"),
        ({"modes": 41}, r"`modes` must be in \[2, 40\], got 41"),
        ({"tangency": -0.1}, r"`tangency` must be in \[0, 1\], got -0.1"),
        ({"internal_damping": -1.0}, r"`internal_damping` must be in \[0, 1e\+09\], got -1"),
        ({"external_damping": np.nan}, r"`external_damping` must be in \[0, 1e\+09\], got nan"),
        ({"spin_speed": np.inf}, r"`spin_speed` must be in \[-1e\+09, 1e\+09\], got inf"),
    ],
)
def test_bad_arguments_are_refused(change, message):
    with pytest.raises(ValueError, match=message):
        finite_element(**{"rotor": BASE_CASE, "spin_speed": 0.0, **change})


def test_a_heavy_disk_makes_the_lumped_model_right():
    """Against the disk the shaft's mass vanishes: one model's analyses against the other's."""
    rotor = ShaftDisk(shear=0.0192, disk_mass=5e3, diametral_inertia=8e2, polar_inertia=1.6e3)
    buckling = float(critical_load(rotor.shear))
    speed = 0.05
    for tangency in (0.0, 1.0):
        simple = lumped(rotor, speed, tangency, stiffness="exact")
        full = finite_element(rotor, speed, tangency, elements=40, modes=10)
        for load in (-buckling, 0.0, 0.5 * buckling):
            wanted = whirl_frequencies(simple, load).real
            assert lowest_four(full, load) == pytest.approx(wanted, rel=2e-3)
    still = boundary_frequencies(lumped(rotor, 0.0), 0.2 * buckling, 0.3 * buckling)
    ours = boundary_frequencies(
        finite_element(rotor, 0.0, modes=8), 0.2 * buckling, 0.3 * buckling
    )[:4]
    assert ours == pytest.approx(still, rel=5e-3)


def test_every_analysis_of_whirl_takes_the_finite_elements():
    system = finite_element(BASE_CASE, 1.0, modes=4)
    curves = load_frequency_curves(system, np.linspace(0.0, 1.0, 11))
    assert curves.frequencies.shape == (11, 8)
    assert curves.names[3:5] == ("1B", "1F")
    diagram = campbell_diagram(system, np.linspace(0.0, 2.0, 11))
    assert diagram.frequencies[5] == pytest.approx(curves.frequencies[0])
    backward = critical_speeds(system).backward
    whirl = whirl_frequencies(system.at_speed(backward[0]), 0.0).real
    assert np.abs(whirl + backward[0]).min() < 1e-8
