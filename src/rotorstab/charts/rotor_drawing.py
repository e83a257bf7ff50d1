"""A rotor of any shape, drawn to scale: its sections, disks, bearings and clamps, and its load."""

from __future__ import annotations

import math

import numpy as np

from .._types import Array
from ..rotors.parts import Bearing, Disk
from ..rotors.rotor import Rotor
from ..rotors.sections import ShaftSection, Sleeve
from .columns import Lines, label_columns
from .numbers import written
from .quantities import Quantity
from .structure import Chart, Layer

__all__ = ["rotor_drawing"]

_MARGIN = 0.17  # of the length of the shaft: room for the load on each side
_SYMBOL = 0.05  # of the length: size of a bearing
_ARROW = 0.12  # of the length: length of the arrow of the load
_THIN = 0.006  # of the length: least thickness of a disk
_POINT = 0.02  # of the length: radius of a mass without moments of inertia
_MOST_NAMES = 14  # marks with a name; more would stand on each other

_Box = tuple[float, float, float, float]


def rotor_drawing(rotor: Rotor) -> Chart:
    """Return the side view of a rotor; a square of the chart must be drawn as a square.

    A disk is drawn as the solid cylinder that has its mass and its moments of inertia. Bearings,
    clamps and the arrows of the load are symbols, whose size follows the length of the shaft.

    Parameters
    ----------
    rotor : Rotor

    Returns
    -------
    Chart
        Both axes in m.
    """
    drawing = _Drawing(rotor)
    drawing.sections()
    drawing.disks()
    drawing.supports()
    drawing.load()
    length, half = rotor.length, drawing.top
    return Chart(
        key="rotor-drawing",
        title="The rotor",
        x=Quantity("position", "x", "m"),
        y=Quantity("", "y", "m"),
        x_range=(-_MARGIN * length, (1 + _MARGIN) * length),
        y_range=(-1.25 * half, 1.25 * half),
        layers=(
            Layer("areas", "parts", drawing.areas.columns),
            Layer("lines", "part edges", drawing.edges.columns),
            Layer("labels", "part names", label_columns(drawing.names)),
        ),
        units="SI",
    )


