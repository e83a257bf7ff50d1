"""Figure 8: whirl frequencies over the steady load."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .._numerics.roots import is_real
from ..bolotin.boundaries import boundary_frequencies
from ..charts.columns import Lines, label_columns, widened
from ..charts.figure import Figure, Statement
from ..charts.modes import modes
from ..charts.quantities import LOAD, WHIRL
from ..charts.roles import Style
from ..charts.structure import Chart, Curve, Layer
from ..floquet.resonance import resonances
from ..model.lumped import lumped
from ..model.system import System, fundamental_frequency
from ..rotors.shaft_disk import BASE_CASE, ShaftDisk
from ..whirl.campbell import load_frequency_curves
from ..whirl.critical_loads import critical_load, flutter_load
from ..whirl.frequencies import whirl_frequencies
from .arguments import LOAD_KINDS, lettered, parameters
from .floquet_numbers import PRINCIPAL, growth, root, tongues
from .region_figure import Variant
from .verdicts import by_panel, judge, listed, say, uphold

__all__ = ["figure_8"]

Array = NDArray[np.float64]
Panels = tuple[Chart, ...]

_COMPLEX = "complex pair"
_STRIP = 0.065  # of the axis: height of the strip of what is unstable without pulsation
_ROOM = (0.15, 0.98)  # of p̄_cr: where pairs are marked
_FLOQUET = (
    " Each upright line joins two whirls that a pulsation makes grow; its length is the θ of that "
    "tongue at that load. Strips: unstable without any pulsation."
)


@dataclass(frozen=True, eq=False)
class _Rotor:
    """The rotor under one kind of load: its legend entry, its line style, its system."""

    group: str
    style: Style
    system: System


Labels = list[tuple[float, float, str, str]]


def figure_8(
    rotor: ShaftDisk = BASE_CASE,
    spin_speeds: Sequence[float] = (0.0, 2.0),
    largest_load: float = 7.0,
    points: int = 281,
    floquet: bool = False,
) -> Figure:
    """Return Fig. 8: load–frequency curves, axial and follower load.

    Parameters
    ----------
    rotor : ShaftDisk
    spin_speeds : sequence of up to 26 floats
        Ω̄, a panel each.
    largest_load : float
        p̄ runs from 0 to this [EI/L²].
    points : int
        Even loads; more are added where two frequencies meet.
    floquet : bool
        Whether to mark the pairs of whirls that a pulsation makes grow, and the loads that
        make the rotor unstable by themselves.

    Returns
    -------
    Figure
        Where two frequencies have met and become a complex pair, its real part is a
        line of its own in the group "complex pair".
    """
    loads = np.linspace(0.0, largest_load, points)
    buckling = float(critical_load(rotor.shear))
    panels = []
    limits = {"critical_load": buckling}
    for letter, spin in lettered("spin_speeds", spin_speeds):
        rotors = [_Rotor(group, style, lumped(rotor, spin, mu)) for group, style, mu in LOAD_KINDS]
        panels.append(_chart(letter, f"Ω̄ = {spin:g}", rotors, loads, buckling, floquet))
        for one in rotors:
            flutter = flutter_load(one.system) if one.system.tangency else np.inf
            if np.isfinite(flutter):
                limits[f"flutter_load_spin_{spin:g}"] = flutter
    caption = "Solid: axial force. Dashed: follower force. Dotted: real part of a complex pair."
    reading = _read_text(tuple(panels), rotor)
    if floquet:
        caption += _FLOQUET
        reading += _read_floquet(tuple(panels), rotor, spin_speeds)
    return Figure(
        number=8,
        title="Load–frequency curves",
        caption=caption,
        parameters=parameters(rotor, spin_speeds=list(spin_speeds), **limits),
        panels=tuple(panels),
        reading=reading,
    )


def _chart(
    letter: str,
    title: str,
    rotors: Sequence[_Rotor],
    loads: Array,
    buckling: float,
    floquet: bool,
) -> Chart:
    """Return one panel; with Floquet it has pairs and, at its foot, strips."""
    lines = Lines()
    for rotor in rotors:
        _add_curves(lines, rotor, loads)
    whirl = Layer("lines", "whirl", lines.columns)
    curves = whirl.curves()
    top = float(np.ceil(1.05 * max(np.nanmax(np.abs(line.y)) for line in curves)))
    bottom = -top
    above: list[Layer] = []
    if floquet:
        span = 1.25 * (top - min(float(np.nanmin(line.y)) for line in curves))
        bottom = top - span
        pairs, names = _pairs(rotors, buckling)
        strips, more_names = _strips(rotors, loads, bottom, _STRIP * span)
        above = [
            Layer("lines", "pairs", pairs.columns),
            Layer("outlines", "unstable without pulsation", strips.columns),
            Layer("labels", "tongue", label_columns(names + more_names)),
        ]
    names_at_0 = [
        (
            0.0,
            float(line.y[0]),
            line.mode.name,
            f"{'upper' if line.mode.forward else 'lower'} right",
        )
        for line in curves
        if line.group == rotors[0].group and line.mode is not None
    ]
    return Chart(
        key=letter,
        letter=letter,
        title=title,
        x=LOAD,
        y=WHIRL,
        x_range=(0.0, float(loads[-1])),
        y_range=(bottom, top),
        layers=(whirl, Layer("labels", "mode", label_columns(names_at_0)), *above),
    )


def _complex_count(system: System, loads: Array) -> Array:
    """Return how many whirl frequencies are complex at each load."""
    frequencies = whirl_frequencies(system, loads)
    return np.asarray((~is_real(frequencies)).sum(axis=-1))


def _refined(system: System, loads: Array) -> Array:
    """Return the loads with graded ones added at every meeting of two frequencies.

    There the frequency turns as a square root.
    """
    count = _complex_count(system, loads)
    changes = np.flatnonzero(count[1:] != count[:-1])
    if not changes.size:
        return loads
    low, high, below = loads[changes], loads[changes + 1], count[changes]
    for _ in range(48):
        middle = (low + high) / 2
        same = _complex_count(system, middle) == below
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    grading = (np.linspace(0.0, 1.0, 12)[1:-1] ** 2)[:, None]
    before = low - (low - loads[changes]) * grading
    after = high + (loads[changes + 1] - high) * grading
    return np.unique(np.concatenate([loads, low, high, before.ravel(), after.ravel()]))


def _add_curves(lines: Lines, rotor: _Rotor, loads: Array) -> None:
    """Add every mode's real stretches, and its complex ones as dotted lines of Re ω."""
    curves = load_frequency_curves(rotor.system, _refined(rotor.system, loads))
    complex_pairs = ~is_real(curves.frequencies)
    columns = zip(modes(curves.names), curves.frequencies.T, complex_pairs.T, strict=True)
    for mode, column, is_complex in columns:
        name = f"{rotor.group}, {mode.name}"
        real = np.where(is_complex, np.nan, column.real)
        lines.add(curves.parameter, real, name, rotor.style, rotor.group, mode)
        if is_complex.any():
            pair = np.where(widened(is_complex), column.real, np.nan)
            lines.add(curves.parameter, pair, f"{name}, {_COMPLEX}", "dotted", _COMPLEX)


