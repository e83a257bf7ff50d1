"""The linear system that every analysis takes, M q̈ + D q̇ + K(p̄) q = 0."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from .._arguments import LARGEST, LARGEST_LOAD, numbers
from .._tolerances import MAP_SHORT_OF_POLE
from .._types import AnyArray, Array, ArrayLike, Complex, Mask
from .periodic_load import COSINE, PeriodicLoad
from .stiffness_law import StiffnessLaw

__all__ = ["System", "frequencies_at_rest", "fundamental_frequency", "single_speed"]

_OPTIONAL = ("cross_stiffness", "cross_damping", "spin_stiffness", "spin_softening")
_MATRICES = (
    "mass",
    "gyroscopic",
    "external_damping",
    "internal_damping",
    "elastic",
    "geometric",
)


@dataclass(frozen=True, eq=False)
class System:
    """Matrices of a rotor, in one of two kinds of coordinates.

    M q̈ + D q̇ + K(p̄) q = 0 with D = −jΩ̄ H + C_e + C_i − jC_c and
    K(p̄) = Ka + p̄ Kb − jΩ̄ C_i − jK_c (or K of another stiffness law in place of Ka + p̄ Kb).
    In coordinates that rotate with the shaft K also holds −jΩ̄ K_s − Ω̄² N. Its arrays are
    read-only copies.

    A rotor that is the same in all directions has complex coordinates U = V + jW, Ψ = Γ − jB: one
    root ω is one whirl, forward where it is positive. A rotor whose bearings differ in two
    directions has the coordinates (V, Γ) and j(W, −B) of its two `planes`, twice as
    many. In these its matrices are real as well: M, Ka and Kb hold one block for each plane, and
    H couples the planes, [[0, h], [h, 0]]. The roots then come in pairs ±ω.

    Parameters
    ----------
    mass : (n, n) float
        M, symmetric positive definite.
    gyroscopic : (n, n) float
        H, the gyroscopic matrix per unit of spin speed.
    external_damping, internal_damping : (n, n) float
        C_e and C_i. The internal damping rotates with the shaft: it acts on q̇ − jΩ̄q. With two
        planes it is a part of C_e, and of K_s with the same blocks across: `with_damping_ratios`.
    elastic, geometric : (n, n) float
        Ka and Kb.
    spin_speed : (...) float
        Ω̄ [√(EI/(ρAL⁴))]. An array gives one system per speed, which broadcasts against loads.
    tangency : float
        μ [-], from 0 (axial load) to 1 (follower load); Kb already contains it.
    law : StiffnessLaw or None
        K(p̄) of the lumped shaft, such as its exact stiffness; None for the linear law.
    cross_stiffness, cross_damping : (n, n) float or None
        K_c and C_c of cross-coupled bearings, None where there are none. With complex coordinates
        they are k_xy and c_xy of a bearing with k_yx = −k_xy and c_yx = −c_xy, with two planes
        [[0, k_xy], [−k_yx, 0]] and [[0, c_xy], [−c_yx, 0]].
    spin_stiffness, spin_softening : (n, n) float or None
        K_s, of damping that turns against the coordinates, and N of coordinates that rotate with
        the shaft; None where there is none.
    planes : bool
        Whether the coordinates are those of two planes.
    pulsation : PeriodicLoad
        Shape of the load over its period; a cosine unless given.

    Raises
    ------
    ValueError
        If another stiffness law meets another load than a cosine, or `internal_damping` two planes.

    References
    ----------
    Eqs. (7)–(17) of the source paper.
    """

    mass: Array
    gyroscopic: Array
    external_damping: Array
    internal_damping: Array
    elastic: Array
    geometric: Array
    spin_speed: Array
    tangency: float = 0.0
    law: StiffnessLaw | None = None
    cross_stiffness: Array | None = None
    cross_damping: Array | None = None
    spin_stiffness: Array | None = None
    spin_softening: Array | None = None
    planes: bool = False
    pulsation: PeriodicLoad = COSINE

    def __post_init__(self) -> None:
        """Make every array read-only."""
        if self.law is not None and self.pulsation != COSINE:
            raise ValueError(
                f"`pulsation` must be a cosine with the {self.law.name} stiffness law, "
                f"got {self.pulsation}"
            )
        for name in (*_MATRICES, *_OPTIONAL, "spin_speed"):
            array = np.asarray(getattr(self, name))
            if getattr(self, name) is None:
                continue
            if array.flags.writeable or array.base is not None or array.dtype != np.float64:
                array = np.array(array, dtype=np.float64)
                array.flags.writeable = False
            object.__setattr__(self, name, array)
        if self.planes and self.internal_damping.any():
            raise ValueError(
                "`internal_damping` must be zero with two planes: "
                "there it is a part of `external_damping` and of `spin_stiffness`"
            )

    @property
    def size(self) -> int:
        """Number n of coordinates: complex ones, or those of both planes."""
        return int(self.mass.shape[0])

    @property
    def is_damped(self) -> bool:
        """Whether any damping or cross coupling is present: motion cannot be run backwards."""
        parts = self.external_damping, self.internal_damping
        cross = self.cross_stiffness, self.cross_damping, self.spin_stiffness
        return any(part is not None and bool(part.any()) for part in (*parts, *cross))

    @property
    def is_reversible(self) -> bool:
        """Whether half a period tells the whole: no damping, and a load that is even in time."""
        return not self.is_damped and self.pulsation.is_even

    @property
    def is_rotating(self) -> bool:
        """Whether the coordinates rotate with the shaft; ω is then less by Ω̄ than at rest."""
        return self.spin_softening is not None

    @property
    def is_linear(self) -> bool:
        """Whether the stiffness is linear in the load."""
        return self.law is None

    @property
    def pole(self) -> float:
        """Load [EI/L²] at which the stiffness is infinite, inf if it is nowhere."""
        return math.inf if self.law is None else self.law.pole

    @property
    def largest_load(self) -> float:
        """Load [EI/L²] where charts end: 0.1 % below the pole of the stiffness, else inf."""
        return self.pole * (1 - MAP_SHORT_OF_POLE)

    def in_charts(self, load: ArrayLike) -> Mask:
        """Return where a load (...) [EI/L²] is below `largest_load`, so that charts have it."""
        return np.asarray(np.less(load, self.largest_load))

    def at_speed(self, spin_speed: ArrayLike) -> System:
        """Return the same rotor at another spin speed.

        Parameters
        ----------
        spin_speed : (...) float
            Ω̄ [√(EI/(ρAL⁴))].

        Returns
        -------
        System

        Raises
        ------
        ValueError
            If a speed is not finite or beyond ±1e9.
        """
        return replace(self, spin_speed=numbers("spin_speed", spin_speed, -LARGEST, LARGEST))

    def projected(self, basis: Array) -> System:
        """Return the system in other coordinates, or in fewer: q = T q′, every matrix TᵀAT.

        Parameters
        ----------
        basis : (n, k) float
            T.

        Returns
        -------
        System
            Shapes (k, k).

        Raises
        ------
        ValueError
            If the system has another stiffness law, which is known in its own coordinates only.
        """
        if self.law is not None:
            law = self.law.name
            raise ValueError(f"`system` must have the linear stiffness law, got the {law} one")
        names = [name for name in (*_MATRICES, *_OPTIONAL) if getattr(self, name) is not None]
        matrices = {name: basis.T @ getattr(self, name) @ basis for name in names}
        return replace(self, **matrices)

    def spin_matrix(self) -> Array:
        """Return Ω̄ H (..., n, n), which is jD of the undamped system and real."""
        return self.spin_speed[..., None, None] * self.gyroscopic

    def damping(self) -> Complex:
        """Return D = −jΩ̄ H + C_e + C_i − jC_c (..., n, n)."""
        crossed = self.spin_matrix()
        if self.cross_damping is not None:
            crossed = crossed + self.cross_damping
        return self.external_damping + self.internal_damping - 1j * crossed

    def cross_part(self) -> AnyArray:
        """Return −jΩ̄(C_i + K_s) − jK_c (..., n, n), what damping and bearings add to K.

        It does not depend on the load, and is a real 0 where there is neither.
        """
        crossed = np.zeros_like(self.mass) if self.cross_stiffness is None else self.cross_stiffness
        for part in (self.internal_damping, self.spin_stiffness):
            if part is not None and part.any():
                crossed = crossed + self.spin_speed[..., None, None] * part
        return -1j * crossed if crossed.any() else np.zeros_like(self.mass)

    def load_stiffness(self, load: ArrayLike) -> Array:
        """Return K(p̄) without the `cross_part`.

        Parameters
        ----------
        load : (...) float
            p̄ [EI/L²].

        Returns
        -------
        (..., n, n) float

        Raises
        ------
        ValueError
            If a load is not finite, or past the pole of the stiffness.
        """
        load = numbers("load", load, -LARGEST_LOAD, LARGEST_LOAD)
        if self.law is not None:
            return self.law.stiffness(load)
        stiffness = self.elastic + load[..., None, None] * self.geometric
        if self.spin_softening is None:
            return stiffness
        return stiffness - np.square(self.spin_speed)[..., None, None] * self.spin_softening

    def stiffness(self, load: ArrayLike) -> AnyArray:
        """Return K(p̄), the matrix that multiplies q, with the `cross_part`.

        Parameters
        ----------
        load : (...) float
            p̄ [EI/L²]; broadcasts against the spin speed.

        Returns
        -------
        (..., n, n) float, or complex with rotating damping or cross coupling

        Raises
        ------
        ValueError
            If the load is not finite, or past the pole of the stiffness.
        """
        stiffness = self.load_stiffness(load)
        if not self.is_damped:
            return stiffness
        return stiffness + self.cross_part()

    def load_harmonics(
        self, static_load: ArrayLike, pulsating_load: ArrayLike, count: int = 1
    ) -> list[Array]:
        """Return K₀ … K_count of K(p̄) = Σ K_m cos mφ at an even load, without `cross_part`.

        Parameters
        ----------
        static_load, pulsating_load : (...) float
            p̄₀ and p̄_t [EI/L²].
        count : int
            Highest harmonic.

        Returns
        -------
        list of (..., n, n) float
            Exact for the linear law (K₂ and higher are 0), to rounding for another law.

        Raises
        ------
        ValueError
            If a load is not finite, the peak load is past the pole of the stiffness, or the
            pulsation has sine terms.
        """
        if not self.pulsation.is_even:
            raise ValueError(f"`system` must have an even pulsation, got {self.pulsation}")
        static, pulsating = np.broadcast_arrays(
            numbers("static_load", static_load), numbers("pulsating_load", pulsating_load)
        )
        if self.law is None:
            swing = pulsating[..., None, None] * self.geometric
            cosine = [*self.pulsation.cosine, *[0.0] * count][:count]
            return [self.load_stiffness(static), *(c * swing for c in cosine)]
        return list(self.law.harmonics(static, pulsating, count))


def single_speed(system: System) -> float:
    """Return the spin speed of a system; refuse a system that has several, or none.

    Parameters
    ----------
    system : System

    Returns
    -------
    float
        Ω̄ [√(EI/(ρAL⁴))].

    Raises
    ------
    ValueError
        If the spin speed is an array.
    """
    if system.spin_speed.ndim:
        shape = system.spin_speed.shape
        raise ValueError(f"`system` must have one spin speed, got an array of shape {shape}")
    return float(system.spin_speed)


def fundamental_frequency(system: System) -> float:
    """Return ω_n, the lowest natural frequency of the undamped rotor at Ω̄ = 0 and p̄ = 0.

    Parameters
    ----------
    system : System

    Returns
    -------
    float
        ω_n [√(EI/(ρAL⁴))].

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> round(fundamental_frequency(lumped(ShaftDisk(), 0.0)), 7)
    0.6466913
    """
    return float(frequencies_at_rest(system)[0])


def frequencies_at_rest(system: System) -> Array:
    """Return the natural frequencies of the undamped rotor at Ω̄ = 0 and p̄ = 0.

    Parameters
    ----------
    system : System

    Returns
    -------
    (n,) float
        In rising order [√(EI/(ρAL⁴))]: the square roots of the eigenvalues of M⁻¹Ka.
    """
    squares = np.linalg.eigvals(np.linalg.solve(system.mass, system.elastic))
    return np.asarray(np.sqrt(np.sort(squares.real)))
