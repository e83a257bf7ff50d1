"""The shaft elements of a ROSS rotor as sections of a shaft."""

from __future__ import annotations

import math
from typing import Any

from .._tolerances import SAME_POSITION
from .materials import Material
from .places import RotorFileError
from .quantities import plain_number
from .ross_tables import RossTables
from .sections import ShaftSection, Sleeve

__all__ = ["shaft_sections"]

_MOST_ELEMENTS = 1000  # of a shaft with its layers; ROSS's compressor has 91
_CONE_STEPS = 4  # cylinders in place of a conical element
_LEFT_OUT = {
    "axial_force": "the axial force of elements is not carried over: give it as a load",
    "torque": "the torque is not carried over",
    "alpha": "the proportional damping of elements is not carried over",
    "beta": "the proportional damping of elements is not carried over",
}
_ALWAYS = {"rotary_inertia": "rotary inertia", "gyroscopic": "gyroscopic moment"}


def shaft_sections(ross: RossTables) -> tuple[list[ShaftSection], list[float]]:
    """Return the sections of the shaft, and the positions [m] of the nodes of the file.

    Elements at one node are layers: the innermost is the section, the others are its sleeves.

    Parameters
    ----------
    ross : RossTables

    Returns
    -------
    sections : list of ShaftSection
    nodes : list of float

    Raises
    ------
    RotorFileError
        If there is no shaft, or an element cannot be a section.
    """
    names = ross.named("ShaftElement")
    if not names:
        raise RotorFileError(
            "the file is no ROSS rotor: it has no table that begins with ShaftElement_"
        )
    if len(names) > _MOST_ELEMENTS:
        raise RotorFileError(
            f"the file has {len(names)} shaft elements, more than {_MOST_ELEMENTS}"
        )
    layers: dict[int, list[str]] = {}
    for order, name in enumerate(names):
        given = ross.elements[name].get("n") is not None
        at = ross.node(name, len(names) - 1) if given else order
        layers.setdefault(at, []).append(name)
    sections: list[ShaftSection] = []
    nodes = [0.0]
    for at, layer in sorted(layers.items()):
        if at != len(nodes) - 1:
            ross.fail(layer[0], f"the shaft has no element at node {len(nodes) - 1} before", "n")
        sections += _sections_of_layers(ross, layer)
        nodes.append(math.fsum(section.length for section in sections))
    return sections, nodes


def _sections_of_layers(ross: RossTables, names: list[str]) -> list[ShaftSection]:
    """Return the elements at one node as a section; conical ones are divided into steps."""
    names = sorted(names, key=lambda name: ross.number(name, "idl"))
    length = ross.number(names[0], "L")
    steps = 1
    for name in names:
        if not math.isclose(ross.number(name, "L"), length, rel_tol=SAME_POSITION):
            ross.fail(name, f"must be {length:g} as in {names[0]}, at the same node", "L")
        _note_differences(ross, name)
        if _diameters(ross, name, 0.0) != _diameters(ross, name, 1.0):
            ross.note(f"a conical element is {_CONE_STEPS} cylinders", name)
            steps = _CONE_STEPS
    try:
        return [_section(ross, names, length / steps, (at + 0.5) / steps) for at in range(steps)]
    except RotorFileError:
        raise
    except ValueError as error:
        ross.fail(names[0], error)


def _section(ross: RossTables, names: list[str], length: float, share: float) -> ShaftSection:
    """Return a section with the diameters at a share of the elements' length."""
    inner, *outer = (_tube(ross, name, share) for name in names)
    return ShaftSection(length=length, sleeves=tuple(Sleeve(**tube) for tube in outer), **inner)


def _note_differences(ross: RossTables, name: str) -> None:
    """Name what a shaft element has and a section has not."""
    table = ross.elements[name]
    for key, reason in _LEFT_OUT.items():
        if table.get(key):
            ross.note(reason, name)
    for key, words in _ALWAYS.items():
        if table.get(key) is False:
            ross.note(f"the {words} of the shaft is taken into account", name)
    method = table.get("shear_method_calc", "cowper")
    if table.get("shear_effects") is not False and method != "cowper":
        ross.note("the shear coefficient is Cowper's", name)


def _diameters(ross: RossTables, name: str, share: float) -> tuple[float, float]:
    """Return the outer and inner diameter of an element at a share of its length."""
    outer, inner = (ross.number(name, key) for key in ("odl", "idl"))
    right = ross.number(name, "odr", outer), ross.number(name, "idr", inner)
    return outer + share * (right[0] - outer), inner + share * (right[1] - inner)


def _tube(ross: RossTables, name: str, share: float) -> dict[str, Any]:
    """Return the arguments of a section or a sleeve."""
    outer, inner = _diameters(ross, name, share)
    rigid = ross.elements[name].get("shear_effects") is False
    return {
        "outer_diameter": outer,
        "inner_diameter": inner,
        "material": _material(ross, name),
        "shear_coefficient": math.inf if rigid else None,
    }


def _material(ross: RossTables, name: str) -> Material:
    """Return the material of a shaft element."""
    table = ross.elements[name].get("material")
    if not isinstance(table, dict):
        ross.fail(name, "must be a table with E, G_s and rho", "material")
    values = []
    for key in ("E", "G_s", "rho"):
        value = plain_number(table.get(key))
        if value is None:
            shown = repr(table.get(key))[:40]
            ross.fail(name, f"must have a number {key}, got {shown}", "material")
        values.append(value)
    try:
        return Material(*values)
    except ValueError as error:
        ross.fail(name, error, "material")
