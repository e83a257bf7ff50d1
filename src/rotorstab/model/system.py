"""The linear system that every analysis takes: M q̈ + D q̇ + K(p̄) q = 0."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from .._arguments import LARGEST, choice, number, numbers
from .._types import AnyArray, Array, ArrayLike, Complex
from ..rotors.shaft_disk import ShaftDisk
from .stiffness import (
    NEAR_POLE,
    exact_harmonics,
    exact_stiffness,
    largest_exact_load,
    linear_stiffness,
    pole_harmonics,
    refuse_peaks,
)

__all__ = ["System", "fundamental_frequency", "lumped", "single_speed"]


@dataclass(frozen=True, eq=False)
class System:
    """Matrices of a rotor in complex coordinates U = V + jW, Ψ = Γ − jB.

    M q̈ + D q̇ + K(p̄) q = 0 with D = −jΩ̄ H + C_e + C_i and K(p̄) = Ka + p̄ Kb − jΩ̄ C_i
    (or the exact K of the lumped shaft in place of Ka + p̄ Kb). Arrays are read-only.

    Parameters
    ----------
    mass : (n, n) float
        M, symmetric positive definite.
    gyroscopic : (n, n) float
        H, the gyroscopic matrix per unit of spin speed.
    external_damping, internal_damping : (n, n) float
        C_e and C_i; the internal (rotating) one also acts as −jΩ̄ C_i on q.
    elastic, geometric : (n, n) float
        Ka and Kb.
    spin_speed : (...) float
        Ω̄; an array gives one system per speed, which broadcasts against loads.
    tangency : float
        μ, 0 axial to 1 follower.
    exact_shear : float or None
        Φ if K(p̄) is the exact one of the lumped shaft, None for the linear law.
    """

    mass: Array
    gyroscopic: Array
    external_damping: Array
    internal_damping: Array
    elastic: Array
    geometric: Array
    spin_speed: Array
    tangency: float = 0.0
    exact_shear: float | None = None

    def __post_init__(self) -> None:
        """Make every array read-only."""
        for name in (
            "mass",
            "gyroscopic",
            "external_damping",
            "internal_damping",
            "elastic",
            "geometric",
            "spin_speed",
        ):
            array = np.asarray(getattr(self, name))
            if array.flags.writeable or array.base is not None or array.dtype != np.float64:
                array = np.array(array, dtype=np.float64)
                array.flags.writeable = False
            object.__setattr__(self, name, array)

    @property
    def size(self) -> int:
        """Number n of complex degrees of freedom."""
        return int(self.mass.shape[0])

    @property
    def is_damped(self) -> bool:
        """Whether any damping is present."""
        return bool(self.external_damping.any() or self.internal_damping.any())

    @property
    def is_linear(self) -> bool:
        """Whether the stiffness is linear in the load."""
        return self.exact_shear is None

    @property
    def largest_load(self) -> float:
        """Load [EI/L²] up to which charts go: 0.1 % below the exact stiffness's pole, else inf."""
        if self.exact_shear is None:
            return math.inf
        return float(largest_exact_load(self.exact_shear)) * (1 - NEAR_POLE)

    def at_speed(self, spin_speed: ArrayLike) -> System:
        """Return the same rotor at another spin speed Ω̄ (...)."""
        return replace(self, spin_speed=numbers("spin_speed", spin_speed, -LARGEST, LARGEST))

    def spin_matrix(self) -> Array:
        """Return Ω̄ H (..., n, n): jD of the undamped system, real."""
        return self.spin_speed[..., None, None] * self.gyroscopic

    def damping(self) -> Complex:
        """Return D (..., n, n)."""
        return self.external_damping + self.internal_damping - 1j * self.spin_matrix()

    def load_stiffness(self, load: ArrayLike) -> Array:
        """Return K(p̄) without the rotating damping's −jΩ̄ C_i.

        Parameters
        ----------
        load : (...) float
            p̄ [EI/L²].

        Returns
        -------
        (..., n, n) float
        """
        load = numbers("load", load, -LARGEST, LARGEST)
        if self.exact_shear is not None:
            return exact_stiffness(load, self.exact_shear, self.tangency)
        return self.elastic + load[..., None, None] * self.geometric

    def stiffness(self, load: ArrayLike) -> AnyArray:
        """Return K(p̄), the stiffness that multiplies q, rotating damping included.

        Parameters
        ----------
        load : (...) float
            p̄ [EI/L²]; broadcasts against the spin speed.

        Returns
        -------
        (..., n, n) float, or complex with rotating damping

        Raises
        ------
        ValueError
            If the load is not finite, or past the pole of the exact stiffness.
        """
        stiffness = self.load_stiffness(load)
        if not self.internal_damping.any():
            return stiffness
        return stiffness - 1j * self.spin_speed[..., None, None] * self.internal_damping

    def load_harmonics(
        self, static_load: ArrayLike, pulsating_load: ArrayLike, count: int = 1
    ) -> list[Array]:
        """Return K₀ … K_count of K(p̄₀ + p̄_t cos φ) = Σ K_m cos mφ.

        Parameters
        ----------
        static_load, pulsating_load : (...) float
            p̄₀ and p̄_t [EI/L²].
        count : int
            Highest harmonic.

        Returns
        -------
        list of (..., n, n) float
            Exact for the linear law (K₂ and higher are 0), to rounding for the exact law.

        Raises
        ------
        ValueError
            If a load is not finite, or the peak load is past the pole of the exact stiffness.
        """
        static, pulsating = np.broadcast_arrays(
            numbers("static_load", static_load), numbers("pulsating_load", pulsating_load)
        )
        if self.exact_shear is None:
            zero = np.zeros((*static.shape, self.size, self.size))
            first = pulsating[..., None, None] * self.geometric
            return [self.load_stiffness(static), first, *[zero] * (count - 1)][: count + 1]
        refuse_peaks(static, pulsating, self.exact_shear)
        loads = static, pulsating, self.exact_shear
        harmonics = exact_harmonics(*loads, self.tangency, count)
        harmonics[..., 1, 1] += pole_harmonics(*loads, count)
        return list(harmonics)


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
    """Return ω_n, the lowest natural frequency at Ω̄ = 0, p̄ = 0, undamped.

    Parameters
    ----------
    system : System

    Returns
    -------
    float
        ω_n [√(EI/(ρAL⁴))].

    Examples
    --------
    >>> round(fundamental_frequency(lumped(ShaftDisk(), 0.0)), 7)
    0.6466913
    """
    squares = np.linalg.eigvals(np.linalg.solve(system.mass, system.elastic))
    return float(np.sqrt(squares.real.min()))


