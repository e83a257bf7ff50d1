"""What a quantity of a lesson is, and how its name is read."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

from ..state import State

__all__ = ["Quantity"]

_NUMBERS = tuple(name for name, value in State().inputs().items() if isinstance(value, float))


@dataclass(frozen=True)
class Quantity:
    """A named number that follows from the inputs of the page.

    Parameters
    ----------
    form : str
        The name as a teacher writes it, with <mode>, <pair>, <n>, <way> or <name> for its parts.
    label : str
        A few words and the symbol for the lesson's panel, with {0} for the first part.
    doc : str
        One line for the documentation.
    compute : callable
        Returns the number from the `Situation` and the parts.
    flag : bool
        Whether it is a yes (1) or no (0).
    at_factor : bool
        Whether it depends on β_d of the marked point but not on its θ/ωₙ. The page shows β_d with
        the number, since such a quantity has a value without a marked point too.
    """

    form: str
    label: str
    doc: str
    compute: Callable[..., float]
    flag: bool = False
    at_factor: bool = False

    @cached_property
    def pattern(self) -> re.Pattern[str]:
        """The form as a regular expression with a group for each part."""
        text = re.escape(self.form)
        for part, expression in _PARTS.items():
            text = text.replace(re.escape(part), f"({expression})")
        return re.compile(text)


_MODE = "[1-4][BF]"
_PARTS = {
    "<mode>": _MODE,
    "<pair>": f"{_MODE}\\+{_MODE}",
    "<n>": "[1-9]",
    "<way>": "forward|backward",
    "<name>": "|".join(_NUMBERS),
}
