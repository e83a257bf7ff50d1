"""Empty input, and what the whirl functions refuse."""

import numpy as np
import pytest

import rotorstab as rs

BASE = rs.BASE_CASE
REFERENCE = 2.3557973  # p̄_cr of the base case


def test_empty_input_gives_empty_output():
    system = rs.lumped(BASE, 1.0)
    assert rs.whirl_frequencies(system, []).shape == (0, 4)
    assert rs.whirl_frequencies(rs.lumped(BASE, []), 1.0).shape == (0, 4)
    assert rs.whirl_frequencies(rs.lumped(BASE, [], external_damping=0.1), 1.0).shape == (0, 4)
    exact = rs.lumped(BASE, 1.0, stiffness="exact")
    assert rs.whirl_frequencies(exact, []).shape == (0, 4)
    assert rs.load_frequency_curves(system, []).frequencies.shape == (0, 4)
    assert rs.campbell_diagram(system, []).frequencies.shape == (0, 4)


@pytest.mark.parametrize("bad", [np.nan, np.inf, True, "1", 1j, None, [1.0, "a"]])
def test_bad_loads_are_refused(bad):
    system = rs.lumped(BASE, 1.0)
    message = r"`{}` must be (a real number )?in (\(-inf, inf\)|\[-1e\+12, 1e\+12\]), got"
    with pytest.raises(ValueError, match=message.format("load")):
        rs.whirl_frequencies(system, bad)
    with pytest.raises(ValueError, match=message.format("loads")):
        rs.load_frequency_curves(system, bad)
    with pytest.raises(ValueError, match=message.format("spin_speeds")):
        rs.campbell_diagram(system, bad)
    with pytest.raises(ValueError, match=message.format("load")):
        rs.campbell_diagram(system, [0.0, 1.0], bad)
    with pytest.raises(ValueError, match=message.format("load")):
        rs.critical_speeds(system, bad)


def test_shapes_that_make_no_curve_are_refused():
    with pytest.raises(ValueError, match=r"`loads` must be one-dimensional, .*\(2, 1\)"):
        rs.load_frequency_curves(rs.lumped(BASE, 1.0), [[0.0], [1.0]])
    with pytest.raises(ValueError, match=r"`spin_speeds` must be one-dimensional, .*\(\)"):
        rs.campbell_diagram(rs.lumped(BASE, 1.0), 1.0)
    with pytest.raises(ValueError, match=r"`system` must have one spin speed, .*\(3,\)"):
        rs.load_frequency_curves(rs.lumped(BASE, [0.0, 1.0, 2.0]), [0.0, 1.0])
    with pytest.raises(ValueError, match=r"`load` must be a single number, .*\(2,\)"):
        rs.critical_speeds(rs.lumped(BASE, 1.0), [0.0, 1.0])
    with pytest.raises(ValueError, match="`load` must be below the pole of the exact stiffness"):
        rs.whirl_frequencies(rs.lumped(BASE, 1.0, stiffness="exact"), 40.0)
