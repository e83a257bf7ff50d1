"""`python -m rotorstab`: see `rotorstab.cli`."""

from __future__ import annotations

import sys

from .cli.parser import main

__all__ = ["main"]

if __name__ == "__main__":
    sys.exit(main())
