"""The work of the dearest states that are known, counted: one link must not hold up a class.

`python -m benchmarks cost` looks for others.
"""

import numpy as np
import pytest

from app.results import analysis, limits, window
from app.results.limits import Detail
from app.state import State
from app.state.address import from_arguments
from rotorstab import ShaftDisk, lumped
from rotorstab.floquet.interpolant.sampling import NodeSampler
from rotorstab.model import stiffness, stiffness_law

# took 20 s and 4.7 GB: the harmonics of 1,300 loads at 4,096 points each
HARMONICS = (
    "load=follower&as=0.000851999283879&spin=4&phi=0&md=20&id=0.0108993046789&ip=2.91807107612"
    "&ref=flutter&bmax=1.46201918664&law=exact&fmax=16"
)
# maps whose highest row comes near the pole: the steps are those of its stiffness there
STEPS = (
    "load=follower&as=0.5&spin=1&phi=0&md=20&id=0.03&ip=0&ref=flutter&bmax=1.5&law=exact&fmax=16",
    "as=0.9&spin=0&phi=0.1&md=0.5&id=0.03&ip=0&ref=flutter&bmax=0.118&law=exact&fmax=16",
)
MOST_EVALUATIONS, MOST_TOGETHER = 400_000, 1 << 16


def state_of(query):
    values, doubtful = from_arguments(
        {key: [value] for key, _, value in (pair.partition("=") for pair in query.split("&"))}
    )
    state = State()
    assert (doubtful, state.change(values)) == ([], {})
    return state


@pytest.fixture
def evaluations(monkeypatch):
    """The sizes of the arrays of loads at which the exact stiffness is evaluated."""
    sizes = []
    exact = stiffness.exact_stiffness

    def count(load, *others, **named):
        sizes.append(np.size(load))
        return exact(load, *others, **named)

    for module in (stiffness, stiffness_law):
        monkeypatch.setattr(module, "exact_stiffness", count)
    return sizes


@pytest.fixture
def work(monkeypatch):
    """The nodes times steps of the panels that are sampled."""
    spent = []
    sample = NodeSampler.sample

    def count(self, panel, periods):
        spent.append(panel.work)
        return sample(self, panel, periods)

    monkeypatch.setattr(NodeSampler, "sample", count)
    return spent


@pytest.mark.parametrize("query", [HARMONICS, *STEPS])
def test_a_picture_takes_a_bounded_amount_of_work(query, evaluations, work):
    state = state_of(query)
    state.static_load_factor *= 1 - 1e-6  # another test may have solved the state itself
    analysis.solve(state, detail=Detail.COARSE)
    assert 0 < sum(evaluations) <= MOST_EVALUATIONS
    assert max(evaluations) <= MOST_TOGETHER
    assert 0 < sum(work) <= limits.MOST_NODES[Detail.COARSE]


def test_the_work_of_a_full_map_is_bounded_too(work):
    window.floquet_map(analysis.window_of(state_of(STEPS[0])), Detail.FULL)
    assert 0 < sum(work) <= limits.MOST_NODES[Detail.FULL]


def test_harmonics_of_many_loads_are_made_in_batches(evaluations):
    system = lumped(ShaftDisk(), 1.0, stiffness="exact")
    pole = system.pole
    pulsating = np.linspace(0.0, pole * (1 - 1e-9), 20_000)
    mean, first = system.load_harmonics(0.0, pulsating)
    assert mean.shape == first.shape == (20_000, 2, 2)
    assert max(evaluations) <= MOST_TOGETHER
    assert sum(evaluations) <= 100 * pulsating.size
    some = [0, 7, 1234, 19_999]
    alone = system.load_harmonics(0.0, pulsating[some])
    np.testing.assert_allclose(mean[some], alone[0], rtol=1e-9)
    np.testing.assert_allclose(first[some], alone[1], rtol=1e-9, atol=1e-12)
