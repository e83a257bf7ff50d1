"""Symmetric splitting schemes, and the numbers of steps that they take."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["MAP_SCHEME", "POINT_SCHEME", "Scheme", "divisible"]


@dataclass(frozen=True)
class Scheme:
    """A symmetric composition of exact mean flows (drifts) and of kicks by the pulsating load.

    One step of length h is drift a₀h, kick b₁, drift a₁h, …, kick b_s, drift a_s h. A kick is
    h b ΔK + h³ g ΔK M⁻¹ ΔK with ΔK = K(p̄(t)) − K(p̄_ref).

    Parameters
    ----------
    drifts : tuple of float
        a₀ … a_s.
    kicks : tuple of float
        b₁ … b_s.
    gradient : float
        g.
    """

    drifts: tuple[float, ...]
    kicks: tuple[float, ...]
    gradient: float = 0.0

    @property
    def joined(self) -> float:
        """The last drift of a step and the first of the next as one."""
        return self.drifts[-1] + self.drifts[0]


def _symmetric(drifts: tuple[float, ...], kicks: tuple[float, ...]) -> Scheme:
    """Return the scheme whose first half is given; the middle coefficients make each sum 1."""
    last = 0.5 - sum(kicks)
    return Scheme((*drifts, 1 - 2 * sum(drifts), *drifts[::-1]), (*kicks, last, last, *kicks[::-1]))


# SRKNa14, order 6: Blanes, Moan, J. Comput. Appl. Math. 142 (2002) 313, Table 3
POINT_SCHEME = _symmetric(
    (
        0.0378593198406116,
        0.102635633102435,
        -0.0258678882665587,
        0.314241403071447,
        -0.130144459517415,
        0.106417700369543,
        -0.00879424312851058,
    ),
    (
        0.09171915262446165,
        0.183983170005006,
        -0.05653436583288827,
        0.004914688774712854,
        0.143761127168358,
        0.328567693746804,
    ),
)
"""Scheme of single points: order 6."""

# One kick a step with the gradient term: M. Takahashi, M. Imada, J. Phys. Soc. Jpn 53 (1984) 3765
MAP_SCHEME = Scheme((0.5, 0.5), (1.0,), -1 / 12)
"""Scheme of charts: effective order 4.

The error of Y is of order h². A change of variables, which leaves every eigenvalue as it is,
removes that part; what is left is of order h⁴. The characteristic polynomial of a monodromy
therefore has errors h⁴, h⁶ … only.
"""


def divisible(count: int) -> int:
    """Return a number of steps at most a sixteenth larger that many numbers divide.

    `integrator.propagate` cuts a period into equal segments of whole steps. A prime number of
    steps cannot be cut, and takes ten times as long.
    """
    unit = 1 << max(0, count.bit_length() - 5)
    return -(-count // unit) * unit