def lumped(
    rotor: ShaftDisk,
    spin_speed: ArrayLike,
    tangency: float = 0.0,
    external_damping: float = 0.0,
    internal_damping: float = 0.0,
    stiffness: str = "linear",
) -> System:
    """Return the paper's two-degree-of-freedom model, Eqs. (7)–(17).

    Parameters
    ----------
    rotor : ShaftDisk
        Needs a disk: `disk_mass` and `diametral_inertia` above 0.
    spin_speed : (...) float
        Ω̄ [√(EI/(ρAL⁴))].
    tangency : float
        μ, in [0, 1]: 0 axial, 1 follower.
    external_damping, internal_damping : float
        Damping ratios ζ_e, ζ_i, 0 or more (beyond the paper): C_e = 2ζ_e ω_n M and
        C_i = (2ζ_i/ω_n) Ka, acting on q̇ and on q̇ − jΩ̄q.
    stiffness : {"linear", "exact"}
        Eq. (9) or Appendix A.

    Returns
    -------
    System
        Shapes (2, 2); `spin_speed` keeps its shape.

    Raises
    ------
    ValueError
        If an argument is out of range.

    Notes
    -----
    The shaft's own mass is neglected: good for M̄_D ≥ 3 or so, and for the first mode.

    Examples
    --------
    >>> lumped(ShaftDisk(), 2.0).size
    2
    """
    disk_mass = number("disk_mass", rotor.disk_mass, 0.0, open_low=True)
    inertia = number("diametral_inertia", rotor.diametral_inertia, 0.0, open_low=True)
    tangency = number("tangency", tangency, 0.0, 1.0)
    external = number("external_damping", external_damping, 0.0, LARGEST)
    internal = number("internal_damping", internal_damping, 0.0, LARGEST)
    law = choice("stiffness", stiffness, ("linear", "exact"))
    elastic, geometric = linear_stiffness(rotor.shear, tangency)
    mass = np.diag([disk_mass, inertia])
    system = System(
        mass=mass,
        gyroscopic=np.diag([0.0, rotor.polar_inertia]),
        external_damping=np.zeros((2, 2)),
        internal_damping=np.zeros((2, 2)),
        elastic=elastic,
        geometric=geometric,
        spin_speed=numbers("spin_speed", spin_speed, -LARGEST, LARGEST),
        tangency=tangency,
        exact_shear=rotor.shear if law == "exact" else None,
    )
    if external == 0 and internal == 0:
        return system
    frequency = fundamental_frequency(system)
    return replace(
        system,
        external_damping=2 * external * frequency * mass,
        internal_damping=2 * internal / frequency * elastic,
    )
