"""The verdict and the words of the marked point against the map and the table."""

import numpy as np
import pytest

import rotorstab as rs
from app.pages.marked_point import inspect
from app.results.analysis import solve
from app.results.limits import Detail
from app.state import State
from app.words.details import details
from app.words.verdict import percent, verdict
from rotorstab.charts.agreement import Agreement

DRIVEN = {
    "model": "finite elements",
    "spin_speed": 4,
    "external_damping": 0.05,
    "internal_damping": 0.1,
}
SLOW = {
    "spin_speed": 0,
    "disk_mass": 0.5,
    "diametral_inertia": 0.01,
    "polar_inertia": 6,
    "static_load_factor": 0.95,
    "shear": 0.1,
    "largest_factor": 2,
    "highest_frequency": 4,
    "law": "exact",
    "external_damping": 0.2,
    "internal_damping": 0.2,
}
HELD = {"external_damping": 0.05, "load_type": "follower"}


def solved(values, detail=Detail.FULL):
    state = State()
    assert state.change(values) == {}
    return state, solve(state, detail)


def test_a_rotor_that_grows_by_itself_is_not_compared_with_bolotin():
    _, result = solved(DRIVEN)
    words = verdict(result.floquet)
    assert "unstable without any pulsation" in words
    assert "All of the computed part of this window is unstable, at any pulsation." in words
    assert "times as large" not in words
    assert "no tongue lies" not in words
    # what is not computed is no disagreement
    layers = result.charts["instability"]
    growth = result.charts["instability"].layer("growth").columns["rate"][0]
    assert np.isnan(layers.layer("disagreement").columns["image"][0][:, growth[0] == 0]).all()


def test_shares_are_of_the_computed_part():
    _, result = solved(SLOW)
    answer = result.floquet
    disagree = result.charts["instability"].layer("disagreement").columns["image"][0]
    columns = disagree.shape[1]
    low, high = answer.frequency_range
    centres = low + (np.arange(columns) + 0.5) / columns * (high - low)
    known = int((centres >= answer.lowest_computed_ratio - 1e-9).sum())
    assert 0 < known < columns
    # the share is a whole number of computed pixels
    pixels = answer.unstable_share * known * disagree.shape[0]
    assert pixels == pytest.approx(round(pixels), abs=1e-6)
    assert answer.unstable_share > 0.1
    words = verdict(answer)
    assert "Of the computed part of this window" in words
    assert words.count("To first order, damping keeps the rotor stable up to") == 1
    assert f"but the map shows growth from β_d = {answer.unstable_from:.3f}" in words


def test_growth_too_strong_for_the_map_is_named():
    """Ten times the buckling load: the map once drew noise there, then blamed slow loads."""
    strong = {
        "shear": 0.0,
        "disk_mass": 20.0,
        "diametral_inertia": 0.03,
        "polar_inertia": 0.0,
        "spin_speed": 1.0,
        "load_type": "follower",
        "reference": "flutter",
        "law": "exact",
        "largest_factor": 0.8,
    }
    _, result = solved(strong, detail=Detail.FULL)
    assert result.floquet.unknown_share > 0.05
    words = verdict(result.floquet)
    assert "grows too much there for its rate to be known" in words
    _, result = solved({}, detail=Detail.FULL)
    assert result.floquet.unknown_share == 0
    assert "blank" not in verdict(result.floquet)


def test_a_tongue_thinner_than_a_pixel_is_not_nothing():
    thin = {"spin_speed": 1, "lowest_frequency": 5, "highest_frequency": 7, "largest_factor": 0.05}
    for damping, words in ((0.0, "under 0.1\u00a0%"), (0.01, "nothing")):
        answer = solved(thin | {"external_damping": damping})[1].floquet
        assert answer.unstable_share == 0
        assert f"Of this window {words} is unstable" in verdict(answer)


def test_nothing_computed_gives_no_share():
    small = {"diametral_inertia": 0.01, "spin_speed": 4, "polar_inertia": 6}
    _, result = solved(small | {"highest_frequency": 0.5}, detail=Detail.COARSE)
    answer = result.floquet
    assert np.isnan(answer.unstable_share)
    assert "Of " not in verdict(answer)
    verdict_of_pixels = result.charts["instability"].layer("growth").columns["verdict"][0]
    assert (verdict_of_pixels == Agreement.NOT_COMPUTED).all()
    image = result.charts["instability"].layer("disagreement").columns["image"][0]
    assert np.isnan(image).all()


def test_inspector_and_verdict_agree_on_a_tongue_that_damping_holds_down():
    state, result = solved(HELD | {"marker": True, "marker_frequency": 1.987, "marker_factor": 0.2})
    first = min(result.floquet.table, key=lambda row: row.threshold)
    threshold = f"{first.threshold / result.floquet.reference_load:.3f}"
    held = f"stable up to β_d = {threshold}, where the tongue {first.name} begins"
    assert held in verdict(result.floquet)
    sentence = inspect(state, result).explanation
    assert f"makes a tongue that, to first order, begins at β_d = {threshold}" in sentence
    assert "no tongue" not in sentence


