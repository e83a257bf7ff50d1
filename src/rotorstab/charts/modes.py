"""Whirl modes with number and direction as fields."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

__all__ = ["Mode", "modes"]


@dataclass(frozen=True)
class Mode:
    """A whirl mode.

    Parameters
    ----------
    number : int
        From 1, by the size of the frequency.
    forward : bool
        Whether it whirls with the spin, not against it.
    """

    number: int
    forward: bool

    @property
    def name(self) -> str:
        """Its name, such as 1F; as `mode_names` of `whirl.mode_names` writes it."""
        return f"{self.number}{'F' if self.forward else 'B'}"


def modes(names: Sequence[str]) -> tuple[Mode, ...]:
    """Return the modes of a system by their names.

    Parameters
    ----------
    names : sequence of str
        Names of the 2n modes of one system, in any order.

    Examples
    --------
    >>> [mode.forward for mode in modes(("2B", "1B", "1F", "2F"))]
    [False, False, True, True]
    """
    known = [Mode(n + 1, forward) for n in range(len(names)) for forward in (False, True)]
    by_name = {mode.name: mode for mode in known}
    return tuple(by_name[name] for name in names)
