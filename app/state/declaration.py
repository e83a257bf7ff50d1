"""How an input of the dashboard is declared: its parameter, and the facts that others need of it.

Whoever needs a list of inputs, such as the address or the report, derives it from these facts.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Flag, auto
from typing import Any

import param

from rotorstab.charts.quantities import SIForm

__all__ = ["DESCRIPTIVE", "Boolean", "Facts", "Number", "Selector", "Use"]


class Use(Flag):
    """Where the value of an input is used."""

    NONE = 0
    PINNED = auto()
    """A pin keeps it: a curve, a number or the window of the pin depends on it."""
    COMPARED = auto()
    """The table of the pins names it where it differs: a curve or a number depends on it."""
    REPORTED = auto()
    """The report lists it among the parameters."""
    PICTURE = auto()
    """The charts of the Explore page depend on it as it is.

    They depend on the inputs of the rotor, its load and its model through `operation_of`.
    """
    PRESET = auto()
    """A preset sets it to its default, unless the preset has a value of its own."""
    MATERIAL = auto()
    """A value of the material: whoever sets it means a material of their own."""
    LOOK = auto()
    """It decides how the page looks before its first answer."""


DESCRIPTIVE = Use.PINNED | Use.COMPARED | Use.REPORTED
"""Of an input that describes what is computed: the rotor, its load, its model."""


@dataclass(frozen=True)
class Facts:
    """What is declared of an input beside its parameter.

    Parameters
    ----------
    key : str
        Its key in the address of the page.
    use : Use
    symbol : str
    unit : str or None
        Of a datum of the shaft or disk in SI, empty where it has no dimension; None for an input
        that is no such datum.
    si : SIForm or None
        How a slider without dimension is named and measured where the charts are in SI.
    """

    key: str
    use: Use = Use.NONE
    symbol: str = ""
    unit: str | None = None
    si: SIForm | None = None


class Number(param.Number):
    """A bounded number with its facts."""

    __slots__ = ("facts",)

    def __init__(self, facts: Facts, **declared: Any) -> None:
        super().__init__(**declared)
        self.facts = facts


class Selector(param.Selector):
    """A choice of words with its facts."""

    __slots__ = ("facts",)

    def __init__(self, facts: Facts, **declared: Any) -> None:
        super().__init__(**declared)
        self.facts = facts


class Boolean(param.Boolean):
    """A switch with its facts."""

    __slots__ = ("facts",)

    def __init__(self, facts: Facts, **declared: Any) -> None:
        super().__init__(**declared)
        self.facts = facts
