"""The tables of a rotor file, and how they become inputs of the dashboard."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Any

from rotorstab import Scales, ShaftDisk
from rotorstab.rotors.materials import MATERIALS, material_named, shear_coefficient

from ..reading.tables import Tables, shown
from ..reading.user_error import UserError
from .state import State

__all__ = ["KEYS", "RotorTables"]

_OWN = {"youngs_modulus": "modulus", "shear_modulus": "modulus", "density": "density"}
_INERTIAS = {"mass": "mass", "diametral_inertia": "inertia", "polar_inertia": "inertia"}
KEYS = {
    "shaft": ("length", "diameter", "material", *_OWN, "shear_coefficient"),
    "disk": (*_INERTIAS, "diameter", "thickness", "material", "density"),
    "nondimensional": ("shear", "disk_mass", "diametral_inertia", "polar_inertia"),
    "operation": ("spin_speed", "load_type", "tangency", "static_load_factor"),
}
_HAS_UNIT = re.compile(r"[^\W\d_]{2}|[/°]")
# by the state's input: the key that gives it, and one unit of the input in SI
_SHAFT = {
    "shaft_length": ("length", 1.0),
    "shaft_diameter": ("diameter", 1e-3),
    "youngs_modulus": ("youngs_modulus", 1e9),
    "shear_modulus": ("shear_modulus", 1e9),
    "density": ("density", 1.0),
    "shear_coefficient": ("shear_coefficient", 1.0),
}
_DISK = {
    "si_disk_mass": "mass",
    "si_diametral_inertia": "diametral_inertia",
    "si_polar_inertia": "polar_inertia",
}


class RotorTables(Tables):
    """The tables of one rotor file; `origins` holds the key that gave each input."""

    def __init__(self, text: str) -> None:
        super().__init__(text, KEYS)
        self.origins: dict[str, str] = {}

    def values(self) -> dict[str, Any]:
        """Return the state's inputs."""
        self._check_tables()
        shaft = self.shaft() if "shaft" in self.tables else {}
        disk = {} if self.is_plain else self.disk()
        values = self.inputs(shaft, disk) | {"units": "SI" if shaft else "non-dimensional"}
        frequency = None
        if shaft:
            rotor, scales = self._rotor(shaft, disk)
            frequency = scales.frequency
            if disk:
                values |= self._rotor_inputs(rotor)
        if self.is_plain:
            values |= self._plain_numbers()
        if "operation" in self.tables:
            values |= self.operation(frequency)
        return values

    @property
    def is_plain(self) -> bool:
        """Whether the rotor is given by plain numbers."""
        return "nondimensional" in self.tables

    def _check_tables(self) -> None:
        """Refuse a file with an unknown table, or without a rotor."""
        for name in self.tables:
            if name not in KEYS:
                self.fail(
                    name, f"is unknown; a rotor file has {', '.join(f'[{key}]' for key in KEYS)}"
                )
        if self.is_plain and "disk" in self.tables:
            self.fail("disk", "cannot stand beside [nondimensional], which gives the disk")
        for name in () if self.is_plain else ("shaft", "disk"):
            if name not in self.tables:
                raise UserError(f"the file lacks [{name}] (or, without units, [nondimensional])")

    def _rotor(
        self, shaft: Mapping[str, Any], disk: Mapping[str, float]
    ) -> tuple[ShaftDisk, Scales]:
        """Return the rotor of the SI data, of a disk without mass if there is none."""
        disk = disk or dict.fromkeys(_INERTIAS, 0.0)
        try:
            return ShaftDisk.from_si(
                **{key: shaft[key] for key, _ in _SHAFT.values()},
                disk_mass=disk["mass"],
                diametral_inertia=disk["diametral_inertia"],
                polar_inertia=disk["polar_inertia"],
            )
        except (ValueError, OverflowError, ZeroDivisionError):
            diameter = shown(self.tables["shaft"]["diameter"])
            self.fail(
                "shaft.diameter",
                f"does not fit the length: {diameter} is {shaft['diameter']:.4g} m, "
                f"and the shaft is {shaft['length']:.4g} m long",
            )

    def _rotor_inputs(self, rotor: ShaftDisk) -> dict[str, float]:
        """Return the non-dimensional inputs of a rotor that was given in SI."""
        self.origins["shear"] = "shaft.diameter"
        values = {"shear": rotor.shear}
        for name in ("disk_mass", "diametral_inertia", "polar_inertia"):
            values[name] = getattr(rotor, name)
            self.origins[name] = f"disk.{name.removeprefix('disk_')}"
        return values

    def _plain_numbers(self) -> dict[str, float]:
        """Return the inputs that [nondimensional] gives."""
        numbers = self.table("nondimensional")
        self.need("nondimensional", KEYS["nondimensional"])
        for key in numbers:
            self.origins[key] = f"nondimensional.{key}"
        return {key: self.number(self.origins[key], value) for key, value in numbers.items()}

    def inputs(self, shaft: Mapping[str, Any], disk: Mapping[str, float]) -> dict[str, Any]:
        """Return the inputs of the SI data, in the units of the inputs."""
        values: dict[str, Any] = {}
        if shaft:
            values["material"] = shaft["material"]
            for name, (key, unit) in _SHAFT.items():
                if key in ("length", "diameter") or shaft["material"] == "own":
                    # 207e9/1e9 is 207 to the last digit, 207e9·1e-9 is not
                    values[name] = float(f"{shaft[key] / unit:.15g}")
                    self.origins[name] = f"shaft.{key}"
        for name, key in _DISK.items():
            if disk:
                values[name] = disk[key]
                self.origins[name] = f"disk.{key}"
        return values

    def shaft(self) -> dict[str, Any]:
        """Return the shaft's data in SI, every key of it."""
        table = self.table("shaft")
        self.need("shaft", ("length", "diameter"))
        found: dict[str, Any] = {
            key: self.positive(f"shaft.{key}", table[key], "length")
            for key in ("length", "diameter")
        }
        material = self.material("shaft", tuple(_OWN))
        if material is None:
            self.need("shaft", tuple(_OWN))
            found["material"] = "own"
            for key, dimension in _OWN.items():
                found[key] = self.positive(f"shaft.{key}", table[key], dimension)
        else:
            found["material"] = material
            found |= {key: getattr(MATERIALS[material], key) for key in _OWN}
        if "shear_coefficient" in table:
            found["material"] = "own"  # a coefficient of its own makes it no handbook material
        return found | {"shear_coefficient": self._shear_coefficient(found)}

    def _shear_coefficient(self, shaft: Mapping[str, Any]) -> float:
        """Return the shaft's κ as given, or Cowper's."""
        table = self.table("shaft")
        if "shear_coefficient" in table:
            value = self.number("shaft.shear_coefficient", table["shear_coefficient"])
            if not 0 < value <= 1:
                self.fail("shaft.shear_coefficient", f"must be in (0, 1]; {value:g} is not")
            return value
        try:
            return shear_coefficient(shaft["youngs_modulus"], shaft["shear_modulus"])
        except ValueError:
            self.fail(
                "shaft.shear_modulus",
                "must be at least a third of youngs_modulus, or shear_coefficient must be given",
            )

    def material(self, name: str, instead: tuple[str, ...]) -> str | None:
        """Return the material of a table, or None if the table has data of its own.

        The keys of `instead` cannot stand beside a material.
        """
        table = self.tables[name]
        if "material" not in table:
            return None
        word = table["material"]
        material = material_named(word) if isinstance(word, str) else None
        if material is None:
            words = ", ".join(MATERIALS)
            self.fail(f"{name}.material", f"must be one of {words}; {shown(word)} is not")
        for key in instead:
            if key in table:
                self.fail(f"{name}.{key}", "cannot stand beside material, which gives it")
        return material

    def disk(self) -> dict[str, float]:
        """Return mass and inertias of the disk in SI, as given or of a solid disk."""
        table = self.table("disk")
        if {"diameter", "thickness"} & set(table):
            return self._solid_disk()
        for key in ("material", "density"):
            if key in table:
                self.fail(f"disk.{key}", "needs diameter and thickness beside it")
        self.need("disk", tuple(_INERTIAS))
        return {
            key: self.positive(f"disk.{key}", table[key], dimension, zero=key != "mass")
            for key, dimension in _INERTIAS.items()
        }

    def _solid_disk(self) -> dict[str, float]:
        """Return mass and inertias of a disk of given diameter, thickness and density."""
        table = self.table("disk")
        for key in _INERTIAS:
            if key in table:
                self.fail(f"disk.{key}", "cannot stand beside diameter and thickness")
        self.need("disk", ("diameter", "thickness"))
        diameter, thickness = (
            self.positive(f"disk.{key}", table[key], "length") for key in ("diameter", "thickness")
        )
        material = self.material("disk", ("density",))
        if material is not None:
            density = MATERIALS[material].density
        elif "density" in table:
            density = self.positive("disk.density", table["density"], "density")
        else:
            self.fail("disk", "lacks density or material")
        try:
            mass = density * math.pi * diameter**2 / 4 * thickness
            polar = mass * diameter**2 / 8
            diametral = polar / 2 + mass * thickness**2 / 12
        except OverflowError:
            self.fail("disk.diameter", "is too large")
        return {"mass": mass, "diametral_inertia": diametral, "polar_inertia": polar}

    def operation(self, frequency: float | None) -> dict[str, Any]:
        """Return spin speed and load; `frequency` is one unit of it for a shaft in SI [rad/s]."""
        table = self.table("operation")
        found: dict[str, Any] = {}
        units = "nondimensional" not in self.tables
        for key, value in table.items():
            path = f"operation.{key}"
            self.origins[key] = path
            if key == "load_type":
                load_type = value.strip().casefold() if isinstance(value, str) else ""
                if load_type not in State.param.load_type.objects:
                    words = ", ".join(State.param.load_type.objects)
                    self.fail(path, f"must be one of {words}; {shown(value)} is not")
                found[key] = load_type
            elif key == "spin_speed" and (units or _HAS_UNIT.search(str(value)[:99])):
                if frequency is None:
                    self.fail(path, "must be a plain number Ω̄ where there is no [shaft]")
                found[key] = self.quantity(path, value, "speed") / frequency
            else:
                found[key] = self.number(path, value)
        return found
