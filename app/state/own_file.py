"""Opens a file of the page Your rotor: an own rotor file (TOML), or one of ROSS (TOML or JSON)."""

from __future__ import annotations

import re
import warnings
from typing import NamedTuple

from rotorstab import NotCarriedOver, Rotor
from rotorstab.model.mesh import rotor_mesh
from rotorstab.rotors.ross import rotor_from_ross_text
from rotorstab.rotors.rotor_file import rotor_from_toml

from ..reading.numbers import printable
from ..reading.toml import read_toml

__all__ = [
    "LARGEST_OWN_FILE",
    "MOST_ELEMENTS",
    "OpenedRotor",
    "elements_of",
    "open_rotor",
    "plain_line",
]

LARGEST_OWN_FILE = 150_000
"""Largest size of a file [bytes]; the compressor of ROSS's examples takes some 100 000."""
MOST_ELEMENTS = 160
"""Largest number of finite elements of a rotor: reducing more takes longer than a page may wait."""
_PER_SECTION = (6, 3, 2)  # elements of a section that are tried, the finest first, before 1
_ENOUGH = 60  # elements of a rotor that are fine enough
_LONGEST = 240  # characters of a message


class OpenedRotor(NamedTuple):
    """What a file holds.

    Parameters
    ----------
    rotor : Rotor or None
        None if the file was refused.
    problem : str
        Why it was refused, with the place in the file; else empty.
    notes : tuple of str
        What the rotor does not have that the file has.
    """

    rotor: Rotor | None
    problem: str = ""
    notes: tuple[str, ...] = ()


def open_rotor(text: str) -> OpenedRotor:
    """Return the rotor of a text; an error is a part of the answer, for it crosses processes."""
    if len(text.encode("utf-8", "surrogatepass")) > LARGEST_OWN_FILE:
        return OpenedRotor(None, f"the file is larger than {LARGEST_OWN_FILE // 1000} kB")
    try:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", NotCarriedOver)
            rotor = _read(text)
        elements_of(rotor)
    except ValueError as error:
        return OpenedRotor(None, plain_line(str(error)))
    notes = (printable(str(one.message), _LONGEST) for one in caught)
    return OpenedRotor(rotor, notes=tuple(notes))


def elements_of(rotor: Rotor) -> int:
    """Return the number of finite elements of each section.

    Raises
    ------
    ValueError
        If the rotor has too many sections, disks and bearings for the page.
    """
    for elements in _PER_SECTION:
        if elements * len(rotor.sections) <= _ENOUGH and _count(rotor, elements) <= _ENOUGH:
            return elements
    if len(rotor.sections) > MOST_ELEMENTS or _count(rotor, 1) > MOST_ELEMENTS:
        raise ValueError(
            f"the rotor needs more than {MOST_ELEMENTS} elements, more than this page computes: "
            "join sections, or use the Python library, which takes 400"
        )
    return 1


def _count(rotor: Rotor, elements: int) -> int:
    return len(rotor_mesh(rotor, elements).sections)


def _read(text: str) -> Rotor:
    """Return the rotor of a text in one of the forms."""
    text = text.removeprefix("\ufeff")
    if text.lstrip().startswith("{"):
        return rotor_from_ross_text(text)
    tables = read_toml(text)  # bounded before the other parsers see it
    if any(name.startswith("ShaftElement") for name in tables):
        return rotor_from_ross_text(text)
    return rotor_from_toml(text)


def plain_line(message: str) -> str:
    """Return a message as one short line, without the marks of names of arguments."""
    return printable(re.sub("`([^`]*)`", r"\1", message), _LONGEST)
