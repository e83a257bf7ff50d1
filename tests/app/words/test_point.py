"""The sentence at a marked point."""

import math
import re

import pytest

from app.words.point import point_sentence
from rotorstab import (
    BASE_CASE,
    critical_load,
    floquet_solution,
    fundamental_frequency,
    growth_rate,
    lumped,
    resonances,
)


def sentence(frequency, factor, static=0.5, damping=0.0, tangency=0.0):
    """The sentence at θ/ω_n and β_d, and the growth in a period."""
    reference = float(critical_load(BASE_CASE.shear))
    system = lumped(BASE_CASE, 2.0, tangency, damping)
    excitation = frequency * fundamental_frequency(system)
    point = static * reference, factor * reference, excitation
    growth = float(growth_rate(system, *point)) * 2 * math.pi / excitation
    table = resonances(system, point[0], 0.1 * reference)
    return point_sentence(floquet_solution(system, *point), excitation, table), growth


def test_unstable_says_how_fast_and_in_which_tongue():
    words, growth = sentence(1.68, 0.17)
    found = re.fullmatch(
        r"Unstable: the whirl doubles every ([\d.]+) periods of the load\. Tongue 1B\+1F\.", words
    )
    assert float(found[1]) == pytest.approx(math.log(2) / growth, rel=0.05)
    assert sentence(4.0, 0.3)[0].endswith("Tongue 2B+1F.")


def test_a_tongue_of_higher_order_is_named_with_its_order():
    # the second-order tongue lies a little beside half of 1.677
    found = {sentence(0.78 + 0.005 * k, 0.6)[0].partition(". ")[2] for k in range(20)}
    assert "Tongue 1B+1F of order 2." in found


def test_stable_neither_grows_nor_decays():
    assert sentence(3.0, 0.5)[0] == "Stable: the whirl neither grows nor decays."


def test_damping_halves():
    words, growth = sentence(3.0, 0.1, damping=0.02)
    found = re.fullmatch(r"Stable: the whirl halves every ([\d.]+) periods of the load\.", words)
    assert float(found[1]) == pytest.approx(math.log(2) / -growth, rel=0.05)


def test_a_rotor_that_is_unstable_by_itself_is_told_as_such():
    words, growth = sentence(1.68, 0.1, static=8.5, tangency=1.0)
    assert growth > 0
    assert words.startswith("Unstable, even without pulsation: the whirl doubles every ")
    assert "Tongue" not in words
