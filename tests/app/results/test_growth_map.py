"""The growth map of the page against single points: its errors, verdicts and shares."""

import numpy as np
import pytest

from app.results.analysis import solve, window_of
from app.results.growth_maps import known_map
from app.results.limits import Detail
from app.results.window import floquet_map
from app.state import State
from rotorstab import floquet_solution

# shares by independent integration at random points, and how far those may be off
SHARES = [
    ({"spin_speed": 0.0, "internal_damping": 0.2, "highest_frequency": 4.0}, 0.0755, 0.004),
    (
        {
            "diametral_inertia": 0.05,
            "polar_inertia": 0.1,
            "internal_damping": 0.02,
            "spin_speed": 0.5,
            "highest_frequency": 16.0,
        },
        0.099,
        0.006,
    ),
    (
        {
            "spin_speed": 0.0,
            "load_type": "follower",
            "static_load_factor": 0.0,
            "highest_frequency": 16.0,
        },
        0.054,
        0.002,
    ),
    # of the part above θ/ω_n = 0.46; the thin tongues of fast whirls are lines without an area
    ({"spin_speed": 1.0, "model": "finite elements", "highest_frequency": 16.0}, 0.0743, 0.01),
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
    """Growth at single points."""
    operation = window.operation
    return floquet_solution(operation.system, operation.static_load, loads, frequencies)


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


# a rotor whose modes decay to almost nothing within a period, and do not whirl
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
    """No error bound is too small; at most one verdict is wrong, and only where growth is small."""
    overdamped = kind == "overdamped"
    state = State(**OVERDAMPED) if overdamped else random_state(seed, **KINDS[kind])
    window = window_of(state)
    made = floquet_map(window, detail).growth
    known = np.isfinite(made.growth)
    assert known.mean() > 0.8
    i, j = np.nonzero(known)
    some = np.random.default_rng(seed).choice(len(i), 60)
    i, j = i[some], j[some]
    true = true_growth(window, made.pulsating_loads[i], made.excitation_frequencies[j])
    growth = true.growth_rate
    assert (np.abs(made.growth[i, j] - growth) <= made.error[i, j] + true.error).all()
    wrong = made.unstable[i, j] != true.unstable
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
    (_, high), (_, top) = window.frequencies, window.loads
    theta = rng.uniform(max(known.min(), 0.02 * high), high, count)
    share = true_growth(window, rng.uniform(0, top, count), theta).unstable.mean()
    slack = 4 * np.sqrt((share * (1 - share) + 0.01) / count)
    assert abs(solve(state, Detail.FULL).floquet.unstable_share - share) < slack
