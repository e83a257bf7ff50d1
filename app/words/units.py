"""How one quantity is written in the units that the user chose."""

from __future__ import annotations

from dataclasses import dataclass

from rotorstab import Scales
from rotorstab.charts import written

from ..state.rates import hertz
from .si import load_words
from .typography import with_unit

__all__ = ["Units"]


@dataclass(frozen=True)
class Units:
    """How the quantities of one chart are written.

    Parameters
    ----------
    fundamental, reference : float
        ω_n and the load that β_d = 1 stands for, non-dimensional.
    scales : Scales or None
        Of the shaft; None for the paper's numbers.
    """

    fundamental: float
    reference: float
    scales: Scales | None

    def excitation(self, ratio: float) -> str:
        """Return θ/ωₙ, or θ/2π in Hz."""
        symbol = "θ/ωₙ" if self.scales is None else "θ/2π"
        return f"{symbol} = {self.bare_excitation(ratio)}"

    def place(self, ratio: float) -> str:
        """Return θ/ωₙ with its symbol, or θ/2π with its unit and without the symbol."""
        return self.excitation(ratio) if self.scales is None else self.bare_excitation(ratio)

    def bare_excitation(self, ratio: float) -> str:
        """Return the value of θ/ωₙ, or of θ/2π with its unit, without the symbol."""
        return (
            f"{ratio:.3f}" if self.scales is None else with_unit(written(self._hertz(ratio)), "Hz")
        )

    def width(self, ratio: float) -> str:
        """Return a width in θ/ωₙ, or in Hz, as a number alone."""
        return f"{ratio:.3f}" if self.scales is None else written(self._hertz(ratio), 3)

    def offset(self, ratio: float) -> str:
        """Return a difference of θ/ωₙ with its sign."""
        if self.scales is None:
            return f"{ratio:+.3f}".replace("-", "−")
        hertz = self._hertz(ratio)
        return with_unit(f"{'+' if hertz >= 0 else ''}{written(hertz, 3)}", "Hz")

    def factor(self, value: float, digits: str = ".3f") -> str:
        """Return β_d, with its load where that has a unit."""
        words = f"β_d = {value:{digits}}"
        if self.scales is None:
            return words
        return f"{words} (P_t = {load_words(value * self.reference, self.scales)})"

    def rate(self, growth: float) -> tuple[str, str]:
        """Return the name and the value of a growth rate."""
        if self.scales is None:
            return "Growth rate σ̄", written(growth)
        return "Growth rate σ", with_unit(written(growth * self.scales.frequency), "1/s")

    def rate_words(self, growth: float) -> str:
        """Return a growth rate as part of a sentence."""
        if self.scales is None:
            return f"σ̄ = {written(growth, 3)}"
        return f"σ = {written(growth * self.scales.frequency, 3)} per second"

    @property
    def product(self) -> str:
        """The symbol of growth in a period, which has the same value in all units."""
        return "σ̄T" if self.scales is None else "σT"

    def time(self, value: float) -> str:
        """Return a time."""
        if self.scales is None:
            return f"t̄ = {written(value)}"
        return with_unit(written(value / self.scales.frequency), "s")

    def _hertz(self, ratio: float) -> float:
        assert self.scales is not None
        return ratio * self.fundamental * hertz(self.scales)