def _pairs(rotors: Sequence[_Rotor], buckling: float) -> tuple[Lines, Labels]:
    """Return upright lines between the two whirls of every tongue, each at a load of its own."""
    wanted = [
        [row.name for row in resonances(rotor.system, buckling / 2, buckling).tongues]
        for rotor in rotors
    ]
    places = np.linspace(*_ROOM, len(rotors) * max(map(len, wanted))) * buckling
    lines, labels = Lines(), []
    for index, (rotor, names) in enumerate(zip(rotors, wanted, strict=True)):
        own_places = places[index :: len(rotors)][: len(names)].tolist()
        for load, name in zip(own_places, names, strict=True):
            table = resonances(rotor.system, load, buckling)
            row = next((row for row in table.tongues if row.name == name), None)
            if row is None:
                continue
            ends = sorted(
                float(np.real(frequency))
                for frequency, mode in zip(table.frequencies, table.modes, strict=True)
                if mode in (row.first, row.second)
            )
            line = np.array([load, load]), np.array(ends)
            lines.add(*line, f"{rotor.group}, pair {name}", rotor.style, rotor.group, pair=name)
            labels.append((load, ends[0], name, "upright"))
    return lines, labels


def _strips(
    rotors: Sequence[_Rotor], loads: Array, bottom: float, height: float
) -> tuple[Lines, Labels]:
    """Return the loads at which a rotor is unstable by itself, a strip for each kind of load."""
    strips, labels = Lines(), []
    for index, rotor in enumerate(rotors):
        group = rotor.group
        fine = _refined(rotor.system, loads)
        grows = _complex_count(rotor.system, fine) > 0
        change = np.diff(np.concatenate([[False], grows, [False]]).astype(np.int8))
        low, high = bottom + index * height, bottom + (index + 0.9) * height
        runs = list(zip(np.flatnonzero(change == 1), np.flatnonzero(change == -1) - 1, strict=True))
        for count, (first, last) in enumerate(runs, 1):
            x = np.array([fine[first], fine[first], np.nan, fine[last], fine[last]])
            y = np.array([low, high, np.nan, high, low])
            strips.add(x, y, f"{group}, unstable without pulsation {count}", rotor.style, group)
        if runs:
            start = min(float(fine[runs[0][0]]), 0.7 * float(loads[-1]))
            labels.append((start, low, f"unstable: {group} alone", "foot"))
    return strips, labels


