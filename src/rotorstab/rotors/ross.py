"""Reads the rotor files of ROSS, TOML or JSON of its versions 2 and 3, without ROSS.

Carried over are shaft elements (solid, hollow, in layers, and conical ones as steps), disks, gears
as disks, point masses that are the same in both directions, bearings and seals with their
stiffness, damping and equal added mass. Each shaft element becomes one section, so one element a
section (`elements=1`) is the mesh of the file.

Everything else is named in a warning, `NotCarriedOver`, if the rotor is a sensible one without it,
and refused if not.
"""

from __future__ import annotations

import json
import os
import tomllib
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from .._arguments import LARGEST, number
from .parts import Disk
from .places import RotorFileError, lines_of_json, lines_of_toml
from .ross_bearings import bearings_and_masses
from .ross_shaft import shaft_sections
from .ross_tables import RossTables
from .rotor import Rotor

__all__ = ["NotCarriedOver", "read_ross", "rotor_from_ross_text"]

LARGEST_FILE = 4_000_000
"""Largest size of a ROSS file [characters]; the compressor of a hundred elements takes 100 kB."""


class NotCarriedOver(UserWarning):
    """Something in a ROSS file that the rotor does not have, or has in another form."""


def read_ross(path: str | os.PathLike[str], spin_speed: float | None = None) -> Rotor:
    """Return the rotor of a ROSS file, see `Rotor.from_ross`."""
    text = Path(path).read_text(encoding="utf-8", errors="replace")
    return rotor_from_ross_text(text, spin_speed)


def rotor_from_ross_text(text: str, spin_speed: float | None = None) -> Rotor:
    """Return the rotor of the text of a ROSS file, TOML or JSON.

    Parameters
    ----------
    text : str
    spin_speed : float, optional
        See `Rotor.from_ross`.

    Returns
    -------
    Rotor

    Raises
    ------
    RotorFileError
        If the text is no such rotor, or holds what this library cannot represent. This is a
        ValueError.

    Warns
    -----
    NotCarriedOver
        Once for each kind of what is not carried over, with the elements' names.
    """
    if len(text) > LARGEST_FILE:
        raise RotorFileError(f"the file is larger than {LARGEST_FILE // 1_000_000} MB")
    if spin_speed is not None:
        spin_speed = number("spin_speed", spin_speed, -LARGEST, LARGEST)
    ross = RossTables(*_parsed(text))
    rotor = _rotor(ross, spin_speed)
    for reason, names in ross.left_out.items():
        shown = ", ".join(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "")
        warnings.warn(f"{reason}: {shown}", NotCarriedOver, stacklevel=4)
    return rotor


def _rotor(ross: RossTables, spin_speed: float | None) -> Rotor:
    """Return the rotor; what is left out is noted in `ross`."""
    sections, nodes = shaft_sections(ross)
    for name in ross.named("CouplingElement"):
        ross.fail(name, "a coupling between two shafts cannot be represented")
    bearings, added = bearings_and_masses(ross, nodes, spin_speed)
    disks = [_disk(ross, name, nodes) for name in ross.named("DiskElement", "Gear")]
    masses = [_point_mass(ross, name, nodes) for name in ross.named("PointMass")]
    for name in ross.named("Gear"):
        ross.note("a gear is carried over as a disk", name)
    known = ross.named("ShaftElement", "DiskElement", "Gear", "PointMass")
    for name, table in ross.elements.items():
        if name not in known and "kxx" not in table:
            ross.note("this kind of element is not carried over", name)
    try:
        return Rotor(tuple(sections), (*disks, *masses, *added), tuple(bearings))
    except ValueError as error:
        raise RotorFileError(f"the rotor of the file cannot be built: {error}") from None


def _disk(ross: RossTables, name: str, nodes: list[float]) -> Disk:
    """Return a disk."""
    position = ross.position(name, nodes)
    mass, diametral, polar = (ross.number(name, key) for key in ("m", "Id", "Ip"))
    try:
        return Disk(position, mass, diametral, polar)
    except ValueError as error:
        ross.fail(name, error)


def _point_mass(ross: RossTables, name: str, nodes: list[float]) -> Disk:
    """Return a point mass on the shaft as a disk without inertia."""
    both = [ross.number(name, key, ross.elements[name].get("m")) for key in ("mx", "my")]
    if both[0] != both[1]:
        ross.fail(name, f"must have mx = my, got {both[0]:g} and {both[1]:g}")
    position = ross.position(name, nodes)
    try:
        return Disk(position, both[0], 0.0, 0.0)
    except ValueError as error:
        ross.fail(name, error)


def _parsed(text: str) -> tuple[Mapping[str, Any], Mapping[str, int]]:
    """Return the tables of a text, and the lines where they stand."""
    is_json = text.lstrip("\ufeff \t\r\n").startswith("{")
    try:
        tables = json.loads(text) if is_json else tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        kind = "JSON" if is_json else "TOML"
        raise RotorFileError(f"the file is not {kind}: {error}") from None
    return tables, (lines_of_json if is_json else lines_of_toml)(text)
