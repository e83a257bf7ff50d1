"""Rotor files: a rotor as TOML whose quantities have units.

A file has tables [[sections]] from left to right, and as needed [materials.NAME], [[disks]],
[[bearings]], [load] and a list `clamps`. The keys are the arguments of the parts of a rotor. A
material is one of the file's own or of `MATERIALS`; `sleeves` is a list of inline tables.
"""

from __future__ import annotations

import os
import tomllib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, NoReturn, TypeVar

from .materials import MATERIALS, Material, material_named
from .parts import AxialLoad, Bearing, Disk
from .places import RotorFileError, lines_of_toml
from .quantities import plain_number, read_quantity
from .rotor import Rotor
from .sections import ShaftSection, Sleeve

__all__ = ["read_rotor", "rotor_from_toml", "rotor_to_toml", "write_rotor"]

LARGEST_FILE = 1_000_000
"""Largest size of a rotor file [characters]; a hundred sections take some ten thousand."""

_PLAIN = ""  # a number without a unit
_TUBE = {"outer_diameter": "length", "inner_diameter": "length", "shear_coefficient": _PLAIN}
_SPRING = dict.fromkeys(("kxx", "kyy", "kxy", "kyx"), "stiffness")
_DAMPER = dict.fromkeys(("cxx", "cyy", "cxy", "cyx"), "damping")
_KEYS: dict[type, dict[str, str]] = {
    Material: {"youngs_modulus": "modulus", "shear_modulus": "modulus", "density": "density"},
    ShaftSection: {"length": "length", **_TUBE},
    Sleeve: _TUBE,
    Disk: {
        "position": "length",
        "mass": "mass",
        "diametral_inertia": "inertia",
        "polar_inertia": "inertia",
    },
    Bearing: {"position": "length", **_SPRING, **_DAMPER},
    AxialLoad: {"start": "length", "end": "length", "tangency": _PLAIN},
}
"""The dimension of every key of a part."""
_UNIT = {
    "length": " m",
    "modulus": " Pa",
    "density": " kg/m^3",
    "mass": " kg",
    "inertia": " kg m^2",
    "stiffness": " N/m",
    "damping": " N s/m",
}
_TABLES = ("sections", "materials", "disks", "bearings", "load", "clamps")

Part = TypeVar("Part")


def read_rotor(path: str | os.PathLike[str]) -> Rotor:
    """Return the rotor of a file, see `Rotor.read`."""
    return rotor_from_toml(Path(path).read_text(encoding="utf-8", errors="replace"))


def write_rotor(rotor: Rotor, path: str | os.PathLike[str]) -> None:
    """Write a rotor to a file, see `Rotor.write`."""
    Path(path).write_text(rotor_to_toml(rotor), encoding="utf-8")


def rotor_from_toml(text: str) -> Rotor:
    """Return the rotor of the text of a rotor file.

    Parameters
    ----------
    text : str

    Returns
    -------
    Rotor

    Raises
    ------
    RotorFileError
        With the line, the key, what is allowed and what was given. This is a ValueError.
    """
    if len(text) > LARGEST_FILE:
        raise RotorFileError(f"the file is larger than {LARGEST_FILE // 1000} kB")
    try:
        tables = tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        raise RotorFileError(f"the file is not TOML: {error}") from None
    return _Reader(tables, lines_of_toml(text)).rotor()


