"""The claimed error of a growth rate: never below the true one, and near enough to decide by."""

import numpy as np
import pytest

from app.results.analysis import solve, window_of
from app.results.growth_maps import known_map
from app.results.limits import Detail
from app.results.window import floquet_map
from app.state import State
from rotorstab.floquet.interpolant.growth import largest_modulus, self_inversive_growth
from rotorstab.floquet.interpolant.matrix_growth import matrix_growth, reversed_growth
from rotorstab.floquet.point import floquet_solution

# shares by independent integration at random points, and how far those may be off
SHARES = [
    ({"spin_speed": 0.0, "internal_damping": 0.2, "highest_frequency": 4.0}, 0.0755, 0.004),
    (
        {
            "diametral_inertia": 0.05,
            "polar_inertia": 0.1,
            "internal_damping": 0.02,
            "spin_speed": 0.5,
        },
        0.099,
        0.006,
    ),
    ({"spin_speed": 0.0, "load_type": "follower", "static_load_factor": 0.0}, 0.054, 0.002),
    ({"spin_speed": 1.0, "model": "finite elements"}, 0.086, 0.004),
]


def random_state(seed, **options):
    """A state of the page anywhere within its sliders."""
    rng = np.random.default_rng(seed)
    inertia = 10 ** rng.uniform(-2, np.log10(3))
    return State(
        load_type=("axial", "partly", "follower")[rng.integers(3)],
        tangency=rng.uniform(),
        static_load_factor=rng.uniform(0, 0.95),
        spin_speed=rng.uniform(0, 4) * rng.integers(2),
        shear=rng.uniform(0, 0.1),
        disk_mass=rng.uniform(0.5, 20),
        diametral_inertia=float(inertia),
        polar_inertia=float(min(6, inertia * rng.uniform(0, 2))),
        highest_frequency=(4.0, 8.0, 16.0)[rng.integers(3)],
        **options,
    )


def true_growth(window, loads, frequencies):
    """Growth and its error, point by point."""
    system = window.model.system(window.spin_speed, window.tangency)
    solution = floquet_solution(system, window.static_load, loads, frequencies)
    return solution.growth_rate, solution.error


DAMPING = {"internal_damping": 0.003, "external_damping": 0.02}
KINDS = {
    "undamped": {},
    "damped": DAMPING,
    "rotating damping": {"internal_damping": 0.15},
    "exact": {"law": "exact"},
    "finite elements": {"model": "finite elements"},
    "finite elements, damped": {"model": "finite elements", **DAMPING},
}


@pytest.mark.parametrize(("inputs", "share", "slack"), SHARES)
def test_the_page_says_the_true_share(inputs, share, slack):
    answer = solve(State(**inputs), Detail.FULL).floquet
    assert answer.unstable_share == pytest.approx(share, abs=slack)


# modes that fall to nothing within a period, and do not whirl
OVERDAMPED = {
    "spin_speed": 0.0,
    "disk_mass": 0.5,
    "diametral_inertia": 0.01,
    "polar_inertia": 6.0,
    "static_load_factor": 0.95,
    "shear": 0.1,
    "largest_factor": 2.0,
    "law": "exact",
    "external_damping": 0.2,
    "internal_damping": 0.2,
}


@pytest.mark.parametrize("detail", [Detail.COARSE, Detail.FULL])
@pytest.mark.parametrize("kind", [*KINDS, "overdamped"])
@pytest.mark.parametrize("seed", [0, pytest.param(1, marks=pytest.mark.long)])
def test_pixels_against_points(kind, seed, detail):
    """No claim is too small; hardly a verdict is wrong, and only of growth that is next to none."""
    overdamped = kind == "overdamped"
    state = State(**OVERDAMPED) if overdamped else random_state(seed, **KINDS[kind])
    window = window_of(state)
    made = floquet_map(window, detail).growth
    known = np.isfinite(made.growth)
    assert known.mean() > 0.8
    i, j = np.nonzero(known)
    some = np.random.default_rng(seed).choice(len(i), 60)
    i, j = i[some], j[some]
    growth, error = true_growth(window, made.pulsating_loads[i], made.excitation_frequencies[j])
    assert (np.abs(made.growth[i, j] - growth) <= made.error[i, j] + error).all()
    wrong = made.unstable[i, j] != (growth > np.maximum(1e-8, error))
    assert not (wrong & (np.abs(growth) > 1e-3)).any()
    assert wrong.sum() <= 1


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", [10])
def test_shares_against_random_points(kind, seed):
    """The share on the page is that of random points, to four standard deviations."""
    state = random_state(seed, **KINDS[kind])
    window = window_of(state)
    made = known_map(window, Detail.FULL).growth
    known = made.excitation_frequencies[np.isfinite(made.growth).any(axis=0)]
    rng, count = np.random.default_rng(seed), 200
    theta = rng.uniform(max(known.min(), 0.02 * window.high), window.high, count)
    growth, error = true_growth(window, rng.uniform(0, window.top, count), theta)
    share = (growth > np.maximum(1e-8, error)).mean()
    slack = 4 * np.sqrt((share * (1 - share) + 0.01) / count)
    assert abs(solve(state, Detail.FULL).floquet.unstable_share - share) < slack


