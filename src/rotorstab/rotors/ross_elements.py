"""The elements of a ROSS rotor as the parts of a rotor."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NoReturn

import numpy as np

from .._tolerances import SAME_POSITION
from .materials import Material
from .parts import Bearing, Disk, ShaftSection, Sleeve
from .places import RotorFileError
from .rotor import Rotor

__all__ = ["RossElements"]

_CONE_STEPS = 4  # cylinders in place of a conical element
_STIFFNESS = ("kxx", "kyy", "kxy", "kyx")
_DAMPING = ("cxx", "cyy", "cxy", "cyx")
_MASS = ("mxx", "myy", "mxy", "myx")


class RossElements:
    """The tables of one ROSS file.

    Parameters
    ----------
    tables : mapping
        As parsed from TOML or JSON.
    lines : mapping of str to int
        Where each table and key stands, for messages.
    spin_speed : float or None
        Where coefficients that depend on the speed are taken [rad/s].

    Attributes
    ----------
    left_out : dict of str to list of str
        What the rotor does not have, and the names of the elements that have it.
    """

    def __init__(
        self, tables: Mapping[str, Any], lines: Mapping[str, int], spin_speed: float | None
    ) -> None:
        self.tables = tables
        self.lines = lines
        self.left_out: dict[str, list[str]] = {}
        self.elements = {
            name: table
            for name, table in tables.items()
            if isinstance(table, dict) and "_" in name and not name.startswith("_")
        }
        self.nodes = [0.0]
        self.speed = spin_speed

    def rotor(self) -> Rotor:
        """Return the rotor; `left_out` is filled on the way."""
        shafts = self.named("ShaftElement")
        if not shafts:
            raise RotorFileError(
                "the file is no ROSS rotor: it has no table that begins with ShaftElement_"
            )
        for name in self.named("CouplingElement"):
            self.fail(name, "a coupling between two shafts cannot be represented")
        sections = self.sections(shafts)
        bearings = {name: table for name, table in self.elements.items() if "kxx" in table}
        self.speed = self.speed_of_coefficients(bearings)
        disks = [self.disk(name) for name in (*self.named("DiskElement"), *self.named("Gear"))]
        masses = [self.point_mass(name) for name in self.named("PointMass")]
        added = [self.added_mass(name) for name in bearings]
        for name in self.elements:
            kinds = ("ShaftElement", "DiskElement", "Gear", "PointMass")
            if name not in bearings and not name.startswith(kinds):
                self.note("this kind of element is not carried over", name)
        for name in self.named("Gear"):
            self.note("a gear is carried over as a disk", name)
        try:
            return Rotor(
                sections=tuple(sections),
                disks=tuple(part for part in (*disks, *masses, *added) if part is not None),
                bearings=tuple(self.bearing(name) for name in bearings),
            )
        except RotorFileError:
            raise
        except ValueError as error:
            raise RotorFileError(f"the rotor of the file cannot be built: {error}") from None

    def named(self, kind: str) -> list[str]:
        """Return the names of the elements of one kind, also of ROSS's 6-DoF variants."""
        return [name for name in self.elements if name.startswith(kind)]

    def fail(self, name: str, problem: object, key: str = "") -> NoReturn:
        """Refuse the file because of an element."""
        line = self.lines.get(f"{name}.{key}") or self.lines.get(name)
        where = f"line {line}: " if line else ""
        raise RotorFileError(f"{where}{name}{f', {key}' if key else ''}: {problem}")

    def note(self, reason: str, name: str) -> None:
        """Name an element in a warning."""
        self.left_out.setdefault(reason, []).append(name)

    def number(self, name: str, key: str, default: float | None = None) -> float:
        """Return a number of an element."""
        value = self.elements[name].get(key, default)
        if value is None:
            self.fail(name, f"lacks {key}")
        if isinstance(value, bool) or not isinstance(value, int | float):
            self.fail(name, f"must be a number, got {repr(value)[:40]}", key)
        if not math.isfinite(value):
            self.fail(name, f"must be a finite number, got {value}", key)
        return float(value)

    def node(self, name: str) -> float:
        """Return the position [m] of the node of an element."""
        at = self.number(name, "n")
        if not at.is_integer() or not 0 <= at < len(self.nodes):
            self.fail(name, f"must be a node of the shaft, 0 to {len(self.nodes) - 1}", "n")
        return self.nodes[int(at)]

    def sections(self, shafts: list[str]) -> list[ShaftSection]:
        """Return the sections of the shaft, and set the positions of its nodes."""
        layers: dict[int, list[str]] = {}
        for order, name in enumerate(shafts):
            at = order if self.elements[name].get("n") is None else self.number(name, "n")
            layers.setdefault(int(at), []).append(name)
        sections: list[ShaftSection] = []
        for at, names in sorted(layers.items()):
            if at != len(self.nodes) - 1:
                self.fail(
                    names[0], f"the shaft has no element at node {len(self.nodes) - 1} before", "n"
                )
            names.sort(key=lambda name: self.number(name, "idl"))
            length = self.number(names[0], "L")
            for name in names[1:]:
                if not math.isclose(self.number(name, "L"), length, rel_tol=SAME_POSITION):
                    self.fail(name, f"must be {length:g} as in {names[0]}, at the same node", "L")
            try:
                sections += self.section(names, length)
            except RotorFileError:
                raise
            except ValueError as error:
                self.fail(names[0], error)
            self.nodes.append(math.fsum(section.length for section in sections))
        return sections

    def section(self, names: list[str], length: float) -> list[ShaftSection]:
        """Return one shaft element with its layers; a conical one is divided into steps."""
        steps = 1
        for name in names:
            self.check_shaft(name)
            if self.diameters(name, 0.0) != self.diameters(name, 1.0):
                self.note(f"a conical element is {_CONE_STEPS} cylinders", name)
                steps = _CONE_STEPS
        found = []
        for step in range(steps):
            inner, *outer = (self.tube(name, (step + 0.5) / steps) for name in names)
            sleeves = tuple(Sleeve(**tube) for tube in outer)
            found.append(ShaftSection(length=length / steps, sleeves=sleeves, **inner))
        return found

    def check_shaft(self, name: str) -> None:
        """Name what a shaft element has and a section has not."""
        table = self.elements[name]
        for key, reason in (
            ("axial_force", "the axial force of elements is not carried over: give it as a load"),
            ("torque", "the torque is not carried over"),
            ("alpha", "the proportional damping of elements is not carried over"),
            ("beta", "the proportional damping of elements is not carried over"),
        ):
            if table.get(key):
                self.note(reason, name)
        for key, words in (
            ("rotary_inertia", "rotary inertia"),
            ("gyroscopic", "gyroscopic moment"),
        ):
            if table.get(key) is False:
                self.note(f"the {words} of the shaft is taken into account", name)
        if table.get("shear_effects") is not False and table.get("shear_method_calc") not in (
            None,
            "cowper",
        ):
            self.note("the shear coefficient is Cowper's", name)

    def diameters(self, name: str, share: float) -> tuple[float, float]:
        """Return the outer and inner diameter of an element at a share of its length."""
        outer, inner = (self.number(name, key) for key in ("odl", "idl"))
        right = self.number(name, "odr", outer), self.number(name, "idr", inner)
        return outer + share * (right[0] - outer), inner + share * (right[1] - inner)

    def tube(self, name: str, share: float) -> dict[str, Any]:
        """Return the arguments of a section or a sleeve."""
        outer, inner = self.diameters(name, share)
        rigid = self.elements[name].get("shear_effects") is False
        return {
            "outer_diameter": outer,
            "inner_diameter": inner,
            "material": self.material(name),
            "shear_coefficient": math.inf if rigid else None,
        }

    def material(self, name: str) -> Material:
        """Return the material of a shaft element."""
        table = self.elements[name].get("material")
        if not isinstance(table, dict):
            self.fail(name, "must be a table with E, G_s and rho", "material")
        values = []
        for key in ("E", "G_s", "rho"):
            value = table.get(key)
            if isinstance(value, bool) or not isinstance(value, int | float):
                self.fail(name, f"must have a number {key}, got {repr(value)[:40]}", "material")
            values.append(float(value))
        try:
            return Material(*values)
        except ValueError as error:
            self.fail(name, error, "material")

    def disk(self, name: str) -> Disk:
        """Return a disk."""
        position = self.node(name)
        try:
            return Disk(position, *(self.number(name, key) for key in ("m", "Id", "Ip")))
        except RotorFileError:
            raise
        except ValueError as error:
            self.fail(name, error)

    def point_mass(self, name: str) -> Disk | None:
        """Return a point mass on the shaft as a disk without inertia."""
        mass = self.elements[name].get("m")
        both = [self.number(name, key, mass) for key in ("mx", "my")]
        if both[0] != both[1]:
            self.fail(name, f"must have mx = my, got {both[0]:g} and {both[1]:g}")
        position = self.node(name)
        return Disk(position, both[0], 0.0, 0.0)

    def speed_of_coefficients(self, bearings: Mapping[str, Mapping[str, Any]]) -> float | None:
        """Return the speed where coefficients are taken: as given, or in the middle of all tables.

        Bearings with several coefficients are named in a warning.
        """
        tables = {name: self.speeds(name) for name in bearings}
        varying = [name for name, table in tables.items() if table is not None and len(table) > 1]
        if not varying:
            return self.speed
        low = max(float(np.min(tables[name])) for name in varying)
        high = min(float(np.max(tables[name])) for name in varying)
        speed = (low + high) / 2 if self.speed is None else float(self.speed)
        words = f"coefficients that depend on the speed are those at {speed:.4g} rad/s"
        if self.speed is None:
            words += ", the middle of their table"
        for name in varying:
            inside = np.min(tables[name]) <= speed <= np.max(tables[name])
            self.note(words if inside else f"{words}, outside their table: its end is taken", name)
        return speed

    def speeds(self, name: str) -> Any:
        """Return the speeds [rad/s] of an element's table of coefficients, None if it has none."""
        table = self.elements[name]
        for key in ("speed", "frequency"):
            if table.get(key) is not None:
                speeds = self.listed(name, key)
                if len(speeds) > 1 and not (np.diff(speeds) > 0).all():
                    self.fail(name, "must rise from value to value", key)
                return speeds
        return None

    def listed(self, name: str, key: str) -> Any:
        """Return the numbers of an element's key, one or several."""
        value = self.elements[name].get(key, 0.0)
        try:
            numbers = np.atleast_1d(np.asarray(value, dtype=np.float64))
        except (TypeError, ValueError):
            numbers = np.array([])
        if numbers.ndim != 1 or not numbers.size or not np.isfinite(numbers).all():
            self.fail(name, f"must be a number or a list of numbers, got {repr(value)[:40]}", key)
        return numbers

    def coefficient(self, name: str, key: str) -> float:
        """Return one coefficient of a bearing, by linear interpolation in its table."""
        values = self.listed(name, key)
        if len(values) == 1:
            return float(values[0])
        speeds = self.speeds(name)
        if speeds is None or len(speeds) != len(values):
            count = 0 if speeds is None else len(speeds)
            self.fail(name, f"has {len(values)} values for {count} speeds", key)
        return float(np.interp(self.speed or 0.0, speeds, values))

    def bearing(self, name: str) -> Bearing:
        """Return a bearing or a seal."""
        table = self.elements[name]
        if table.get("n_link") is not None:
            self.fail(name, "a bearing on a support of its own cannot be represented", "n_link")
        defaults = {"kyy": "kxx", "cyy": "cxx"}
        values = {}
        for key in (*_STIFFNESS, *_DAMPING):
            source = key if table.get(key) is not None else defaults.get(key, key)
            values[key] = self.coefficient(name, source)
        for key in ("kzz", "czz"):
            if self.listed(name, key).any():
                self.note("axial stiffness and damping are not carried over", name)
        position = self.node(name)
        try:
            return Bearing(position, **values)
        except ValueError as error:
            self.fail(name, error)

    def added_mass(self, name: str) -> Disk | None:
        """Return the added mass of a bearing as a mass on the shaft; name one that is unequal."""
        masses = [self.coefficient(name, key) for key in _MASS]
        if not any(masses):
            return None
        if masses[0] != masses[1] or masses[0] < 0 or masses[2] or masses[3]:
            self.note("an added mass that depends on the direction is not carried over", name)
            return None
        return Disk(self.node(name), masses[0], 0.0, 0.0)
