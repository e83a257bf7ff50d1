"""Tongues that share modes as one region of first order, against Floquet's growth."""

import numpy as np
import pytest

from rotorstab import (
    BASE_CASE,
    critical_load,
    finite_element,
    first_order_regions,
    fundamental_frequency,
    growth_rate,
    lumped,
    resonances,
)

P = float(critical_load(BASE_CASE.shear))
W = fundamental_frequency(lumped(BASE_CASE, 0.0))
DIFFERENCE = "1B+2B, 1F+2F"


def regions_of(system, factor, load):
    return first_order_regions(resonances(system, factor * P, load), load)


@pytest.mark.parametrize(
    ("factor", "names"),
    [
        (0.5, ["1B+1F", DIFFERENCE]),
        (0.75, ["1B+1F, 1B+2B, 1F+2F"]),
        (0.8, ["1B+1F, 1B+2B, 1F+2F"]),
        (0.85, ["1B+1F, 1B+2B, 1F+2F"]),
        (0.9, ["1B+1F, 1B+2B, 1F+2F"]),
    ],
)
@pytest.mark.parametrize("damping", [0.0, 0.002])
def test_at_rest_under_a_follower_load_they_are_where_growth_is(factor, names, damping):
    system = lumped(BASE_CASE, 0.0, 1.0, external_damping=damping)
    low, high, load = 1.9 * W, 2.7 * W, 0.1 * P
    found = [one for one in regions_of(system, factor, load) if low < one.centre < high]
    assert [one.name for one in found] == names
    theta = np.linspace(low, high, 401)
    unstable = growth_rate(system, factor * P, load, theta) > 1e-6
    assert theta[unstable].min() == pytest.approx(found[0].left, abs=0.006 * W)
    assert theta[unstable].max() == pytest.approx(found[-1].right, abs=0.006 * W)
    inside = np.any([(one.left <= theta) & (theta <= one.right) for one in found], axis=0)
    assert (inside == unstable).mean() > 0.96


def test_a_region_may_close_the_gap_between_tongues_and_be_narrower_than_they_are():
    system, load = lumped(BASE_CASE, 0.0, 1.0), 0.1 * P
    for factor, gap in ((0.75, True), (0.85, False)):
        table = resonances(system, factor * P, load)
        (region,) = (one for one in first_order_regions(table, load) if "1B+1F" in one.name)
        left = sorted(one.centre - one.half_width for one in region.tongues)
        right = sorted(one.centre + one.half_width for one in region.tongues)
        assert (left[-1] > right[0]) == gap
        assert region.width < right[-1] - left[0]


def test_three_narrow_tongues_make_one_wider_region():
    """Of 0.0596, 0.0596 and 0.0228 together 0.096, as points tell: ω₂ is near 3 ω₁."""
    system, load = lumped(BASE_CASE, 0.0, 0.74), 0.1 * P
    table = resonances(system, 1.88 * P, load)
    (region,) = (one for one in first_order_regions(table, load) if "1B+1F" in one.name)
    assert region.name == "1B+1F, 1B+2B, 1F+2F"
    widths = sorted(2 * one.half_width / W for one in region.tongues)
    assert widths == pytest.approx([0.0228, 0.0596, 0.0596], abs=1e-4)
    theta = np.linspace(region.left - 0.01 * W, region.right + 0.01 * W, 501)
    unstable = theta[growth_rate(system, 1.88 * P, load, theta) > 1e-6]
    assert (unstable[-1] - unstable[0]) / W == pytest.approx(0.0966, abs=3e-4)
    assert region.width / W == pytest.approx(0.0966, abs=1e-3)


def test_tongues_that_share_no_mode_keep_their_width():
    for system in (lumped(BASE_CASE, 0.0), lumped(BASE_CASE, 2.0), lumped(BASE_CASE, 2.0, 0.5)):
        table = resonances(system, 0.3 * P, 0.01 * P)
        found = first_order_regions(table, 0.01 * P)
        assert sorted(name for one in found for name in one.name.split(", ")) == sorted(
            one.name for one in table.tongues
        )
        for region in found:
            for one in region.tongues:
                assert region.width == pytest.approx(2 * one.half_width)
                assert region.centre == pytest.approx(one.centre)


def test_finite_elements_and_a_table_without_tongues():
    system = finite_element(BASE_CASE, 0.0, 1.0, modes=4)
    names = [one.name for one in regions_of(system, 0.5, 0.1 * P)]
    assert DIFFERENCE in names
    assert len(" ".join(names).split()) == len(resonances(system, 0.5 * P, 0.1 * P).tongues)
    assert regions_of(lumped(BASE_CASE, 2.0, external_damping=0.2), 0.5, 0.01 * P) == ()
    with pytest.raises(ValueError, match=r"`pulsating_load` must be in \(0, inf\), got 0"):
        regions_of(system, 0.5, 0.0)
