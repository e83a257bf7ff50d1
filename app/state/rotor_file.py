"""Rotor files: TOML whose quantities carry units, in and out.

A file is either an SI rotor, tables [shaft] and [disk], or plain numbers, [nondimensional],
to which a [shaft] may give the scales. [operation] may add the spin speed and the load.
Every error is one line that names the line of the file, the key, what is allowed and the value.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Any

from rotorstab import ShaftDisk
from rotorstab.rotors.materials import MATERIALS, material_named, shear_coefficient

from ..reading.tables import Tables, shown
from .state import SI_INPUTS, SYMBOLS, State

__all__ = ["LARGEST_FILE", "read_rotor_file", "write_rotor_file"]

LARGEST_FILE = 8_000  # bytes; an honest one has some hundred

_OWN = {"youngs_modulus": "modulus", "shear_modulus": "modulus", "density": "density"}
_INERTIAS = {"mass": "mass", "diametral_inertia": "inertia", "polar_inertia": "inertia"}
_KEYS = {
    "shaft": ("length", "diameter", "material", *_OWN, "shear_coefficient"),
    "disk": (*_INERTIAS, "diameter", "thickness", "material", "density"),
    "nondimensional": ("shear", "disk_mass", "diametral_inertia", "polar_inertia"),
    "operation": ("spin_speed", "load_type", "tangency", "static_load_factor"),
}
_HAS_UNIT = re.compile(r"[^\W\d_]{2}|[/°]")
# the state's input, the key it came from, and one unit of the input in SI
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


def read_rotor_file(text: str) -> tuple[dict[str, Any], list[str]]:
    """Return the inputs that a rotor file sets, and what of its [operation] is out of range.

    A rotor is taken whole or not at all. What the dashboard cannot show of its operation, such as
    a speed beyond the slider's range, is left out and named.

    Returns
    -------
    inputs : dict
        By the state's names; all of them are in range.
    left_out : list of str
        One line for the user each.

    Raises
    ------
    ValueError
        With one line for the user.
    """
    if len(text.encode("utf-8", "surrogatepass")) > LARGEST_FILE:
        raise ValueError(f"the file is larger than {LARGEST_FILE // 1000} kB")
    reader = _Reader(text)
    values = reader.values()
    left_out = []
    for name, problem in State().change(values).items():
        key = reader.origins.get(name, "")
        words = _out_of_range(name, values.pop(name), problem)
        if not key.startswith("operation."):
            reader.fail(key, words)
        left_out.append(reader.sentence(key, words))
    return values, left_out


def _out_of_range(name: str, value: Any, problem: str) -> str:
    unit = SI_INPUTS.get(name, "")
    given = f"{value:.5g} {unit}".strip()
    if name in SI_INPUTS:
        return f"{problem} {unit}".strip() + f"; {given} is not"
    return f"gives {SYMBOLS[name]} = {given}, which {problem}"


class _Reader(Tables):
    """Reads the tables of one file; `origins` tells which key gave an input."""

    def __init__(self, text: str) -> None:
        super().__init__(text, _KEYS)
        self.origins: dict[str, str] = {}

    def values(self) -> dict[str, Any]:
        """Return the state's inputs."""
        for name in self.tables:
            if name not in _KEYS:
                self.fail(
                    name, f"is unknown; a rotor file has {', '.join(f'[{k}]' for k in _KEYS)}"
                )
        plain = "nondimensional" in self.tables
        if plain and "disk" in self.tables:
            self.fail("disk", "cannot stand beside [nondimensional], which gives the disk")
        shaft = self.shaft() if "shaft" in self.tables else {}
        if not plain:
            for name in ("shaft", "disk"):
                if name not in self.tables:
                    raise ValueError(
                        f"the file lacks [{name}] (or, without units, [nondimensional])"
                    )
        disk = {} if plain else self.disk()
        values = self.inputs(shaft, disk)
        frequency = None
        if shaft:
            values["units"] = "SI"
            given = disk or {"mass": 0.0, "diametral_inertia": 0.0, "polar_inertia": 0.0}
            try:
                rotor, scales = ShaftDisk.from_si(
                    **{key: shaft[key] for key, _ in _SHAFT.values()},
                    disk_mass=given["mass"],
                    diametral_inertia=given["diametral_inertia"],
                    polar_inertia=given["polar_inertia"],
                )
            except (ValueError, OverflowError, ZeroDivisionError):
                written = shown(self.tables["shaft"]["diameter"])
                self.fail(
                    "shaft.diameter",
                    f"does not fit the length: {written} is {shaft['diameter']:.4g} m, "
                    f"and the shaft is {shaft['length']:.4g} m long",
                )
            frequency = scales.frequency
            if disk:
                values["shear"] = rotor.shear
                self.origins["shear"] = "shaft.diameter"
                for name in ("disk_mass", "diametral_inertia", "polar_inertia"):
                    values[name] = getattr(rotor, name)
                    self.origins[name] = f"disk.{name.removeprefix('disk_')}"
        else:
            values["units"] = "non-dimensional"
        if plain:
            numbers = self.table("nondimensional")
            self.need("nondimensional", _KEYS["nondimensional"])
            for key, value in numbers.items():
                values[key] = self.number(f"nondimensional.{key}", value)
                self.origins[key] = f"nondimensional.{key}"
        if "operation" in self.tables:
            values |= self.operation(frequency)
        return values

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
            for key, kind in _OWN.items():
                found[key] = self.positive(f"shaft.{key}", table[key], kind)
        else:
            found["material"] = material
            found |= {key: getattr(MATERIALS[material], key) for key in _OWN}
        if "shear_coefficient" in table:
            value = self.number("shaft.shear_coefficient", table["shear_coefficient"])
            if not 0 < value <= 1:
                self.fail("shaft.shear_coefficient", f"must be in (0, 1]; {value:g} is not")
            found["shear_coefficient"] = value
            found["material"] = "own"  # a coefficient of its own makes it no handbook material
        else:
            try:
                found["shear_coefficient"] = shear_coefficient(
                    found["youngs_modulus"], found["shear_modulus"]
                )
            except ValueError:
                self.fail(
                    "shaft.shear_modulus",
                    "must be at least a third of youngs_modulus, "
                    "or shear_coefficient must be given",
                )
        return found

    def material(self, name: str, instead: tuple[str, ...]) -> str | None:
        """Return the material of a table, or None where it has data of its own."""
        table = self.tables[name]
        if "material" not in table:
            return None
        given = table["material"]
        material = material_named(given) if isinstance(given, str) else None
        if material is None:
            words = ", ".join(MATERIALS)
            self.fail(f"{name}.material", f"must be one of {words}; {shown(given)} is not")
        for key in instead:
            if key in table:
                self.fail(f"{name}.{key}", "cannot stand beside material, which gives it")
        return material

    def disk(self) -> dict[str, float]:
        """Return mass and inertias of the disk in SI, given or of a solid disk."""
        table = self.table("disk")
        if not {"diameter", "thickness"} & set(table):
            for key in ("material", "density"):
                if key in table:
                    self.fail(f"disk.{key}", "needs diameter and thickness beside it")
            self.need("disk", tuple(_INERTIAS))
            return {
                key: self.positive(f"disk.{key}", table[key], kind, zero=key != "mass")
                for key, kind in _INERTIAS.items()
            }
        for key in _INERTIAS:
            if key in table:
                self.fail(f"disk.{key}", "cannot stand beside diameter and thickness")
        self.need("disk", ("diameter", "thickness"))
        diameter, thickness = (
            self.positive(f"disk.{key}", table[key], "length") for key in ("diameter", "thickness")
        )
        material = self.material("disk", ("density",))
        if material is None:
            if "density" not in table:
                self.fail("disk", "lacks density or material")
            density = self.positive("disk.density", table["density"], "density")
        else:
            density = MATERIALS[material].density
        try:
            mass = density * math.pi * diameter**2 / 4 * thickness
            polar = mass * diameter**2 / 8
            diametral = polar / 2 + mass * thickness**2 / 12
        except OverflowError:
            self.fail("disk.diameter", "is too large")
        return {"mass": mass, "diametral_inertia": diametral, "polar_inertia": polar}

    def operation(self, frequency: float | None) -> dict[str, Any]:
        """Return spin speed and load; `frequency` is the scale of a shaft in SI."""
        table = self.table("operation")
        found: dict[str, Any] = {}
        units = "nondimensional" not in self.tables
        for key, value in table.items():
            path = f"operation.{key}"
            self.origins[key] = path
            if key == "load_type":
                kind = value.strip().casefold() if isinstance(value, str) else ""
                if kind not in State.param.load_type.objects:
                    words = ", ".join(State.param.load_type.objects)
                    self.fail(path, f"must be one of {words}; {shown(value)} is not")
                found[key] = kind
            elif key == "spin_speed" and (units or _HAS_UNIT.search(str(value)[:99])):
                if frequency is None:
                    self.fail(path, "must be a plain number Ω̄ where there is no [shaft]")
                found[key] = self.quantity(path, value, "speed") / frequency
            else:
                found[key] = self.number(path, value)
        return found


