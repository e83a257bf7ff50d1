"""Which pages does the dashboard have? `PAGES` lists them in the order of the navigation.

Read `base`, then `explore` with `marked_point`, `animation`, `pins`, `pin_list`, `pinned_charts`
and `rotor_messages`; `own_rotor`, `stiffness`, `paper` and `lessons` stand alone; `warming` draws
ahead.
"""

from .base import Page
from .explore import Explore
from .lessons import Lessons
from .own_rotor import OwnRotor
from .paper import Paper
from .stiffness import Stiffness

__all__ = ["PAGES", "Page"]

PAGES: tuple[type[Page], ...] = (Explore, OwnRotor, Stiffness, Paper, Lessons)