class _Drawing:
    """Collects the parts of the drawing of one rotor."""

    def __init__(self, rotor: Rotor) -> None:
        self.rotor = rotor
        self.size = _SYMBOL * rotor.length
        self.areas, self.edges = Lines(), Lines()
        self.names: list[tuple[float, float, str, str]] = []
        self.ends = np.cumsum([0.0, *(section.length for section in rotor.sections)])
        self.top = 2 * self.size
        self.named = len(rotor.disks) + len(rotor.bearings) <= _MOST_NAMES

    def polygon(self, x: Array, y: Array, name: str, role: str) -> None:
        self.areas.add(x, y, name, role)
        self.edges.add(np.append(x, x[0]), np.append(y, y[0]), name, role)

    def box(self, box: _Box, name: str, role: str) -> None:
        left, right, low, high = box
        x, y = np.array([left, right, right, left]), np.array([low, low, high, high])
        self.polygon(x, y, name, role)

    def radius_at(self, position: float) -> float:
        """Return the largest radius of the sections that meet at a position."""
        near = 1e-9 * self.rotor.length
        touching = [
            _outer(section) / 2
            for section, left, right in zip(
                self.rotor.sections, self.ends[:-1], self.ends[1:], strict=True
            )
            if left - near <= position <= right + near
        ]
        return max(touching, default=0.0)

    def sections(self) -> None:
        length = self.rotor.length
        axis = np.array([-0.04, 1.04]) * length
        self.edges.add(axis, np.zeros(2), "axis of rotation", "axis")
        for number, section in enumerate(self.rotor.sections, 1):
            left, right = self.ends[number - 1 : number + 1]
            self.top = max(self.top, _outer(section) / 2)
            tubes: tuple[ShaftSection | Sleeve, ...] = (section, *section.sleeves)
            for tube in tubes:
                inner, outer = tube.inner_diameter / 2, tube.outer_diameter / 2
                word = "sleeve of section" if isinstance(tube, Sleeve) else "section"
                name = f"{word} {number}: Ø {_mm(tube.outer_diameter)}"
                if inner:
                    name += f", bore {_mm(tube.inner_diameter)}"
                name += f", {_mm(section.length)} long"
                spans = ((inner, outer), (-outer, -inner)) if inner else ((-outer, outer),)
                for low, high in spans:
                    self.box((left, right, low, high), name, "shaft")

    def disks(self) -> None:
        length = self.rotor.length
        for number, disk in enumerate(self.rotor.disks, 1):
            radius, width = _cylinder(disk)
            radius = radius or self.radius_at(disk.position) + _POINT * length
            half = max(width, _THIN * length) / 2
            name = (
                f"disk {number}: {written(disk.mass)} kg, I_D {written(disk.diametral_inertia)}, "
                f"I_P {written(disk.polar_inertia)} kg m²"
            )
            where = disk.position
            self.box((where - half, where + half, -radius, radius), name, "disk")
            self.top = max(self.top, radius)
            if self.named:
                self.names.append((where + half, radius, f"D{number}", "lower right"))

    def supports(self) -> None:
        for number, bearing in enumerate(self.rotor.bearings, 1):
            where, radius = bearing.position, self.radius_at(bearing.position)
            x = where + self.size * np.array([0.0, 0.55, -0.55])
            for side in (1, -1):
                y = side * (radius + self.size * np.array([0.0, 0.9, 0.9]))
                self.polygon(x, y, _bearing_words(number, bearing), "bearing")
            self.top = max(self.top, radius + 1.6 * self.size)
            if self.named:
                low = -radius - 0.5 * self.size
                self.names.append((where + 0.4 * self.size, low, f"B{number}", "right"))
        for number, where in enumerate(self.rotor.clamps, 1):
            half = self.radius_at(where) + self.size
            thick = 0.4 * self.size
            # a clamp at an end of the shaft stands beyond it
            shift = thick * {0.0: -1, self.rotor.length: 1}.get(where, 0)
            box = (where + shift - thick, where + shift + thick, -half, half)
            self.box(box, f"clamp {number}: neither moves nor turns", "clamp")
            self.top = max(self.top, half)

    def load(self) -> None:
        rotor = self.rotor
        start, end = rotor.load.start, rotor.load_end
        way = math.copysign(1.0, end - start)
        tangency = rotor.load.tangency
        words = {0.0: "axial", 1.0: "follower"}.get(tangency, f"μ = {written(tangency)}")
        self.arrow(end, way, f"load, {words}: it is applied here")
        self.arrow(start, -way, "load: it is held here, along the axis at rest")

    def arrow(self, tip: float, way: float, name: str) -> None:
        """Add an arrow whose tail lies on the side `way` of its tip."""
        length = self.rotor.length
        tail, neck = tip + way * _ARROW * length, tip + way * 0.35 * _ARROW * length
        half = 0.25 * _ARROW * length
        self.edges.add(np.array([neck, tail]), np.zeros(2), name, "load")
        x, y = np.array([tip, neck, neck]), np.array([0.0, half, -half])
        self.polygon(x, y, name, "load")


def _outer(section: ShaftSection) -> float:
    """Return the outer diameter of a section with its sleeves."""
    return max(section.outer_diameter, *(one.outer_diameter for one in section.sleeves), 0.0)


def _cylinder(disk: Disk) -> tuple[float, float]:
    """Return radius and width of the solid cylinder with the mass and the moments of a disk.

    I_P = m r²/2 and I_D = m (3r² + h²)/12. A part with a smaller I_D than that of a thin disk has
    width 0; one without a mass or without I_P has the radius 0.
    """
    if not disk.mass or not disk.polar_inertia:
        return 0.0, 0.0
    square = 2 * disk.polar_inertia / disk.mass
    width = 12 * disk.diametral_inertia / disk.mass - 3 * square
    return math.sqrt(square), math.sqrt(max(width, 0.0))


def _bearing_words(number: int, bearing: Bearing) -> str:
    """Return stiffness and damping of a bearing, both directions where they differ."""
    assert bearing.kyy is not None  # `Bearing` has put one
    assert bearing.cyy is not None
    pairs = ((bearing.kxx, bearing.kyy, "N/m"), (bearing.cxx, bearing.cyy, "N s/m"))
    words = [
        f"{written(one)} {unit}" if one == other else f"{written(one)} and {written(other)} {unit}"
        for one, other, unit in pairs
        if one or other
    ]
    crossed = any((bearing.kxy, bearing.kyx, bearing.cxy, bearing.cyx))
    words += ["cross-coupled"] if crossed else []
    return f"bearing {number}: {', '.join(words) or 'no stiffness'}"


def _mm(length: float) -> str:
    return f"{written(length * 1e3)} mm"
