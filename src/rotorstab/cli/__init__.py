"""The command line: `parser` reads the arguments, `commands` does what they ask."""

from .parser import main

__all__ = ["main"]
