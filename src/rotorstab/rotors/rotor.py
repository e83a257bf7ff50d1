"""Any rotor: shaft sections, disks, bearings and clamps, and where the load acts."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, TypeVar

from .._arguments import number
from .._tolerances import SAME_POSITION
from .parts import AxialLoad, Bearing, Disk
from .sections import ShaftSection

if TYPE_CHECKING:
    from .._types import ArrayLike
    from ..model.rotor_system import RotorShapes
    from ..model.system import System

__all__ = ["Rotor"]

Part = TypeVar("Part")

_WHOLE_SHAFT = AxialLoad()


def _parts(name: str, kind: type[Part], parts: Iterable[Part]) -> tuple[Part, ...]:
    """Return parts as a tuple; refuse one of another kind."""
    found = (parts,) if isinstance(parts, kind) else tuple(parts)
    for part in found:
        if not isinstance(part, kind):
            raise ValueError(
                f"`{name}` must hold objects of {kind.__name__}, got {type(part).__name__}"
            )
    return found


@dataclass(frozen=True)
class Rotor:
    """A rotor of any number of shaft sections, disks and bearings, in SI units.

    Parameters
    ----------
    sections : tuple of ShaftSection
        From left to right; x = 0 is the left end.
    disks : tuple of Disk
    bearings : tuple of Bearing
    clamps : tuple of float
        Positions [m] where the shaft neither moves nor turns.
    load : AxialLoad
        Where the longitudinal load acts; along the whole shaft by default.

    Raises
    ------
    ValueError
        If there is no section, or a disk, a bearing, a clamp or an end of the load lies off the
        shaft, or the two ends of the load are one point.

    Examples
    --------
    >>> from rotorstab import Bearing, Disk, Material, ShaftSection, whirl_frequencies
    >>> steel = Material(youngs_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
    >>> rotor = Rotor(
    ...     sections=(ShaftSection(length=1.5, outer_diameter=0.05, material=steel),),
    ...     disks=(Disk(0.75, mass=30.0, diametral_inertia=0.2, polar_inertia=0.35),),
    ...     bearings=(Bearing(0.0, kxx=1e6), Bearing(1.5, kxx=1e6)),
    ... )
    >>> system = rotor.system(spin_speed=400.0)
    >>> round(rotor.critical_load() / 1e3, 1)  # kN
    283.4
    """

    sections: tuple[ShaftSection, ...]
    disks: tuple[Disk, ...] = ()
    bearings: tuple[Bearing, ...] = ()
    clamps: tuple[float, ...] = ()
    load: AxialLoad = _WHOLE_SHAFT

    def __post_init__(self) -> None:
        """Check and normalise every field."""
        for name, kind in (("sections", ShaftSection), ("disks", Disk), ("bearings", Bearing)):
            object.__setattr__(self, name, _parts(name, kind, getattr(self, name)))
        if not self.sections:
            raise ValueError("`sections` must hold one ShaftSection or more, got none")
        for name in ("disks", "bearings"):
            placed = tuple(
                replace(part, position=self._on_shaft(f"{name}[{at}].position", part.position))
                for at, part in enumerate(getattr(self, name))
            )
            object.__setattr__(self, name, placed)
        clamps = self.clamps if isinstance(self.clamps, Iterable) else (self.clamps,)
        clamps = tuple(self._on_shaft(f"clamps[{at}]", place) for at, place in enumerate(clamps))
        object.__setattr__(self, "clamps", clamps)
        if not isinstance(self.load, AxialLoad):
            raise ValueError(f"`load` must be an AxialLoad, got {type(self.load).__name__}")
        object.__setattr__(self, "load", self._placed_load())

    def _on_shaft(self, name: str, position: float) -> float:
        """Return a position; one that exceeds the end by rounding only is the end."""
        length = self.length
        if length < position <= length * (1 + SAME_POSITION):
            return length
        return number(name, position, 0.0, length)

    def _placed_load(self) -> AxialLoad:
        load = self.load
        start = self._on_shaft("load.start", load.start)
        end = None if load.end is None else self._on_shaft("load.end", load.end)
        if abs(start - (self.length if end is None else end)) <= SAME_POSITION * self.length:
            raise ValueError(
                f"`load.start` and `load.end` must be two points of the shaft, got {start:g} twice"
            )
        return replace(load, start=start, end=end)

    @property
    def length(self) -> float:
        """Length of the shaft [m]."""
        return math.fsum(section.length for section in self.sections)

    @property
    def load_end(self) -> float:
        """Where the load is applied [m]."""
        return self.length if self.load.end is None else self.load.end

    @property
    def is_isotropic(self) -> bool:
        """Whether the rotor is the same in every direction, so that complex coordinates serve."""
        return all(bearing.is_isotropic for bearing in self.bearings)

    def system(self, spin_speed: ArrayLike, elements: int = 6, modes: int | None = None) -> System:
        """Return the matrices of the rotor by Timoshenko finite elements, for every analysis.

        Parameters
        ----------
        spin_speed : (...) float
            Ω [rad/s].
        elements : int
            Number of elements of each section. Disks, bearings, clamps and the ends of the load cut
            a section into pieces, and each piece gets at least its share.
        modes : int, optional
            Number of coordinates of each plane to which the system is reduced, for live use. By
            default it is not reduced.

        Returns
        -------
        System
            In SI units: loads in N, frequencies and growth rates in rad/s and 1/s. With isotropic
            bearings it has n complex coordinates (deflection and slope of each free station), else
            the 2n coordinates of two planes.

        Raises
        ------
        ValueError
            If an argument is out of range, the rotor would have more than 400 elements, or no
            coordinate is free.

        See Also
        --------
        rotorstab.model.rotor_system.rotor_system : The same, with what the reduction costs.
        """
        from ..model.rotor_system import rotor_system

        return rotor_system(self, spin_speed, elements, modes)

    def shapes(self, elements: int = 6, modes: int | None = None) -> RotorShapes:
        """Return how each coordinate of the rotor's system bends the shaft.

        Parameters
        ----------
        elements : int
        modes : int, optional
            As for `system`.

        Returns
        -------
        RotorShapes
            Deflection and slope at every station, to draw a motion of the system's coordinates.

        Raises
        ------
        ValueError
            As `system`.
        """
        from ..model.rotor_system import rotor_shapes

        return rotor_shapes(self, elements, modes)

    def critical_load(self, elements: int = 6) -> float:
        """Return the smallest compression that buckles the resting rotor.

        Parameters
        ----------
        elements : int
            Number of elements of each section.

        Returns
        -------
        float
            [N]; inf if no compression buckles it, as a follower load may not.

        Raises
        ------
        ValueError
            If nothing holds the rotor or its stiffness is not positive: then it has no position of
            rest that a load could make unstable.

        See Also
        --------
        rotorstab.model.buckling.buckling_load : The same, with the equations.
        """
        from ..model.buckling import buckling_load

        return buckling_load(self, elements)

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Rotor:
        """Return the rotor of a rotor file; see `rotorstab.rotors.rotor_file` for its format.

        Parameters
        ----------
        path : str or path-like
            A TOML file.

        Returns
        -------
        Rotor

        Raises
        ------
        ValueError
            If the file is no rotor file; the message says where.
        OSError
            If the file cannot be read.
        """
        from .rotor_file import read_rotor

        return read_rotor(path)

    def write(self, path: str | os.PathLike[str]) -> None:
        """Write the rotor as a rotor file; `read` gives an equal rotor back.

        Parameters
        ----------
        path : str or path-like
            An existing file is replaced.

        Raises
        ------
        OSError
            If the file cannot be written.
        """
        from .rotor_file import write_rotor

        write_rotor(self, path)

    @classmethod
    def from_ross(cls, path: str | os.PathLike[str], spin_speed: float | None = None) -> Rotor:
        """Return the rotor of a ROSS file, which is read without ROSS.

        Parameters
        ----------
        path : str or path-like
            A rotor that ROSS has saved as TOML or JSON, of its versions 2 or 3.
        spin_speed : float, optional
            Speed [rad/s] at which bearing coefficients that depend on the speed are taken. By
            default it is the rated speed of the file, or else the middle of their table.

        Returns
        -------
        Rotor

        Raises
        ------
        ValueError
            If the file is no such rotor, or holds what this library cannot represent; the message
            says where.
        OSError
            If the file cannot be read.

        Warns
        -----
        NotCarriedOver
            For everything in the file that the rotor does not have.

        See Also
        --------
        rotorstab.rotors.ross : What is carried over, and how.
        """
        from .ross import read_ross

        return read_ross(path, spin_speed)
