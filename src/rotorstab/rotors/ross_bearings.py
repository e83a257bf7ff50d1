"""The bearings and seals of a ROSS rotor, whose coefficients may depend on the speed."""

from __future__ import annotations

import numpy as np

from .._types import Array
from .parts import Bearing, Disk
from .ross_tables import RossTables

__all__ = ["bearings_and_masses"]

_DEFAULTS = {"kyy": "kxx", "cyy": "cxx", "myy": "mxx"}
_COEFFICIENTS = ("kxx", "kyy", "kxy", "kyx", "cxx", "cyy", "cxy", "cyx")


def bearings_and_masses(
    ross: RossTables, nodes: list[float], spin_speed: float | None
) -> tuple[list[Bearing], list[Disk]]:
    """Return the bearings and seals, and their added masses as masses on the shaft.

    Parameters
    ----------
    ross : RossTables
    nodes : list of float
        Positions [m].
    spin_speed : float or None
        Where coefficients that depend on the speed are taken [rad/s]; None for the rated speed of
        the file, or else the middle of the speeds that all their tables have.

    Returns
    -------
    bearings : list of Bearing
    masses : list of Disk

    Raises
    ------
    RotorFileError
        If one cannot be represented.
    """
    names = [name for name, table in ross.elements.items() if "kxx" in table]
    speed = _speed(ross, names, spin_speed)
    bearings = [_bearing(ross, name, nodes, speed) for name in names]
    masses = (_added_mass(ross, name, nodes, speed) for name in names)
    return bearings, [mass for mass in masses if mass is not None]


def _speed(ross: RossTables, names: list[str], spin_speed: float | None) -> float:
    """Return the speed where coefficients are taken; those that depend on it are named."""
    tables = {name: _speeds(ross, name) for name in names}
    tables = {name: table for name, table in tables.items() if len(table) > 1}
    if not tables:
        return 0.0
    low = max(table[0] for table in tables.values())
    high = min(table[-1] for table in tables.values())
    choices = {
        "": spin_speed,
        ", the rated speed": ross.rated_speed,
        ", the middle of their table": float((low + high) / 2),
    }
    origin, speed = next((origin, at) for origin, at in choices.items() if at is not None)
    words = f"coefficients that depend on the speed are those at {speed:.4g} rad/s{origin}"
    for name, table in tables.items():
        inside = table[0] <= speed <= table[-1]
        ross.note(words if inside else f"{words}, outside their table: its end is taken", name)
    return speed


def _speeds(ross: RossTables, name: str) -> Array:
    """Return the speeds [rad/s] of an element's table of coefficients; empty if it has none."""
    for key in ("speed", "frequency"):  # ROSS 3, ROSS 2
        if ross.elements[name].get(key) is not None:
            speeds = ross.numbers(name, key)
            if not (np.diff(speeds) > 0).all():
                ross.fail(name, "must rise from value to value", key)
            return speeds
    return np.array([])


def _coefficient(ross: RossTables, name: str, key: str, speed: float) -> float:
    """Return one coefficient of a bearing, by linear interpolation in its table."""
    if ross.elements[name].get(key) is None:
        key = _DEFAULTS.get(key, key)
    values = ross.numbers(name, key)
    if len(values) == 1:
        return float(values[0])
    speeds = _speeds(ross, name)
    if len(speeds) != len(values):
        ross.fail(name, f"has {len(values)} values for {len(speeds)} speeds", key)
    return float(np.interp(speed, speeds, values))


def _bearing(ross: RossTables, name: str, nodes: list[float], speed: float) -> Bearing:
    """Return a bearing or a seal."""
    if ross.elements[name].get("n_link") is not None:
        ross.fail(name, "a bearing on a support of its own cannot be represented", "n_link")
    if any(ross.numbers(name, key).any() for key in ("kzz", "czz")):
        ross.note("axial stiffness and damping are not carried over", name)
    values = {key: _coefficient(ross, name, key, speed) for key in _COEFFICIENTS}
    position = ross.position(name, nodes)
    try:
        return Bearing(position, **values)
    except ValueError as error:
        ross.fail(name, error)


def _added_mass(ross: RossTables, name: str, nodes: list[float], speed: float) -> Disk | None:
    """Return the added mass of a bearing; one that depends on the direction is named."""
    masses = [_coefficient(ross, name, key, speed) for key in ("mxx", "myy", "mxy", "myx")]
    if not any(masses):
        return None
    if masses[0] != masses[1] or masses[0] < 0 or masses[2] or masses[3]:
        ross.note("an added mass that depends on the direction is not carried over", name)
        return None
    return Disk(ross.position(name, nodes), masses[0], 0.0, 0.0)
