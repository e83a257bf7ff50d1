"""What is measured along an axis or named at a mark: words, symbol, unit and value as fields.

Each quantity of the charts stands here once, with its form in SI; `si` has what one unit is there.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

__all__ = [
    "AXES",
    "EXCITATION",
    "EXCITATION_RATIO",
    "GROWTH",
    "GROWTH_PER_PERIOD",
    "LOAD",
    "LOAD_FACTOR",
    "SPIN",
    "WHIRL",
    "Amount",
    "Measure",
    "Quantity",
    "SIForm",
    "ShareOf",
    "Wording",
]

_FREQUENCY = "√(EI/ρAL⁴)"


class Measure(Enum):
    """What a quantity is measured in, in SI."""

    LOAD = "N, or what suits the shaft"
    FREQUENCY = "Hz"
    SPIN = "rpm"
    RATE = "1/s"
    MASS = "kg"
    INERTIA = "kg m²"
    NUMBER = ""


class ShareOf(Enum):
    """What a quantity without dimension is divided by."""

    REFERENCE_LOAD = "the load that load factors refer to"
    FUNDAMENTAL_FREQUENCY = "ω_n"


@dataclass(frozen=True)
class SIForm:
    """How a quantity is named and measured in SI.

    Parameters
    ----------
    symbol : str
    measure : Measure
    of : ShareOf, optional
        What the non-dimensional value is a share of; by default it has the scale of the measure.
    words : str
        Its name, where it differs.
    """

    symbol: str
    measure: Measure
    of: ShareOf | None = None
    words: str = ""


@dataclass(frozen=True)
class Quantity:
    """What is measured.

    Parameters
    ----------
    words : str
        Its name in words; may be empty.
    symbol : str
        Such as "p̄".
    unit : str
        "-" where there is none.
    si : SIForm, optional
        None for a quantity that is the same in all units, and for one that is in SI.
    """

    words: str
    symbol: str
    unit: str = "-"
    si: SIForm | None = None

    def name(self, with_unit: bool) -> str:
        """Return the symbol, followed by the unit in brackets if asked for and if there is one."""
        return f"{self.symbol} [{self.unit}]" if with_unit and self.unit != "-" else self.symbol

    def label(self, with_unit: bool) -> str:
        """Return the words and the symbol as the label of an axis.

        Examples
        --------
        >>> Quantity("spin speed", "Ω", "rpm").label(with_unit=True)
        'spin speed Ω [rpm]'
        """
        return f"{self.words} {self.name(with_unit)}".strip()


LOAD = Quantity("static load", "p̄", "EI/L²", SIForm("P", Measure.LOAD))
SPIN = Quantity("spin speed", "Ω̄", _FREQUENCY, SIForm("Ω", Measure.SPIN))
WHIRL = Quantity("whirl", "ω̄", _FREQUENCY, SIForm("ω/2π", Measure.FREQUENCY))
EXCITATION = Quantity("excitation frequency", "θ̄", _FREQUENCY, SIForm("θ/2π", Measure.FREQUENCY))
EXCITATION_RATIO = Quantity(
    "excitation frequency",
    "θ/ωₙ",
    si=SIForm("θ/2π", Measure.FREQUENCY, ShareOf.FUNDAMENTAL_FREQUENCY),
)
LOAD_FACTOR = Quantity(
    "dynamic load factor",
    "β_d",
    si=SIForm("Pₜ", Measure.LOAD, ShareOf.REFERENCE_LOAD, "pulsating load"),
)
GROWTH = Quantity("growth rate", "σ̄", _FREQUENCY, SIForm("σ", Measure.RATE))
GROWTH_PER_PERIOD = Quantity("growth per period", "σ̄T", si=SIForm("σT", Measure.NUMBER))

AXES = {
    "instability": (EXCITATION_RATIO, LOAD_FACTOR),
    "load-frequency": (LOAD, WHIRL),
    "campbell": (SPIN, WHIRL),
}
"""Abscissa and ordinate of the charts that have a form in SI, by the key of the chart."""


@dataclass(frozen=True)
class Amount:
    """A value of a quantity that the name of a mark gives.

    Parameters
    ----------
    quantity : Quantity
    value : float
        Non-dimensional.
    digits : int
        Significant digits of the non-dimensional text.
    index : str
        Added to the symbol, such as "₀".
    bare : bool
        Whether the symbol is left out.
    """

    quantity: Quantity
    value: float
    digits: int = 4
    index: str = ""
    bare: bool = False

    def __str__(self) -> str:
        """Return the non-dimensional text."""
        text = f"{self.value:.{self.digits}g}".replace("-", "−")
        return text if self.bare else f"{self.quantity.symbol}{self.index} = {text}"


@dataclass(frozen=True)
class Wording:
    """The name of a mark with the amounts that it gives, so that another unit can be written.

    Parameters
    ----------
    text : str
        With a place {} for each amount.
    amounts : tuple of Amount
    si_text : str
        The same for a chart in SI, where it differs.
    """

    text: str
    amounts: tuple[Amount, ...] = ()
    si_text: str = ""

    def __str__(self) -> str:
        """Return the non-dimensional text."""
        return self.text.format(*self.amounts)