def _trend(line: Curve, up_to: float, size: bool = True) -> float:
    """Return +1 or −1 for a monotonic |y| (or y) over 0 to a load, 0 for neither."""
    inside = line.y[(line.x <= up_to) & np.isfinite(line.y)]
    steps = np.diff(np.abs(inside) if size else inside)
    return 1.0 if (steps >= -1e-12).all() else -1.0 if (steps <= 1e-12).all() else 0.0


def _first_zero(line: Curve) -> float:
    """Return the first load at which a line crosses zero, NaN where it does not."""
    real = np.isfinite(line.y)
    x, y = line.x[real], line.y[real]
    crossings = np.flatnonzero(np.sign(y[1:]) != np.sign(y[:-1]))
    if not crossings.size:
        return float("nan")
    i = int(crossings[0])
    return float(x[i] - y[i] * (x[i + 1] - x[i]) / (y[i + 1] - y[i]))


def _read_text(panels: Panels, rotor: ShaftDisk) -> tuple[Statement, ...]:
    """Compare what the text says with the curves."""
    buckling = float(critical_load(rotor.shear))
    rest, spinning = panels[0], panels[-1]
    axial, follower = "axial force", "follower force"
    symmetric = all(
        np.allclose(
            rest.boundary(group, f"{n}F").y, -rest.boundary(group, f"{n}B").y, equal_nan=True
        )
        for group in (axial, follower)
        for n in (1, 2)
    )
    fall = all(_trend(rest.boundary(axial, mode), buckling) < 0 for mode in ("1F", "2F"))
    rise = _trend(rest.boundary(follower, "1F"), buckling) > 0
    both = all(_trend(spinning.boundary(axial, mode), buckling) < 0 for mode in ("1F", "1B"))
    forward = spinning.boundary(follower, "1F")
    backward = spinning.boundary(follower, "1B")
    at = float(np.interp(buckling, forward.x, forward.y))
    low = float(np.interp(buckling, backward.x, backward.y))
    slow = lumped(rotor, 1.0, tangency=1.0)
    slow_forward = [float(boundary_frequencies(slow, load, 0.0)[1]) / 2 for load in (0.0, buckling)]
    crossing = _first_zero(spinning.boundary(axial, "1B"))
    # a line has a gap where its frequency is complex; the last sample before it is the meeting
    gaps = [(line.x, np.isnan(line.y)) for line in rest.group(follower) if np.isnan(line.y).any()]
    met = min((float(x[max(int(gap.argmax()) - 1, 0)]) for x, gap in gaps), default=np.inf)
    return (
        Statement(
            f"{rest.title}: all curves are symmetric about ω̄ = 0.",
            "Forward and backward frequencies are "
            + say(symmetric, "equal in size.", "not equal in size."),
            judge(symmetric),
        ),
        Statement(
            f"{rest.title}: both frequencies decrease with the axial load; the first increases "
            "with the follower load.",
            f"Up to the buckling load: {say(fall, 'true', 'not true')} of the axial, "
            f"{say(rise, 'true', 'not true')} of the follower load."
            + say(bool(gaps), f" Under the follower load 1 and 2 meet at p̄ = {met:.4f}.", ""),
            judge(fall, rise),
        ),
        Statement(
            f"{spinning.title}: 1F and 1B decrease with the axial load until it exceeds 2.3558.",
            say(both, "Both fall", "Not both fall")
            + f" in size; 1B reaches ω̄ = 0 at p̄ = {crossing:.4f}.",
            judge(both),
            "There the linear coefficients buckle; p̄_cr is the exact buckling load "
            f"{buckling:.4f}.",
        ),
        Statement(
            f"{spinning.title}: with the follower load 1F increases and 1B decreases.",
            f"From p̄ = 0 to p̄_cr 1B goes from {backward.y[0]:.4f} to {low:.4f}, 1F from "
            f"{forward.y[0]:.4f} to {at:.4f}.",
            judge(
                _trend(forward, buckling) > 0,
                _trend(backward, buckling, size=False) < 0,
            ),
            f"At Ω̄ = 1, 1F goes from {slow_forward[0]:.4f} to {slow_forward[1]:.4f}. A fall at "
            f"{spinning.title} is what the text's own reading of Fig. 7(c), “shifted inwardly”, "
            "needs.",
        ),
    )


