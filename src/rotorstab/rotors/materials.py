"""Materials of shafts, and the shear coefficient of a circular section."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from .._arguments import number
from .._tolerances import NEGLIGIBLE

__all__ = ["MATERIALS", "Material", "material_named", "shear_coefficient"]


def shear_coefficient(
    youngs_modulus: float, shear_modulus: float, diameter_ratio: float = 0.0
) -> float:
    """Return κ of a circular section, solid or hollow.

    κ = 6(1 + ν)(1 + m²)²/[(7 + 6ν)(1 + m²)² + (20 + 12ν)m²] with ν = E/(2G) − 1; for a solid
    section it is 6(1 + ν)/(7 + 6ν).

    Parameters
    ----------
    youngs_modulus, shear_modulus : float
        E and G in one unit.
    diameter_ratio : float
        m [-], inner over outer diameter, in [0, 1).

    Returns
    -------
    float
        κ [-], in (0, 1).

    Raises
    ------
    ValueError
        If a modulus is not positive and finite, or E > 3G (ν > 0.5), which no isotropic material
        has, or the ratio is out of range.

    References
    ----------
    G. R. Cowper, The shear coefficient in Timoshenko's beam theory, Journal of Applied
    Mechanics 33 (1966) 335–340.

    Examples
    --------
    >>> round(shear_coefficient(207e9, 79.6e9), 2), round(shear_coefficient(207e9, 79.6e9, 0.9), 2)
    (0.89, 0.53)
    """
    youngs_modulus = number("youngs_modulus", youngs_modulus, 0.0, open_low=True)
    shear_modulus = number("shear_modulus", shear_modulus, 0.0, open_low=True)
    ratio = youngs_modulus / (2 * shear_modulus)  # 1 + ν
    if not 0 < ratio <= 1.5 * (1 + NEGLIGIBLE):
        raise ValueError(
            "`youngs_modulus` must be at most 3 `shear_modulus`, "
            f"got {youngs_modulus:g} and {shear_modulus:g}"
        )
    square = number("diameter_ratio", diameter_ratio, 0.0, 1.0, open_high=True) ** 2
    hollow = square / (1 + square) ** 2
    return 6 * ratio / (1 + 6 * ratio + (8 + 12 * ratio) * hollow)


@dataclass(frozen=True)
class Material:
    """An isotropic material, in SI units.

    Parameters
    ----------
    youngs_modulus, shear_modulus : float
        E and G [Pa].
    density : float
        ρ [kg/m³].

    Raises
    ------
    ValueError
        If a modulus is not in [1, 1e15] or the density not in [1e-6, 1e6].
    """

    youngs_modulus: float
    shear_modulus: float
    density: float

    def __post_init__(self) -> None:
        """Check and normalise every field."""
        for name, low, high in (
            ("youngs_modulus", 1.0, 1e15),
            ("shear_modulus", 1.0, 1e15),
            ("density", 1e-6, 1e6),
        ):
            object.__setattr__(self, name, number(name, getattr(self, name), low, high))

    @property
    def shear_coefficient(self) -> float:
        """κ of a solid circular section [-]."""
        return shear_coefficient(self.youngs_modulus, self.shear_modulus)


MATERIALS: Mapping[str, Material] = MappingProxyType(
    {
        # EN 1993-1-1, 3.2.6: E = 210 GPa, G = E/2(1 + 0.3); EN 1991-1-1, table A.4: 7850 kg/m³
        "steel": Material(210e9, 210e9 / 2.6, 7850.0),
        # EN 1999-1-1, 3.2.5: E = 70 GPa, G = 27 GPa, 2700 kg/m³
        "aluminium": Material(70e9, 27e9, 2700.0),
        # Ti-6Al-4V, annealed: 113.8 GPa, 44 GPa, 4430 kg/m³ (ASM data sheet MTP641)
        "titanium": Material(113.8e9, 44e9, 4430.0),
    }
)
"""Handbook values by name; a real bar may differ by a few per cent."""

# Other names of these materials, in letters and digits only. Other alloys have other values and
# are not listed.
_OTHER_NAMES: Mapping[str, str] = MappingProxyType(
    {
        "structuralsteel": "steel",
        "carbonsteel": "steel",
        "mildsteel": "steel",
        "aluminum": "aluminium",
        "aluminiumalloy": "aluminium",
        "aluminumalloy": "aluminium",
        "titaniumalloy": "titanium",
        "ti6al4v": "titanium",
        "titaniumti6al4v": "titanium",
    }
)


def material_named(text: str) -> str | None:
    """Return the key of `MATERIALS` for a name that a person has written.

    Case, spaces, hyphens and parentheses do not matter.

    Parameters
    ----------
    text : str

    Returns
    -------
    str or None
        None if the name is not that of a material in `MATERIALS`.

    Examples
    --------
    >>> material_named("Aluminum"), material_named("Ti-6Al-4V"), material_named("cheese")
    ('aluminium', 'titanium', None)
    """
    plain = re.sub(r"[\s_\-–‐()]+", "", text).casefold()
    name = _OTHER_NAMES.get(plain, plain)
    return name if name in MATERIALS else None
