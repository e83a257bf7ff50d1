"""Every preset can be analysed as it stands, and its file gives it back."""

import math

import numpy as np
import pytest

from rotorstab import PRESETS, growth_rate, whirl_frequencies
from rotorstab.rotors.rotor_file import rotor_from_toml, rotor_to_toml


@pytest.mark.parametrize("name", PRESETS)
def test_a_preset_buckles_whirls_and_is_stable_without_load(name):
    rotor = PRESETS[name]
    buckling = rotor.critical_load()
    assert 0 < buckling < math.inf
    system = rotor.system(50.0, modes=4)
    whirl = whirl_frequencies(system, 0.0)
    assert (np.abs(whirl) > 0).all()
    assert growth_rate(system, 0.0, 0.0, 100.0) <= 1e-6 * np.abs(whirl).max()
    # the load that buckles it makes one stiffness zero
    resting = rotor.system(0.0)
    smallest = np.linalg.eigvals(
        np.linalg.solve(resting.elastic, resting.load_stiffness(buckling))
    ).real.min()
    assert abs(smallest) < 1e-6


@pytest.mark.parametrize("name", PRESETS)
def test_a_preset_is_the_rotor_of_its_file(name):
    assert rotor_from_toml(rotor_to_toml(PRESETS[name])) == PRESETS[name]