def _onset(panel: Chart, group: str) -> float:
    """Return the steady load that makes the rotor unstable by itself, inf if none does."""
    return min((float(one.x[0]) for one in panel.unstable if one.group == group), default=np.inf)


def _table(variant: Variant) -> str:
    """Write the pairs that make a tongue with their places and growth."""
    scale = fundamental_frequency(variant.system)
    return ", ".join(
        f"{name} {row.centre / scale:.3f} ({row.growth_per_load * variant.reference_load:.3f})"
        for name, row in tongues(variant).items()
    )


def _read_floquet(
    panels: Panels, rotor: ShaftDisk, spin_speeds: Sequence[float]
) -> tuple[Statement, ...]:
    """Compare what the text says with what Floquet finds unstable."""
    reference = float(critical_load(rotor.shear))
    kinds = ("axial force", "follower force")

    def variant(spin: float, tangency: float, factor: float) -> Variant:
        system = lumped(rotor, spin, tangency)
        return Variant(kinds[tangency > 0], "solid", system, factor, reference)

    pairs = list(zip(panels, spin_speeds, strict=True))
    axial = [[variant(spin, 0.0, factor) for factor in (0.0, 0.5)] for spin in spin_speeds]
    follower = [variant(spin, 1.0, 0.5) for spin in spin_speeds]
    roots = [[root(one) for one in row] for row in axial]
    spinning = [one for one in follower if float(one.system.spin_speed) != 0]
    onsets = [[_onset(panel, kind) for kind in kinds] for panel in panels]
    return (
        Statement(
            "The whirl speeds fall with the axial load; this is the reason why the first unstable "
            "regions shift left.",
            f"The tongue {PRINCIPAL} hangs from the sum of both: θ/ω_n from p̄ = 0 to 0.5 p̄_cr "
            f"{by_panel(panels, roots)}. All tongues at 0.5 p̄_cr, θ/ω_n and growth over β_d: "
            + "; ".join(
                f"{panel.title}: {_table(row[1])}" for panel, row in zip(panels, axial, strict=True)
            )
            + ".",
            uphold(*(row[1] < row[0] for row in roots)),
            "Sums of opposite whirls only: an axial pulsation makes no two of one direction grow.",
        ),
        Statement(
            "The characteristics of the first unstable regions under the follower load can be "
            "expected from 1F and 1B.",
            f"Spinning, 1F and 1B grow together at {listed([growth(one) for one in spinning])} "
            "times β_d. All tongues at 0.5 p̄_cr, θ/ω_n and growth over β_d: "
            + "; ".join(
                f"{panel.title}: {_table(one)}" for panel, one in zip(panels, follower, strict=True)
            )
            + ".",
            uphold(*(growth(one) > 0 for one in spinning)),
            "What lies in the first regions is 1B with 2B, a difference of two speeds.",
        ),
        Statement(
            "The loads are measured by the static buckling load of the non-rotating shaft.",
            "The steady load alone makes the rotor unstable, axial and follower, from "
            + "; ".join(
                f"{panel.title}: p̄ = {a:.4f}, {b:.4f}"
                for (panel, _), (a, b) in zip(pairs, onsets, strict=True)
            )
            + f"; p̄_cr = {reference:.4f}.",
            uphold(*(abs(row[0] / reference - 1) < 0.02 for row in onsets)),
            "Spinning, the gyroscopic moment holds the buckled shaft until 1B, then a forward "
            "whirl, meets 1F; any external damping takes this away. Under the follower force the "
            "spin brings flutter nearer.",
        ),
    )
