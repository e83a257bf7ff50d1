"""Every figure of the paper: its arrays against direct calls, its reading and verdicts."""

import json
from functools import cache

import numpy as np
import pytest

from rotorstab import (
    BASE_CASE,
    EULER_BERNOULLI_TWIN,
    TABLE_1_SI,
    ShaftDisk,
    boundary_frequencies,
    critical_load,
    exact_stiffness,
    finite_element,
    fundamental_frequency,
    in_bolotin_region,
    linear_stiffness,
    lumped,
    whirl_frequencies,
)
from rotorstab.floquet.point import growth_rate
from rotorstab.floquet.resonance import resonances
from rotorstab.paper import CONCLUSIONS, FIGURES, own_regions, table_1

BUCKLING = float(critical_load(BASE_CASE.shear))
FREQUENCY = fundamental_frequency(lumped(BASE_CASE, 0.0))
SPINS = {"a": 0.0, "b": 1.0, "c": 2.0}
PI, MINUTE = np.pi, 60.0


@cache
def figure(number):
    return FIGURES[number]()


@cache
def table_rotor():
    return ShaftDisk.from_si(**TABLE_1_SI)


def system_of(number, letter, group):
    """Return the system that a group stands for, and its α_s."""
    if number == 4:
        rotor, scales = table_rotor()
        spin = {"a": 0.0, "b": 1000.0}[letter] * 2 * PI / MINUTE / scales.frequency
        if group == "present":
            return lumped(rotor, spin), 0.5
        return finite_element(rotor, spin), 0.5
    spin = SPINS[letter]
    if number == 5:
        rotor = BASE_CASE if group == "Timoshenko" else EULER_BERNOULLI_TWIN
        return lumped(rotor, spin), 0.5
    if number == 9:
        return lumped(BASE_CASE, spin, 1.0 if group == "follower force" else 0.0), 0.5
    return lumped(BASE_CASE, spin, number - 6.0), float(group.split("=")[1])


REGION_FIGURES = (4, 5, 6, 7, 9)


@pytest.mark.parametrize("number", REGION_FIGURES)
def test_boundaries_are_those_of_eq_24(number):
    drawn = figure(number)
    frequency = drawn.parameters["fundamental_frequency"]
    reference = drawn.parameters["reference_load"]
    for panel in drawn.panels:
        for group in dict.fromkeys(one.group for one in panel.series):
            system, factor = system_of(number, panel.letter, group)
            lines = panel.group(group)
            assert [one.name for one in lines] == [
                f"{group}, {m}" for m in ("1B", "1F", "2B", "2F")
            ]
            for row in (0, 40, -1):
                ours = np.sort([one.x[row] for one in lines]) * frequency
                direct = boundary_frequencies(
                    system, factor * reference, lines[0].y[row] * reference
                )[:4]
                near_zero = direct < 0.01 * frequency
                assert ours[~near_zero] == pytest.approx(direct[~near_zero], rel=5e-5)


@pytest.mark.parametrize("number", [6, 7, 9])
def test_shaded_polygons_are_bolotin_regions(number):
    """A point a little inside each side's midpoint is in the region, one outside is not."""
    drawn = figure(number)
    for panel in drawn.panels:
        for region in panel.regions:
            system, factor = system_of(number, panel.letter, region.group)
            middle = region.x.size // 4
            left, right = region.x[middle], region.x[::-1][middle]
            beta = region.y[middle]
            for x, inside in (
                ((left + right) / 2, True),
                (left - 1e-3, False),
                (right + 1e-3, False),
            ):
                assert (
                    bool(
                        in_bolotin_region(system, factor * BUCKLING, beta * BUCKLING, x * FREQUENCY)
                    )
                    is inside
                )


@pytest.mark.parametrize(("number", "tangency"), [(2, 0.0), (3, 1.0)])
def test_coefficients_are_the_solver_s(number, tangency):
    places = {"k̄₁₁": (0, 0), "k̄₁₂": (0, 1), "k̄₁₂ = k̄₂₁": (0, 1), "k̄₂₁": (1, 0), "k̄₂₂": (1, 1)}
    elastic, geometric = linear_stiffness(BASE_CASE.shear, tangency)
    for panel in figure(number).panels:
        i, j = places[panel.title]
        exact, linear = panel.series
        assert (exact.style, linear.style) == ("solid", "dashed")
        assert exact.y == pytest.approx(
            exact_stiffness(exact.x, BASE_CASE.shear, tangency)[:, i, j]
        )
        assert linear.y == pytest.approx(elastic[i, j] + linear.x * geometric[i, j])
        assert np.isfinite(exact.y).all()
        # one value and one slope at p̄ = 0
        zero = exact.x.size // 2
        assert exact.y[zero] == pytest.approx(linear.y[zero])


