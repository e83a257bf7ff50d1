"""What is measured along an axis or named at a mark: words, symbol, unit and value as fields."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = [
    "EXCITATION",
    "EXCITATION_RATIO",
    "GROWTH",
    "GROWTH_PER_PERIOD",
    "GROWTH_SI",
    "LOAD",
    "LOAD_FACTOR",
    "SPIN",
    "WHIRL",
    "Amount",
    "Quantity",
    "Wording",
]

_FREQUENCY = "√(EI/ρAL⁴)"


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
    """

    words: str
    symbol: str
    unit: str = "-"

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


LOAD = Quantity("static load", "p̄", "EI/L²")
SPIN = Quantity("spin speed", "Ω̄", _FREQUENCY)
WHIRL = Quantity("whirl", "ω̄", _FREQUENCY)
EXCITATION = Quantity("excitation frequency", "θ̄", _FREQUENCY)
EXCITATION_RATIO = Quantity("excitation frequency", "θ/ωₙ")
LOAD_FACTOR = Quantity("dynamic load factor", "β_d")
GROWTH = Quantity("growth rate", "σ̄", _FREQUENCY)
GROWTH_PER_PERIOD = Quantity("growth per period", "σ̄T")
GROWTH_SI = Quantity("growth rate", "σ", "1/s")


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
