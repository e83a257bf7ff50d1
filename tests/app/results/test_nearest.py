"""The resonance that the page names for a marked point."""

from itertools import pairwise

import numpy as np
import pytest

from app.results.nearest import nearest_pair, nearest_resonance
from rotorstab import BASE_CASE, finite_element, lumped, resonances
from tests.testing.example_rotors import P

TABLE = resonances(lumped(BASE_CASE, 2.0), 0.5 * P, 0.1 * P)


@pytest.mark.parametrize("row", TABLE.rows, ids=lambda row: row.name)
def test_at_its_centre_every_pair_is_the_nearest_one(row):
    pair = nearest_pair(TABLE, row.centre)
    assert pair.name == row.name
    assert pair.centre == pytest.approx(row.centre)
    assert pair.threshold == row.threshold
    assert pair.frequencies[0] < pair.frequencies[1]
    assert set(pair.modes) == {row.first, row.second}


def test_between_two_centres_the_nearer_one_counts():
    centres = np.sort([row.centre for row in TABLE])
    for low, high in pairwise(centres):
        for share, nearer in ((0.45, low), (0.55, high)):
            found = nearest_resonance(TABLE, low + share * (high - low))
            assert found.centre == nearer


def test_only_first_and_second_modes_are_named():
    table = resonances(finite_element(BASE_CASE, 2.0, modes=4), 0.5 * P, 0.1 * P)
    highest = max(row.centre for row in table)
    assert set(nearest_pair(table, highest).modes) <= {"1B", "1F", "2B", "2F"}
    assert nearest_resonance(table, highest).centre == highest


def test_without_resonances_there_is_no_nearest_one():
    assert nearest_resonance((), 1.0) is None