class _Reader:
    """The tables of one file, and the lines where they stand."""

    def __init__(self, tables: Mapping[str, Any], lines: Mapping[str, int]) -> None:
        self.tables = tables
        self.lines = lines

    def fail(self, place: str, problem: object) -> NoReturn:
        parents = (place, place.rpartition(".")[0], place.partition("[")[0], f"{place}[0]")
        lines = [self.lines[name] for name in parents if name in self.lines]
        where = f"line {lines[0]}: " if lines else ""
        raise RotorFileError(f"{where}{place}: {problem}")

    def rotor(self) -> Rotor:
        for name in self.tables:
            if name not in _TABLES:
                self.fail(name, f"is unknown; a rotor file has {', '.join(_TABLES)}")
        if "sections" not in self.tables:
            raise RotorFileError("the file lacks [[sections]], the pieces of the shaft")
        materials = self.materials()
        parts = {
            "sections": self.parts("sections", ShaftSection, materials),
            "disks": self.parts("disks", Disk),
            "bearings": self.parts("bearings", Bearing),
            "load": self.part("load", AxialLoad, self.tables.get("load", {})),
            "clamps": tuple(
                self.value(f"clamps[{at}]", place, "length")
                for at, place in enumerate(self.listed("clamps"))
            ),
        }
        try:
            return Rotor(**parts)  # type: ignore[arg-type]
        except ValueError as error:
            name = str(error).partition("`")[2].partition("`")[0]
            self.fail(name, error)

    def listed(self, name: str) -> list[Any]:
        found = self.tables.get(name, [])
        if not isinstance(found, list):
            self.fail(name, f"must be a list, in tables [[{name}]] or in brackets")
        return found

    def materials(self) -> dict[str, Material]:
        tables = self.tables.get("materials", {})
        if not isinstance(tables, dict):
            self.fail("materials", "must be tables [materials.NAME]")
        return {
            name: self.part(f"materials.{name}", Material, table) for name, table in tables.items()
        }

    def parts(
        self, name: str, kind: type[Part], materials: Mapping[str, Material] | None = None
    ) -> tuple[Part, ...]:
        return tuple(
            self.part(f"{name}[{at}]", kind, table, materials)
            for at, table in enumerate(self.listed(name))
        )

    def part(
        self,
        place: str,
        kind: type[Part],
        table: object,
        materials: Mapping[str, Material] | None = None,
    ) -> Part:
        """Return the part that a table describes."""
        if not isinstance(table, dict):
            self.fail(place, "must be a table of keys and values")
        values: dict[str, Any] = {}
        for key, value in table.items():
            where = f"{place}.{key}"
            if key in _KEYS[kind]:
                values[key] = self.value(where, value, _KEYS[kind][key])
            elif key == "material" and materials is not None:
                values[key] = self.material(where, value, materials)
            elif key == "sleeves" and kind is ShaftSection and isinstance(value, list):
                values[key] = tuple(
                    self.part(f"{where}[{at}]", Sleeve, sleeve, materials)
                    for at, sleeve in enumerate(value)
                )
            else:
                self.fail(where, f"is unknown; allowed are {', '.join(_allowed(kind))}")
        return self.made(place, kind, values)

    def made(self, place: str, kind: Callable[..., Part], values: Mapping[str, Any]) -> Part:
        try:
            return kind(**values)
        except TypeError as error:  # a key that must be there
            missing = str(error).partition(": ")[2]
            self.fail(place, f"lacks {missing}")
        except ValueError as error:
            self.fail(place, error)

    def material(self, place: str, name: object, materials: Mapping[str, Material]) -> Material:
        if isinstance(name, str):
            if name in materials:
                return materials[name]
            known = material_named(name)
            if known is not None:
                return MATERIALS[known]
        words = ", ".join((*materials, *MATERIALS))
        self.fail(place, f"must be one of {words}, got {repr(name)[:40]}")

    def value(self, place: str, value: object, dimension: str) -> float:
        if dimension == _PLAIN:
            number = plain_number(value)
            if number is None:
                self.fail(place, f"must be a number without a unit, got {repr(value)[:40]}")
            return number
        try:
            return read_quantity(value, dimension)
        except ValueError as error:
            self.fail(place, error)


def _allowed(kind: type) -> tuple[str, ...]:
    more = {ShaftSection: ("material", "sleeves"), Sleeve: ("material",)}.get(kind, ())
    return (*_KEYS[kind], *more)


def rotor_to_toml(rotor: Rotor) -> str:
    """Return a rotor as the text of a rotor file; `rotor_from_toml` gives an equal rotor back.

    Parameters
    ----------
    rotor : Rotor

    Returns
    -------
    str
        TOML with quantities in SI units.
    """
    used: dict[Material, None] = {}
    for section in rotor.sections:
        used |= dict.fromkeys([section.material, *(one.material for one in section.sleeves)])
    names = {material: f"material_{at}" for at, material in enumerate(used, 1)}
    names |= {material: name for name, material in MATERIALS.items() if material in used}
    lines = ["# A rotor, written by rotorstab. Positions are measured from the left end."]
    if rotor.clamps:
        lines.append(f"clamps = [{', '.join(_text(place, 'length') for place in rotor.clamps)}]")
    lines += ["", "[load]", *_lines(rotor.load)]
    for material in used:
        if names[material] not in MATERIALS:
            lines += ["", f"[materials.{names[material]}]", *_lines(material)]
    for section in rotor.sections:
        lines += ["", "[[sections]]", *_lines(section), f'material = "{names[section.material]}"']
        if section.sleeves:
            inline = (
                ", ".join([*_lines(one), f'material = "{names[one.material]}"'])
                for one in section.sleeves
            )
            lines.append(f"sleeves = [{', '.join(f'{{ {one} }}' for one in inline)}]")
    for name, parts in (("disks", rotor.disks), ("bearings", rotor.bearings)):
        for part in parts:
            lines += ["", f"[[{name}]]", *_lines(part)]
    return "\n".join(lines) + "\n"


def _lines(part: object) -> list[str]:
    """Return the keys of a part with their values; an end of the load that is None is left out."""
    keys = _KEYS[type(part)]
    values = {key: getattr(part, key) for key in keys}
    return [
        f"{key} = {_text(value, keys[key])}" for key, value in values.items() if value is not None
    ]


def _text(value: float, dimension: str) -> str:
    return repr(value) if dimension == _PLAIN else f'"{value!r}{_UNIT[dimension]}"'
