"""The pages of the dashboard, in the order of the navigation."""

from .base import Page
from .explore import Explore
from .lessons import Lessons
from .paper import Paper
from .stiffness import Stiffness

__all__ = ["PAGES", "Page"]

PAGES: tuple[type[Page], ...] = (Explore, Stiffness, Paper, Lessons)
