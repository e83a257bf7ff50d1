"""Table 1: the rotor of reference [4] of the paper, and what follows from it."""

from __future__ import annotations

from dataclasses import dataclass

from ..model.finite_element import finite_element
from ..model.system import fundamental_frequency
from ..rotors.shaft_disk import TABLE_1_SI, ShaftDisk
from ..whirl.critical_loads import critical_load
from .arguments import resting_frequency

__all__ = ["Row", "Table", "table_1"]


@dataclass(frozen=True)
class Row:
    """One quantity of the table.

    Parameters
    ----------
    name, symbol, unit : str
    text : float or None
        The paper's value; None where it has none.
    ours : float
        What this library takes or computes.
    given : bool
        Whether it is input data; otherwise it is computed from them.
    """

    name: str
    symbol: str
    unit: str
    text: float | None
    ours: float
    given: bool

    @property
    def difference(self) -> float | None:
        """Relative difference, ours / text − 1."""
        return None if self.text is None else self.ours / self.text - 1


@dataclass(frozen=True)
class Table:
    """A titled table."""

    title: str
    rows: tuple[Row, ...]


_GIVEN = (
    ("length of the shaft", "L", "m", "length"),
    ("diameter of the shaft", "φ", "m", "diameter"),
    ("Young’s modulus", "E", "Pa", "youngs_modulus"),
    ("shear modulus", "G", "Pa", "shear_modulus"),
    ("density", "ρ", "kg/m³", "density"),
    ("shear coefficient", "κ", "-", "shear_coefficient"),
    ("mass of the disk", "M_D", "kg", "disk_mass"),
    ("diametral inertia of the disk", "I_D", "kg m²", "diametral_inertia"),
    ("polar inertia of the disk", "I_P", "kg m²", "polar_inertia"),
)


def table_1() -> Table:
    """Return Table 1 with the derived numbers of the text around it.

    Returns
    -------
    Table
        Input data first, then ω_n, p_cr and the mass ratios, computed.

    Examples
    --------
    >>> next(round(row.ours, 3) for row in table_1().rows if row.symbol == "ω_n")
    159.805
    """
    rotor, scales = ShaftDisk.from_si(**TABLE_1_SI)
    given = tuple(
        Row(name, symbol, unit, TABLE_1_SI[key], TABLE_1_SI[key], True)
        for name, symbol, unit, key in _GIVEN
    )
    frequency = resting_frequency(rotor) * scales.frequency
    comparator = fundamental_frequency(finite_element(rotor, 0.0)) * scales.frequency
    buckling = float(critical_load(rotor.shear)) * scales.load
    share = scales.mass / (scales.mass + TABLE_1_SI["disk_mass"])
    computed = (
        Row("natural frequency, lumped", "ω_n", "rad/s", 159.805, frequency, False),
        Row("natural frequency, finite elements", "ω_n,FE", "rad/s", None, comparator, False),
        Row("static buckling load", "p_cr", "N", 16.0e3, buckling, False),
        Row("disk mass over shaft mass", "M̄_D", "-", 1.16, rotor.disk_mass, False),
        Row("neglected share of the mass", "m/(m+M_D)", "-", 0.46, share, False),
        Row("shear parameter", "Φ", "-", None, rotor.shear, False),
        Row("mass of the shaft", "m", "kg", None, scales.mass, False),
    )
    return Table("Table 1: data of the shaft–disk system of reference [4]", given + computed)
