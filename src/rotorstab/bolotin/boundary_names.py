"""Names of Bolotin's boundaries by the whirl mode that each one starts from."""

from __future__ import annotations

import numpy as np

from .._numerics.two_by_two import determinant, entries
from .._tolerances import SAME_START
from .._types import Array, Complex, Mask
from ..model.system import System
from ..whirl.campbell import load_frequency_curves
from ..whirl.frequencies import frequencies_by_eigenvalues
from ..whirl.mode_names import mode_names, names_of
from .boundaries import has_paper_form

__all__ = ["boundary_names"]

_LOADS = 200  # steps in which modes are followed past buckling or flutter


def boundary_names(system: System, static: Array, squares: Complex) -> tuple[str, ...]:
    """Name each column of λ (m, 2n) by the whirl mode whose ω² = λ it has at p̄_t = 0.

    Parameters
    ----------
    system : System
        It has one spin speed.
    static : () float
        p̄₀ [EI/L²].
    squares : (m, 2n) complex
        λ over ascending pulsating loads, the first of which is 0; m is 2 or more.

    Returns
    -------
    tuple of str
    """
    first = squares[0]
    if system.planes:
        return _names_of_planes(system, float(static), squares)
    spinning = bool(system.spin_matrix().any())
    if spinning and has_paper_form(system) and not first.imag.any() and first.real[0] > 0:
        return _names_by_direction(_is_forward(system, static, first.real))
    frequencies = frequencies_by_eigenvalues(system, static)
    if frequencies.imag.any() and not system.is_damped:
        # past buckling or flutter a mode keeps the name that it has at no load
        curves = load_frequency_curves(system, static * np.linspace(0.0, 1.0, _LOADS))
        frequencies = curves.frequencies[-1]
    starts = (frequencies**2).real.tolist()
    scale = max(map(abs, starts))
    rounded = [round(start / scale, SAME_START) for start in starts]
    # 1B before 1F where both start from one point: the left boundary is the backward one
    labels = sorted(zip(rounded, mode_names(system.size), strict=True))
    # the second row, where columns that start together have parted
    columns = np.argsort(squares[1].real, kind="stable").tolist()
    named = {column: name for column, (_, name) in zip(columns, labels, strict=True)}
    return tuple(named[column] for column in range(len(named)))


def _names_of_planes(system: System, static: float, squares: Complex) -> tuple[str, ...]:
    """Return the names of boundaries of two planes: each motion has two."""
    roots = frequencies_by_eigenvalues(system, np.asarray(static))
    names = names_of(system, static, roots)
    upper = range(system.size, 2 * system.size)
    starts = sorted(((roots[i] ** 2).real, names[i]) for i in upper for _ in range(2))
    columns = np.argsort(squares[1].real, kind="stable").tolist()
    named = {column: name for column, (_, name) in zip(columns, starts, strict=True)}
    return tuple(named[column] for column in range(len(named)))


def _is_forward(system: System, static: Array, squares: Array) -> Mask:
    """Return whether each λ (4,) of the spinning paper's rotor at p̄_t = 0 is a forward whirl's.

    At p̄_t = 0 Eq. (24) splits in two factors. With ω² = λ one of them is D + ωΩ̄Ī_P a = 0, which
    gives ω its sign; D = det(K − λM) and a = k₁₁ − λM̄_D.
    """
    k, m = entries(system.load_stiffness(static)), entries(system.mass)
    a = k[0] - squares * m[0]
    d = determinant((a, k[1], k[2], k[3] - squares * m[3]))
    return np.asarray(a * d * system.spin_speed < 0)


def _names_by_direction(forward: Mask) -> tuple[str, ...]:
    """Return the names of ascending boundaries, numbered within each direction of precession."""
    count = {"B": 0, "F": 0}
    names = []
    for direction in np.where(forward, "F", "B").tolist():
        count[direction] += 1
        names.append(f"{count[direction]}{direction}")
    return tuple(names)