@pytest.mark.parametrize(("letter", "spin"), [("a", 0.0), ("b", 2.0)])
def test_load_frequency_curves_are_roots_without_jumps(letter, spin):
    panel = figure(8).panel(letter)
    for one in panel.series:
        tangency = 1.0 if one.name.startswith("follower") else 0.0
        direct = whirl_frequencies(lumped(BASE_CASE, spin, tangency), one.x).real
        real = np.isfinite(one.y)
        assert np.abs(direct[real] - one.y[real, None]).min(axis=1).max() < 1e-6
        # a line is cut where it has a gap, never drawn across it
        steps = np.abs(np.diff(one.y))
        assert np.nanmax(steps, initial=0.0) < 0.06
    dotted = [one for one in panel.series if one.style == "dotted"]
    assert dotted
    for pair in dotted:
        mode = next(one for one in panel.series if one.name == pair.name.rsplit(", ", 1)[0])
        both = np.isfinite(pair.y) & np.isfinite(mode.y)
        assert both.any()
        assert np.abs(pair.y[both] - mode.y[both]).max() < 1e-6


def test_follower_flutter_is_seen_in_figure_8():
    assert figure(8).parameters["flutter_load_spin_0"] == pytest.approx(6.29010, abs=1e-4)


VERDICTS = {
    2: ["agree", "agree"],
    3: ["agree", "agree"],
    4: ["agree", "agree", "agree in part"],
    5: ["agree", "agree in part", "agree", "agree"],
    6: ["agree"],
    7: ["agree", "agree in part", "agree"],
    8: ["agree", "agree", "agree", "agree in part"],
    9: ["agree", "agree"],
}


@pytest.mark.parametrize("number", FIGURES)
def test_reading_has_the_known_verdicts(number):
    reading = figure(number).reading
    assert [statement.verdict for statement in reading] == VERDICTS[number]
    for statement in reading:
        assert statement.text
        assert statement.ours
        assert "nan" not in statement.ours
        if statement.verdict != "agree":
            assert statement.note


def test_erratum_of_figure_8_is_stated_with_its_numbers():
    last = figure(8).reading[-1]
    assert "from 1.0730 to 1.0084" in last.ours
    assert "from 0.9092 to 0.9237" in last.note


def test_a_reading_follows_the_numbers():
    """With a wholly different rotor the text no longer holds, and the verdict says so."""
    heavy_spin = FIGURES[7](spin_speeds=(1.0,), static_factors=(0.5, 0.0))
    assert heavy_spin.reading[0].verdict == "agree in part"
    assert FIGURES[6](static_factors=(0.5, 0.0)).reading[0].verdict == "differ"
    assert FIGURES[2](ShaftDisk(shear=0.0)).reading[0].verdict == "differ"


def test_conclusion_a_holds_for_order_and_direction_of_the_modes():
    statement = CONCLUSIONS["a"]()
    assert statement.verdict == "agree"
    assert "12 of 12" in statement.ours


def test_conclusion_b_holds_for_regions_but_not_as_instability():
    assert CONCLUSIONS["b"]().verdict == "agree in part"
    for spin in (1.0, 2.0):
        system = lumped(BASE_CASE, spin)
        left, right = boundary_frequencies(system, 0.5 * BUCKLING, 0.0)[:2] / FREQUENCY
        assert right - left > 1.4
        assert not whirl_frequencies(system, 0.5 * BUCKLING).imag.any()


def test_the_gyroscopic_moment_weakens_the_true_principal_tongue():
    """Against conclusion (b): from the resonance table, and from Floquet at its centre."""
    growth = []
    for spin in (0.0, 1.0, 2.0):
        system = lumped(BASE_CASE, spin)
        row = resonances(system, 0.5 * BUCKLING, 0.05 * BUCKLING)["1B+1F"]
        centres = row.centre + np.linspace(-1, 1, 9) * row.half_width / 2
        growth.append(growth_rate(system, 0.5 * BUCKLING, 0.05 * BUCKLING, centres).max() / 0.05)
        assert growth[-1] == pytest.approx(row.growth_per_load * BUCKLING, rel=0.02)
    assert growth == pytest.approx([0.2232, 0.1848, 0.1370], abs=2e-3)


def test_conclusion_c_holds_under_an_axial_load_only():
    assert CONCLUSIONS["c"]().verdict == "agree"
    follower = lumped(BASE_CASE, 0.0, 1.0)
    first = [boundary_frequencies(follower, f * BUCKLING, 0.0)[0] for f in (0.0, 0.5)]
    assert first[1] > first[0]


def test_conclusion_d_holds_at_the_higher_speed_and_half_at_the_lower():
    assert CONCLUSIONS["d"]().verdict == "agree in part"
    edges = {
        spin: [
            boundary_frequencies(lumped(BASE_CASE, spin, 1.0), f * BUCKLING, 0.0)[:2]
            for f in (0.0, 0.5)
        ]
        for spin in (1.0, 2.0)
    }
    for (left, right), (left_loaded, right_loaded) in edges.values():
        assert left_loaded > left
        assert 0.85 < (right_loaded - left_loaded) / (right - left) < 0.95
    assert edges[1.0][1][1] > edges[1.0][0][1]
    assert edges[2.0][1][1] < edges[2.0][0][1]


