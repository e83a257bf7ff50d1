"""How many random cases a run tries: `.ci/run` and CI services all, `make test` a part.

Only tests whose cases take a tenth of a second or more ask here; the others always try all.
"""

import os

from hypothesis import settings

TRIES_ALL = bool(os.environ.get("CI"))


def part_of(number):
    """Return the number of cases of this run: all, or two fifths."""
    return number if TRIES_ALL else max(1, 2 * number // 5)


def examples(number):
    """Return Hypothesis' settings for a test of so many cases where all are tried."""
    return settings(max_examples=part_of(number))
