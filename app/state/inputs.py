"""Every input of the dashboard, and the lists that follow from how the inputs are declared."""

from __future__ import annotations

from .chart_inputs import ChartInputs
from .declaration import Facts, Use
from .own_inputs import OwnInputs
from .point_inputs import PointInputs
from .rotor_inputs import RotorInputs
from .shaft_inputs import ShaftInputs

__all__ = ["FACTS", "NAMES", "SI_INPUTS", "SYMBOLS", "Inputs", "names_for"]


# the parameters of the last class come first
class Inputs(OwnInputs, ShaftInputs, PointInputs, ChartInputs, RotorInputs):
    """Every input of the dashboard, with its bounds, step and one-line meaning."""


NAMES = tuple(name for name in Inputs.param if name != "name")
FACTS: dict[str, Facts] = {name: Inputs.param[name].facts for name in NAMES}
"""What is declared of each input beside its parameter."""
SYMBOLS = {name: facts.symbol for name, facts in FACTS.items() if facts.symbol}
SI_INPUTS = {name: facts.unit for name, facts in FACTS.items() if facts.unit is not None}
"""The inputs of the shaft and disk in SI, and the unit of each; they set Φ, M̄_D, Ī_D and Ī_P only
when `State.use_shaft` is called."""


def names_for(use: Use) -> tuple[str, ...]:
    """Return the names of the inputs that are declared for a use, in the order of the page."""
    return tuple(name for name, facts in FACTS.items() if use in facts.use)
