"""Example rotors of the page Your rotor: those of the library, with their titles and sources."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

from rotorstab import Rotor
from rotorstab.rotors.presets import PRESETS

__all__ = ["OWN_FILE", "OWN_PRESETS", "OwnPreset"]

OWN_FILE = "file"
"""The choice that stands for the rotor of a file."""


class OwnPreset(NamedTuple):
    """An example rotor.

    Parameters
    ----------
    title : str
        As the page lists it.
    source : str
        Where its data are from.
    rotor : Rotor
    """

    title: str
    source: str
    rotor: Rotor


# M. I. Friswell, J. E. T. Penny, S. D. Garvey, A. W. Lees, Dynamics of Rotating Machines,
# Cambridge University Press, 2010
_BOOK = "Friswell, Penny, Garvey, Lees, Dynamics of Rotating Machines (2010), example "
_ILLUSTRATIVE = "Plausible values of our own, for illustration; no real machine has them."


OWN_PRESETS: Mapping[str, OwnPreset] = MappingProxyType(
    {
        "two-disks": OwnPreset("Two disks, two bearings", f"{_BOOK}5.9.7", PRESETS["two disks"]),
        "overhung": OwnPreset("Overhung disk", f"{_BOOK}5.9.9", PRESETS["overhung disk"]),
        "thin": OwnPreset("Thin overhung shaft", f"{_BOOK}6.8.1", PRESETS["thin overhung shaft"]),
        "paper": OwnPreset(
            "Paper’s rotor (Table 1)", "Table 1 of the paper", PRESETS["cantilever"]
        ),
        "ship": OwnPreset("Ship’s shaft line", _ILLUSTRATIVE, PRESETS["ship's shaft line"]),
        "turbopump": OwnPreset("Turbopump", _ILLUSTRATIVE, PRESETS["turbopump"]),
    }
)
"""By the word that an address uses."""