def test_conclusion_e_holds_for_the_first_bolotin_region():
    statement = CONCLUSIONS["e"]()
    assert statement.verdict == "agree"
    assert "growth 0.000" in statement.note
    for spin in SPINS.values():
        axial, follower = (
            boundary_frequencies(lumped(BASE_CASE, spin, tangency), 0.5 * BUCKLING, 0.5 * BUCKLING)
            for tangency in (0.0, 1.0)
        )
        assert (axial[:2] < follower[:2]).all()
        assert axial[1] - axial[0] > follower[1] - follower[0]


def test_table_1_meets_the_printed_numbers():
    rows = {row.symbol: row for row in table_1().rows}
    assert rows["ω_n"].difference == pytest.approx(0.0, abs=1e-6)
    assert rows["p_cr"].difference == pytest.approx(0.0, abs=3e-3)
    assert rows["M̄_D"].difference == pytest.approx(0.0, abs=2e-3)
    assert rows["m/(m+M_D)"].ours == pytest.approx(0.4627, abs=1e-4)
    assert rows["Φ"].difference is None


@pytest.mark.parametrize("number", FIGURES)
def test_figures_are_plain_frozen_data(number):
    drawn = figure(number)
    assert drawn.number == number
    assert json.loads(json.dumps(dict(drawn.parameters))) == dict(drawn.parameters)
    letters = [panel.letter for panel in drawn.panels]
    assert letters == list("abcdef")[: len(letters)]
    for panel in drawn.panels:
        names = [one.name for one in (*panel.series, *panel.regions)]
        assert len(set(names)) == len(names)
        for one in (*panel.series, *panel.regions):
            assert one.x.shape == one.y.shape
            with pytest.raises(ValueError, match="read-only"):
                one.x[0] = 0.0
    assert {line.style for line in drawn.groups().values()} <= {
        "solid",
        "dashed",
        "dashdot",
        "dotted",
    }
    assert drawn.panel("a") is drawn.panels[0]


def test_linear_coefficients_buckle_later_than_the_shaft():
    """The load factors' p̄_cr is the exact one; the linear shaft buckles 1.5 % above it."""
    elastic, geometric = linear_stiffness(BASE_CASE.shear)
    loads = np.linalg.eigvals(-np.linalg.solve(geometric, elastic))
    assert loads.min() == pytest.approx(2.3913, abs=5e-5)
    assert "1B reaches ω̄ = 0 at p̄ = 2.3913" in figure(8).reading[2].ours


def test_every_spin_speed_has_its_panel_and_every_factor_its_lines():
    speeds = tuple(np.linspace(0.0, 2.0, 7))
    for maker in (FIGURES[5], FIGURES[8], FIGURES[9]):
        panels = maker(spin_speeds=speeds).panels
        assert [panel.letter for panel in panels] == list("abcdefg")
    assert len(FIGURES[4](speeds_rpm=(0.0,) * 7).panels) == 7
    assert len(own_regions(lumped(BASE_CASE, 0.0), BASE_CASE.shear, speeds, (0.0, 0.5)).panels) == 7
    for maker in (FIGURES[6], FIGURES[7]):
        assert len(maker(spin_speeds=speeds, static_factors=(0.2,)).panels) == 7
        with pytest.raises(ValueError, match="`static_factors` must have 1 to 3 values, got 4"):
            maker(static_factors=(0.0, 0.1, 0.2, 0.3))
        with pytest.raises(ValueError, match="`spin_speeds` must have 1 to 26 values, got 0"):
            maker(spin_speeds=())
    with pytest.raises(ValueError, match="`speeds_rpm` must have 1 to 26 values, got 27"):
        FIGURES[4](speeds_rpm=(0.0,) * 27)


@pytest.mark.parametrize("last", [1.0, 2.0])
def test_figure_5_compares_shafts_at_one_spin_speed(last):
    figure = FIGURES[5](spin_speeds=(0.0, last))
    note = figure.reading[0].note
    twin = lumped(EULER_BERNOULLI_TWIN, last)
    own = boundary_frequencies(twin, 0.5 * critical_load(0.0), 0.0)[0] / FREQUENCY
    drawn = boundary_frequencies(lumped(BASE_CASE, last), 0.5 * BUCKLING, 0.0)[0] / FREQUENCY
    side = "left" if own < drawn else "not left"
    assert f"at Ω̄ = {last:g}, β_d = 0 would be {own:.4f}, {side} of Timoshenko's" in note
    assert f"{drawn:.4f} (" in note
