"""Published and separately calculated values, each with its source, and how we get ours.

The one list that the tests and the validation table read.
"""

from .any_rotor import any_rotor
from .limits import limits
from .literature import classical, paper
from .multipliers import multipliers
from .separate import separate
from .structure import Published

__all__ = ["PUBLISHED", "Published"]

PUBLISHED: tuple[Published, ...] = (
    *paper(),
    *classical(),
    *limits(),
    *separate(),
    *multipliers(),
    *any_rotor(),
)
"""Every value, in the order of the validation table."""
