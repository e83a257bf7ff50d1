"""The command line: `parser` reads the arguments, the two modules of commands do what they ask.

`values` reads lists and ranges, `output` prints and writes.
"""

from .parser import main

__all__ = ["main"]
