"""The paper's figures and conclusions with Floquet, which take seconds: once a test run each.

The process that asks for one first computes it and writes it to a file of the run; the others read
that file. So two processes of pytest-xdist do not compute the same figure.
"""

import fcntl
import pickle
from functools import cache
from pathlib import Path

from rotorstab.paper import FIGURES, FLOQUET_CONCLUSIONS, FLOQUET_FIGURES

folder = Path()  # of this test run, for all its processes; `tests/conftest.py` sets it
_figures, _conclusions = dict(FIGURES), dict(FLOQUET_CONCLUSIONS)


@cache
def floquet_figure(number):
    """Return a figure with Floquet, at its default parameters."""
    return _shared(f"figure-{number}", lambda: _figures[number](floquet=True))


@cache
def floquet_conclusion(letter):
    """Return what Floquet says of a conclusion."""
    return _shared(f"conclusion-{letter}", _conclusions[letter])


def _shared(name, make):
    path = folder / f"{name}.pickle"
    with path.with_suffix(".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if path.exists():
            return pickle.loads(path.read_bytes())
        made = make()
        path.write_bytes(pickle.dumps(made))
        return made


def share(patch):
    """Have the whole library take figures and conclusions with Floquet from here."""

    def maker(number):
        return lambda **options: (
            floquet_figure(number) if options == {"floquet": True} else _figures[number](**options)
        )

    for number in FLOQUET_FIGURES:
        patch.setitem(FIGURES, number, maker(number))
    for letter in _conclusions:
        patch.setitem(FLOQUET_CONCLUSIONS, letter, lambda letter=letter: floquet_conclusion(letter))
