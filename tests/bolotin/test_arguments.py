"""Empty input, and what Bolotin's functions refuse."""

import numpy as np
import pytest

import rotorstab as rs

BASE = rs.BASE_CASE


def test_empty_input_gives_empty_output():
    for stiffness in ("linear", "exact"):
        system = rs.lumped(BASE, 1.0, stiffness=stiffness)
        assert rs.boundary_frequencies(system, 0.5, []).shape == (0, 4)
        assert rs.boundary_frequencies(system, [], 0.5).shape == (0, 4)
        assert rs.in_bolotin_region(system, 0.5, 0.1, []).shape == (0,)
    assert rs.boundary_frequencies(rs.lumped(BASE, []), 0.5, 0.5).shape == (0, 4)
    assert rs.boundary_frequencies(rs.lumped(BASE, 0.0), 0.5, []).shape == (0, 4)


@pytest.mark.parametrize("bad", [np.nan, np.inf, True, "1", 1j, None])
def test_bad_numbers_are_refused(bad):
    system = rs.lumped(BASE, 1.0)
    wrong = r" must be (a real number )?in [(\[].*, inf\), got"
    with pytest.raises(ValueError, match="`static_load`" + wrong):
        rs.boundary_frequencies(system, bad, 0.1)
    with pytest.raises(ValueError, match="`pulsating_load`" + wrong):
        rs.boundary_frequencies(system, 0.1, bad)
    with pytest.raises(ValueError, match="`excitation_frequency`" + wrong):
        rs.in_bolotin_region(system, 0.1, 0.1, bad)
    with pytest.raises(ValueError, match="`static_load`" + wrong):
        rs.bolotin_chart(system, bad, 1.0)
    with pytest.raises(ValueError, match="`largest_pulsating_load`" + wrong):
        rs.bolotin_chart(system, 0.0, bad)
    with pytest.raises(ValueError, match=r"`rows` must be (a real number )?in \[8, 100000\], got"):
        rs.bolotin_chart(system, 0.0, 1.0, bad)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda s: rs.bolotin_chart(s, 0.0, 0.0), r"`largest_pulsating_load` must be in \(0, inf"),
        (lambda s: rs.bolotin_chart(s, 0.0, 1.0, 7), r"`rows` must be in \[8, 100000\], got 7"),
        (lambda s: rs.bolotin_chart(s, 0.0, 1.0, 9.5), "`rows` must be a whole number .* got 9.5"),
        (lambda s: rs.bolotin_chart(s, [0.0], 1.0), "`static_load` must be a single number"),
        (
            lambda s: rs.bolotin_chart(s.at_speed([1.0, 2.0]), 0.0, 1.0),
            r"`system` must have one spin speed, .*\(2,\)",
        ),
        (
            lambda s: rs.in_bolotin_region(s, 0.0, 0.0, -1.0),
            r"`excitation_frequency` must be in \[0, inf\), got -1",
        ),
        (
            lambda s: rs.in_bolotin_region(rs.lumped(BASE, 0.0, 0.0, 0.1), 0.0, 0.0, 1.0),
            "`system` must be undamped",
        ),
        (
            lambda s: rs.boundary_frequencies(rs.lumped(BASE, 1.0, stiffness="exact"), 1.0, 30.0),
            r"`static_load` \+ \|`pulsating_load`\| must be below the pole",
        ),
    ],
)
def test_bad_arguments_are_named(call, message):
    with pytest.raises(ValueError, match=message):
        call(rs.lumped(BASE, 1.0))


def test_the_mask_wants_rows_and_columns():
    system = rs.lumped(rs.BASE_CASE, 2.0)
    with pytest.raises(ValueError, match="`pulsating_loads` must be one-dimensional"):
        rs.bolotin_mask(system, 0.5, 1.0, [1.0, 2.0])
    with pytest.raises(ValueError, match="`excitation_frequencies` must be one-dimensional"):
        rs.bolotin_mask(system, 0.5, [1.0], 2.0)
    with pytest.raises(ValueError, match="`largest_pulsating_load` must be a single number"):
        rs.bolotin_chart(system, 0.5, [1.0, 2.0])
    assert rs.bolotin_chart(system, 0, np.int64(1)).names == ("1B", "1F", "2B", "2F")