def test_the_inspector_blames_no_tongue_where_the_whirl_grows_without_pulsation():
    values = {"external_damping": 0.01, "internal_damping": 0.05, "spin_speed": 3.0}
    state, result = solved(values | {"marker": True, "marker_frequency": 9.9, "marker_factor": 0.2})
    assert result.floquet.table.mean_growth > 0
    sentence = inspect(state, result).explanation
    assert "grows without any pulsation" in sentence
    assert "misses" not in sentence


def test_a_coarse_map_is_no_measure_of_bolotin():
    # at rest, follower load: its pixels miss the thin tongues, and Bolotin seemed 750 % too large
    values = {"spin_speed": 0.0, "load_type": "follower"}
    words = [verdict(solved(values, detail)[1].floquet) for detail in (Detail.COARSE, Detail.FULL)]
    assert not [one for one in words if "times as large" in one]
    assert "computed when the sliders rest" in words[0]
    assert "Of this window" in words[1]


def test_what_the_captions_say_of_buckling_and_of_the_resting_rotor():
    spinning = rs.lumped(rs.BASE_CASE, 2.0)
    loads = np.array([2.3, 2.4, 3.3, 3.4])
    whirl = rs.load_frequency_curves(spinning, loads)
    backward = whirl.frequencies[:, whirl.names.index("1B")]
    assert (np.sign(backward.real[:3]) == [-1, 1, 1]).all()
    assert (np.abs(whirl.frequencies.imag).max(axis=1) > 1e-6).tolist() == [False] * 3 + [True]
    resting = rs.whirl_frequencies(rs.lumped(rs.BASE_CASE, 0.0), loads[:2])
    assert (np.abs(resting.imag).max(axis=1) > 1e-6).tolist() == [False, True]
    answer = solved({"spin_speed": 0.0})[1].floquet
    assert answer.both_share > 0.9 * answer.bolotin_share  # the bands hold
    assert answer.both_share < 0.8 * answer.unstable_share  # and are not all


def test_the_verdict_names_one_region_once():
    at_rest = {"spin_speed": 0.0, "load_type": "follower", "static_load_factor": 0.85}
    _, answer = solved(at_rest | {"highest_frequency": 16.0}, Detail.COARSE)
    words = verdict(answer.floquet)
    assert "2 unstable regions in this window at β_d = 0.1: 1B+1F, 1B+2B, 1F+2F at" in words
    assert "(0.062 wide)" in words


def texts(values, detail=Detail.FULL):
    return details(solved(values, detail)[1].floquet)


def test_the_table_of_tongues_has_a_row_for_each_region_of_first_order():
    whole = {"highest_frequency": 16.0}
    _, result = solved(whole)
    table = result.floquet.table
    found = texts(whole)
    assert found["columns"][0] == "Tongue"
    assert "begins at β_d" not in found["columns"]
    names = [row[0] for row in found["rows"]]
    assert names == [row.name for row in sorted(table.tongues, key=lambda one: one.centre)]
    for name, place, width, growth in found["rows"]:
        frequency = result.numbers["fundamental"]
        assert float(place) == pytest.approx(table[name].centre / frequency, abs=1e-3)
        assert float(width) == pytest.approx(2 * table[name].half_width / frequency, abs=1e-3)
        assert float(growth) == pytest.approx(table[name].growth, rel=1e-2)


def test_the_details_say_where_all_whirls_of_finite_elements_are_kept():
    stout = {"shear": 0.1, "disk_mass": 2.0, "polar_inertia": 1.0, "diametral_inertia": 0.5}
    elements = {"model": "finite elements", "lowest_frequency": 2.0}
    words = "all whirls of the finite elements"
    assert words in texts({**stout, **elements}, Detail.COARSE)["words"]
    assert words not in texts(elements, Detail.COARSE)["words"]


def test_with_damping_the_table_says_where_each_tongue_begins():
    _, result = solved({"external_damping": 0.05})
    found = texts({"external_damping": 0.05})
    assert found["columns"][-1] == "begins at β_d"
    for row in found["rows"]:
        threshold = result.floquet.table[row[0]].threshold / result.numbers["reference"]
        assert float(row[-1]) == pytest.approx(threshold, rel=1e-2)
        assert (row[2] == "—") == (threshold > 0.1)
    assert "To first order, damping keeps the rotor stable up to" in found["words"]


def test_the_shares_of_the_window_are_those_of_the_map():
    assert texts({}, Detail.COARSE)["shares"] == []
    answer = solved({})[1].floquet
    shares = dict(texts({})["shares"])
    assert shares["Unstable (Floquet)"] == percent(answer.unstable_share)
    assert shares["In a Bolotin region"] == percent(answer.bolotin_share)
    assert texts(DRIVEN)["rows"] == []