def write_rotor_file(state: State) -> str:
    """Return the rotor file of the present inputs: what is read back is what was written."""
    lines = ["# A rotor, written by rotorstab."]
    matches = state.units == "SI" and state.shaft_in_use()
    if state.units == "SI":
        lines += ["", "[shaft]", f'length = "{state.shaft_length!r} m"']
        lines.append(f'diameter = "{state.shaft_diameter!r} mm"')
        if state.material == "own":
            lines.append(f'youngs_modulus = "{state.youngs_modulus!r} GPa"')
            lines.append(f'shear_modulus = "{state.shear_modulus!r} GPa"')
            lines.append(f'density = "{state.density!r} kg/m^3"')
            lines.append(f"shear_coefficient = {state.shear_coefficient!r}")
        else:
            lines.append(f'material = "{state.material}"')
    if matches:
        lines += ["", "[disk]", f'mass = "{state.si_disk_mass!r} kg"']
        lines.append(f'diametral_inertia = "{state.si_diametral_inertia!r} kg m^2"')
        lines.append(f'polar_inertia = "{state.si_polar_inertia!r} kg m^2"')
        turns = state.spin_speed * state.scales().frequency * 60 / (2 * math.pi)
        speed = f'"{turns:.12g} rpm"'
    else:
        lines += ["", "[nondimensional]"]
        lines += [f"{key} = {getattr(state, key)!r}" for key in _KEYS["nondimensional"]]
        speed = repr(state.spin_speed)
    lines += ["", "[operation]", f"spin_speed = {speed}", f'load_type = "{state.load_type}"']
    if state.load_type == "partly":
        lines.append(f"tangency = {state.tangency!r}")
    lines.append(f"static_load_factor = {state.static_load_factor!r}")
    return "\n".join(lines) + "\n"