@pytest.mark.parametrize("seed", range(5))
def test_quartics_moved_by_their_errors(seed):
    """Roots of a perturbed quartic stay within the claim, double roots and damped ones too."""
    rng = np.random.default_rng(seed)
    count = 4000
    mu = np.exp(rng.uniform(-30, 0, (4, count)) * rng.integers(0, 2, (4, count)))
    mu = mu * np.exp(1j * rng.uniform(0, 2 * np.pi, (4, count)))
    mu[1] = np.where(rng.uniform(size=count) < 0.5, mu[1], mu[0] * (1 + 1e-4 * mu[2]))
    powers = np.array([np.poly(one) for one in mu.T]).T
    signs = np.array([-1, 1, -1]).reshape(3, 1)
    coefficients, last = signs * powers[1:4], powers[4].real
    last = np.abs(powers[4])
    turn = np.exp(-0.25j * np.angle(powers[4]))
    mu, coefficients = mu * turn, coefficients * turn ** np.arange(1, 4).reshape(3, 1)
    error = 10 ** rng.uniform(-12, -1, (3, count))
    moved = coefficients + error * np.exp(2j * np.pi * rng.uniform(size=(3, count)))
    growth, claim, _ = largest_modulus(moved, last, error)
    exact = np.log(np.abs(mu)).max(axis=0)
    assert (np.abs(growth - exact) <= claim + 1e-7).all()
    # and the claims are not idle
    assert np.median(claim / error.max(axis=0)) < 100


@pytest.mark.parametrize("seed", range(3))
def test_eigenvalues_moved_by_their_errors(seed):
    """As above for matrices, by the complex eigenproblem and by the real one of half a period."""
    rng = np.random.default_rng(seed)
    count, size = 400, 6

    def normal(*shape):
        return rng.normal(size=shape) + 1j * rng.normal(size=shape)

    # R and S with eigenvalues t real, nearly double or complex; conj(Y)⁻¹Y has the multipliers
    t = rng.normal(size=(count, size)) + 0j
    t[::4, 0] = t[::4, 1] + 10 ** rng.uniform(-7, -2, len(t[::4]))
    t[1::4, 0] = t[1::4, 1].conj() + 1j * 10 ** rng.uniform(-5, 0, len(t[1::4]))
    t[1::4, 1] = t[1::4, 0].conj()
    basis = rng.normal(size=(count, size, size)) + 0j
    basis[1::4, :, 0] += 1j * basis[1::4, :, 1]
    basis[1::4, :, 1] = basis[1::4, :, 0].conj()
    operator = (basis * t[:, None]) @ np.linalg.inv(basis)
    half = rng.normal(size=(count, size, size)) @ (np.eye(size) + 1j * operator.real)
    exact = np.log(np.abs((1 + 1j * t) / (1 - 1j * t))).max(axis=1)
    error = 10 ** rng.uniform(-12, -5, (count, 1, 1)) * rng.uniform(size=half.shape)
    moved = half + error * np.exp(2j * np.pi * rng.uniform(size=half.shape))
    growth, claim = reversed_growth(moved, error)
    assert (np.abs(growth - exact) <= claim + 1e-9).all()
    assert (claim == 0).mean() > 0.3

    values = np.exp(1j * normal(count, size))
    values[::2, 0] = values[::2, 1] * (1 + 1e-6 * normal(count // 2))
    basis = normal(count, size, size)
    monodromy = (basis * values[:, None]) @ np.linalg.inv(basis)
    moved = monodromy + error * np.exp(2j * np.pi * rng.uniform(size=half.shape))
    growth, claim = matrix_growth(moved, error)
    exact = np.log(np.abs(values)).max(axis=1)
    assert (np.abs(growth - exact) <= claim + 1e-9).all()
    moved[0, 0, 0] = np.nan
    lost = matrix_growth(moved, error)[0]
    assert np.isnan(lost[0])
    np.testing.assert_allclose(lost[1:], growth[1:])


@pytest.mark.parametrize("growth", [2.0, 6.0, 9.5, 14.0])
def test_two_pairs_that_grow_alike(growth):
    """Two pairs e^{±jα/2}(u, 1/u) with growth of the same size: as near as the quartic tells."""
    rng = np.random.default_rng(3)
    count = 2000
    first = growth + rng.uniform(0, 0.5, count)
    second = growth + rng.uniform(0, 0.5, count)
    half = np.where(rng.uniform(size=count) < 0.5, 0.0, rng.uniform(0, np.pi / 2, count))
    second = np.where(half == 0, second, first)
    pairs = 2 * np.cosh([first, second])
    middle = np.exp(1j * half) * pairs[0] + np.exp(-1j * half) * pairs[1]
    coefficients = np.array([middle.real, middle.imag, 2 * np.cos(2 * half) + pairs[0] * pairs[1]])
    error = 1e-14 * np.array([np.abs(middle), np.abs(middle), np.abs(coefficients[2])])
    found, uncertainty, _ = self_inversive_growth(coefficients, error)
    off = np.abs(found - np.maximum(first, second))
    assert off.max() < 1e-4  # rounding, at nearly double multipliers
    assert (off <= uncertainty + 1e-9).mean() > 0.9
    assert np.median(off) < 1e-12
