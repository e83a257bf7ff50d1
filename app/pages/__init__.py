"""The pages of the dashboard, in the order of the navigation."""

from .explore import Explore

__all__ = ["PAGES"]

PAGES = (Explore,)
