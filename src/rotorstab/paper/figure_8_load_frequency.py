"""Figure 8: whirl frequencies over the static load."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .._tolerances import NEGLIGIBLE
from ..bolotin.boundaries import boundary_frequencies
from ..charts.figure import Figure, Statement
from ..charts.structure import Chart, Curve
from ..model.lumped import lumped
from ..model.system import fundamental_frequency
from ..rotors.shaft_disk import BASE_CASE, ShaftDisk
from ..whirl.critical_loads import critical_load, flutter_load
from .arguments import LOAD_KINDS, lettered, parameters
from .floquet_numbers import PRINCIPAL, growth, root, tongues
from .load_frequency_panel import LoadedRotor, whirl_chart
from .region_figure import Variant
from .verdicts import by_panel, confirm, fixed, judge, listed, say

__all__ = ["figure_8"]

Panels = tuple[Chart, ...]

(_AXIAL, *_), (_FOLLOWER, *_) = LOAD_KINDS
_SAME_LOAD = 0.02  # part of p̄_cr up to which a load counts as the buckling load

_FLOQUET = (
    " Each upright line joins two whirls that a pulsation makes grow; its length is the θ of that "
    "tongue at that load. Strips: unstable without any pulsation."
)


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
        rotors = [
            LoadedRotor(group, style, lumped(rotor, spin, mu)) for group, style, mu in LOAD_KINDS
        ]
        panels.append(whirl_chart(letter, f"Ω̄ = {spin:g}", rotors, loads, buckling, floquet))
        for loaded in rotors:
            flutter = flutter_load(loaded.system) if loaded.system.tangency else np.inf
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


def _trend(line: Curve, up_to: float, size: bool = True) -> float:
    """Return +1 or −1 for a monotonic |y| (or y) over 0 to a load, 0 for neither."""
    inside = line.y[(line.x <= up_to) & np.isfinite(line.y)]
    steps = np.diff(np.abs(inside) if size else inside)
    rounding = NEGLIGIBLE * np.abs(inside).max(initial=0.0)
    return 1.0 if (steps >= -rounding).all() else -1.0 if (steps <= rounding).all() else 0.0


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
    """Compare what the text says with the curves, at rest and at the highest speed."""
    buckling = float(critical_load(rotor.shear))
    return *_read_at_rest(panels[0], buckling), *_read_spinning(panels[-1], rotor, buckling)


def _read_at_rest(panel: Chart, buckling: float) -> tuple[Statement, ...]:
    symmetric = all(
        np.allclose(
            panel.boundary(group, f"{n}F").y, -panel.boundary(group, f"{n}B").y, equal_nan=True
        )
        for group in (_AXIAL, _FOLLOWER)
        for n in (1, 2)
    )
    fall = all(_trend(panel.boundary(_AXIAL, mode), buckling) < 0 for mode in ("1F", "2F"))
    rise = _trend(panel.boundary(_FOLLOWER, "1F"), buckling) > 0
    # a line has a gap where its frequency is complex; the last sample before it is the meeting
    gaps = [(line.x, np.isnan(line.y)) for line in panel.group(_FOLLOWER)]
    meetings = [float(x[max(int(gap.argmax()) - 1, 0)]) for x, gap in gaps if gap.any()]
    meeting = f" Under the follower load 1 and 2 meet at p̄ = {min(meetings, default=np.inf):.4f}."
    return (
        Statement(
            f"{panel.title}: all curves are symmetric about ω̄ = 0.",
            "Forward and backward frequencies are "
            + say(symmetric, "equal in size.", "not equal in size."),
            judge(symmetric),
        ),
        Statement(
            f"{panel.title}: both frequencies decrease with the axial load; the first increases "
            "with the follower load.",
            f"Up to the buckling load: {say(fall, 'true', 'not true')} of the axial, "
            f"{say(rise, 'true', 'not true')} of the follower load."
            + say(bool(meetings), meeting, ""),
            judge(fall, rise),
        ),
    )


def _read_spinning(panel: Chart, rotor: ShaftDisk, buckling: float) -> tuple[Statement, ...]:
    both = all(_trend(panel.boundary(_AXIAL, mode), buckling) < 0 for mode in ("1F", "1B"))
    crossing = _first_zero(panel.boundary(_AXIAL, "1B"))
    forward, backward = panel.boundary(_FOLLOWER, "1F"), panel.boundary(_FOLLOWER, "1B")
    forward_end = float(np.interp(buckling, forward.x, forward.y))
    backward_end = float(np.interp(buckling, backward.x, backward.y))
    slow = lumped(rotor, 1.0, tangency=1.0)
    slow_forward = [float(boundary_frequencies(slow, load, 0.0)[1]) / 2 for load in (0.0, buckling)]
    return (
        Statement(
            f"{panel.title}: 1F and 1B decrease with the axial load until it exceeds 2.3558.",
            say(both, "Both fall", "Not both fall")
            + f" in size; 1B reaches ω̄ = 0 at p̄ = {crossing:.4f}.",
            judge(both),
            "There the linear coefficients buckle; p̄_cr is the exact buckling load "
            f"{buckling:.4f}.",
        ),
        Statement(
            f"{panel.title}: with the follower load 1F increases and 1B decreases.",
            f"From p̄ = 0 to p̄_cr 1B goes from {fixed(backward.y[0], 4)} to "
            f"{fixed(backward_end, 4)}, 1F from {fixed(forward.y[0], 4)} to "
            f"{fixed(forward_end, 4)}.",
            judge(
                _trend(forward, buckling) > 0,
                _trend(backward, buckling, size=False) < 0,
            ),
            f"At Ω̄ = 1, 1F goes from {slow_forward[0]:.4f} to {slow_forward[1]:.4f}. A fall at "
            f"{panel.title} is what the text's own reading of Fig. 7(c), “shifted inwardly”, "
            "needs.",
        ),
    )


def _onset(panel: Chart, group: str) -> float:
    """Return the static load that makes the rotor unstable by itself, inf if none does."""
    return min(
        (float(strip.x[0]) for strip in panel.unstable if strip.group == group), default=np.inf
    )


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

    def variants(tangency: float, factor: float) -> list[Variant]:
        systems = [lumped(rotor, spin, tangency) for spin in spin_speeds]
        return [Variant("rotor", "solid", system, factor, reference) for system in systems]

    return (
        _read_axial(panels, variants(0.0, 0.0), variants(0.0, 0.5)),
        _read_follower(panels, variants(1.0, 0.5)),
        _read_onsets(panels, reference),
    )


def _tables(panels: Panels, variants: Sequence[Variant]) -> str:
    return "; ".join(
        f"{panel.title}: {_table(variant)}" for panel, variant in zip(panels, variants, strict=True)
    )


def _read_axial(
    panels: Panels, unloaded: Sequence[Variant], loaded: Sequence[Variant]
) -> Statement:
    roots = [[root(first), root(second)] for first, second in zip(unloaded, loaded, strict=True)]
    return Statement(
        "The whirl speeds fall with the axial load; this is the reason why the first unstable "
        "regions shift left.",
        f"The tongue {PRINCIPAL} begins at β_d = 0 at the sum of both: θ/ω_n from p̄ = 0 to "
        f"0.5 p̄_cr {by_panel(panels, roots)}. All tongues at 0.5 p̄_cr, θ/ω_n and growth over β_d: "
        f"{_tables(panels, loaded)}.",
        confirm(*(after < before for before, after in roots)),
        "Sums of opposite whirls only: an axial pulsation makes no two of one direction grow.",
    )


def _read_follower(panels: Panels, variants: Sequence[Variant]) -> Statement:
    rates = [growth(variant) for variant in variants if float(variant.system.spin_speed) != 0]
    return Statement(
        "The characteristics of the first unstable regions under the follower load can be "
        "expected from 1F and 1B.",
        f"Spinning, 1F and 1B grow together at {listed(rates)} "
        "times β_d. All tongues at 0.5 p̄_cr, θ/ω_n and growth over β_d: "
        f"{_tables(panels, variants)}.",
        confirm(*(rate > 0 for rate in rates)),
        "What lies in the first regions is 1B with 2B, a difference of two speeds.",
    )


def _read_onsets(panels: Panels, reference: float) -> Statement:
    onsets = [[_onset(panel, kind) for kind in (_AXIAL, _FOLLOWER)] for panel in panels]
    return Statement(
        "The loads are measured by the static buckling load of the non-rotating shaft.",
        "The static load alone makes the rotor unstable, axial and follower, from "
        + "; ".join(
            f"{panel.title}: p̄ = {axial:.4f}, {follower:.4f}"
            for panel, (axial, follower) in zip(panels, onsets, strict=True)
        )
        + f"; p̄_cr = {reference:.4f}.",
        confirm(*(abs(axial / reference - 1) < _SAME_LOAD for axial, _ in onsets)),
        "Spinning, the gyroscopic moment holds the buckled shaft until 1B, then a forward "
        "whirl, meets 1F; any external damping takes this away. Under the follower force the "
        "spin brings flutter nearer.",
    )
