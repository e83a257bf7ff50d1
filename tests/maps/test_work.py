"""How many columns of a chart a given amount of work suffices for."""

import numpy as np
import pytest

from rotorstab import BASE_CASE, lumped
from rotorstab.floquet.interpolant.chart_panels import chart_panels
from rotorstab.floquet.interpolant.sampling import NodeSampler
from rotorstab.maps.work import columns_within_work
from tests.testing.example_rotors import P, W

SYSTEM = lumped(BASE_CASE, 2.0)
FREQUENCIES = np.linspace(0.2, 6, 30) * W


def work_of(frequencies):
    sampler = NodeSampler(SYSTEM, 0.5 * P, P)
    panels = chart_panels(sampler, np.sort(2 * np.pi / frequencies), 0.6)
    return sum(panel.work for panel in panels)


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
def test_the_fastest_loads_are_kept_as_long_as_the_work_suffices(share):
    most = share * work_of(FREQUENCIES)
    shuffled = np.random.default_rng(1).permutation(FREQUENCIES)
    kept = columns_within_work(SYSTEM, 0.5 * P, P, shuffled, 0.6, most)
    assert 0 < kept.sum() < len(FREQUENCIES)
    assert shuffled[kept].min() > shuffled[~kept].max()
    assert work_of(shuffled[kept]) <= most
    next_one = shuffled[~kept].max()
    assert work_of(np.append(shuffled[kept], next_one)) > most


def test_enough_work_keeps_all_columns_and_none_keeps_none():
    assert columns_within_work(SYSTEM, 0.5 * P, P, FREQUENCIES, 0.6, np.inf).all()
    assert not columns_within_work(SYSTEM, 0.5 * P, P, FREQUENCIES, 0.6, 0.0).any()
