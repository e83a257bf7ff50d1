"""Sections of a shaft with their sleeves, and what a beam of such a cross-section is made of."""

from __future__ import annotations

import math
from dataclasses import dataclass

from .._arguments import number
from .fields import normalise
from .materials import Material, shear_coefficient

__all__ = ["SectionProperties", "ShaftSection", "Sleeve"]

_SMALLEST, _LARGEST = 1e-6, 1e6  # of a length or a diameter [m]


def _check_tube(part: ShaftSection | Sleeve) -> None:
    """Check diameters, material and shear coefficient of a tube; a None coefficient is computed."""
    if not isinstance(part.material, Material):
        raise ValueError(f"`material` must be a Material, got {type(part.material).__name__}")
    normalise(part, {"outer_diameter": (_SMALLEST, _LARGEST), "inner_diameter": (0.0, _LARGEST)})
    if part.inner_diameter >= part.outer_diameter:
        raise ValueError(
            f"`inner_diameter` must be smaller than `outer_diameter` = {part.outer_diameter:g}, "
            f"got {part.inner_diameter:g}"
        )
    if part.shear_coefficient is None:
        material, ratio = part.material, part.inner_diameter / part.outer_diameter
        value = shear_coefficient(material.youngs_modulus, material.shear_modulus, ratio)
    elif part.shear_coefficient == math.inf:
        value = math.inf
    else:
        value = number("shear_coefficient", part.shear_coefficient, 0.0, 1.0, open_low=True)
    object.__setattr__(part, "shear_coefficient", value)


@dataclass(frozen=True)
class SectionProperties:
    """What a beam of one cross-section is made of.

    Parameters
    ----------
    bending : float
        EI [N m²].
    shear : float
        κGA [N], inf without shear deformation.
    mass : float
        ρA [kg/m].
    inertia : float
        ρI [kg m], the rotary inertia about a diameter per unit of length.
    """

    bending: float
    shear: float
    mass: float
    inertia: float


def _tube_properties(part: ShaftSection | Sleeve) -> SectionProperties:
    """Return EI, κGA, ρA and ρI of one tube."""
    outer, inner, material = part.outer_diameter, part.inner_diameter, part.material
    area = math.pi * (outer - inner) * (outer + inner) / 4
    second_moment = area * (outer**2 + inner**2) / 16
    assert part.shear_coefficient is not None  # `_check_tube` has put one
    return SectionProperties(
        bending=material.youngs_modulus * second_moment,
        shear=part.shear_coefficient * material.shear_modulus * area,
        mass=material.density * area,
        inertia=material.density * second_moment,
    )


@dataclass(frozen=True)
class Sleeve:
    """A tube around a shaft section that bends and turns with it.

    Parameters
    ----------
    outer_diameter, inner_diameter : float
        [m].
    material : Material
    shear_coefficient : float, optional
        κ [-], in (0, 1], or inf; Cowper's by default.

    Raises
    ------
    ValueError
        If a value is out of range.
    """

    outer_diameter: float
    inner_diameter: float
    material: Material
    shear_coefficient: float | None = None

    def __post_init__(self) -> None:
        """Check and normalise every field."""
        _check_tube(self)


@dataclass(frozen=True)
class ShaftSection:
    """A cylindrical piece of the shaft, solid or hollow.

    Parameters
    ----------
    length : float
        [m], 1e-6 to 1e6.
    outer_diameter : float
        [m].
    material : Material
    inner_diameter : float
        [m], smaller than the outer one; 0 for a solid section.
    shear_coefficient : float, optional
        κ [-], in (0, 1], or inf for a section without shear deformation. By default it is Cowper's,
        see `shear_coefficient` of `rotorstab.rotors.materials`.
    sleeves : tuple of Sleeve
        Tubes around the section over its whole length. Their stiffness and mass are added to those
        of the section: displacement and rotation are the same in all of them.

    Raises
    ------
    ValueError
        If a value is out of range.

    Examples
    --------
    >>> steel = Material(youngs_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
    >>> section = ShaftSection(length=1.5, outer_diameter=0.05, material=steel)
    >>> round(section.shear_coefficient, 7), round(section.properties.mass, 4)
    (0.8863064, 15.3349)
    """

    length: float
    outer_diameter: float
    material: Material
    inner_diameter: float = 0.0
    shear_coefficient: float | None = None
    sleeves: tuple[Sleeve, ...] = ()

    def __post_init__(self) -> None:
        """Check and normalise every field."""
        normalise(self, {"length": (_SMALLEST, _LARGEST)})
        _check_tube(self)
        object.__setattr__(self, "sleeves", tuple(self.sleeves))
        for sleeve in self.sleeves:
            if not isinstance(sleeve, Sleeve):
                raise ValueError(f"`sleeves` must hold Sleeves, got {type(sleeve).__name__}")

    @property
    def properties(self) -> SectionProperties:
        """EI, κGA, ρA and ρI of the section with its sleeves."""
        tubes: tuple[ShaftSection | Sleeve, ...] = (self, *self.sleeves)
        parts = [_tube_properties(tube) for tube in tubes]
        return SectionProperties(
            bending=sum(part.bending for part in parts),
            shear=sum(part.shear for part in parts),
            mass=sum(part.mass for part in parts),
            inertia=sum(part.inertia for part in parts),
        )
