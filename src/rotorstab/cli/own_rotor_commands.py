"""The commands for your own rotor: its whirl frequencies and its Bolotin regions.

Every function takes the parsed arguments and raises ValueError or OSError with one clear line.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import fields
from typing import Any

import numpy as np

from .._arguments import number
from ..drawing.formats import FORMATS, TABLE_FORMATS
from ..model.finite_element import finite_element
from ..model.lumped import lumped
from ..model.system import System
from ..paper import own_regions
from ..rotors.shaft_disk import ShaftDisk
from ..whirl.frequencies import whirl_frequencies
from .output import emit, figure_data, text_table
from .values import MOST_VALUES

__all__ = ["FINITE_ELEMENT", "LUMPED", "run_regions", "run_whirl"]

LUMPED, FINITE_ELEMENT = "lumped", "finite-element"
"""The models that `--model` names."""


def _rotor(arguments: argparse.Namespace) -> ShaftDisk:
    return ShaftDisk(**{field.name: getattr(arguments, field.name) for field in fields(ShaftDisk)})


def _stiffness_law(arguments: argparse.Namespace) -> str:
    """Return the name of the stiffness law; the finite elements have the linear one."""
    # before `--stiffness` was added, `--model exact` chose the law
    law = arguments.stiffness or ("exact" if arguments.model == "exact" else "linear")
    if arguments.model == FINITE_ELEMENT and law != "linear":
        raise ValueError(
            f"`--stiffness {law}` is for the lumped model; finite elements have the linear law"
        )
    return str(law)


def _system(arguments: argparse.Namespace) -> System:
    """Return the rotor's system at rest, by the chosen model and stiffness law."""
    rotor, law = _rotor(arguments), _stiffness_law(arguments)
    damping = (arguments.external_damping, arguments.internal_damping)
    if arguments.model == FINITE_ELEMENT:
        modes = None if arguments.modes is None else int(arguments.modes)
        return finite_element(rotor, 0.0, arguments.tangency, arguments.elements, modes, *damping)
    return lumped(rotor, 0.0, arguments.tangency, *damping, law)


def _parameters(arguments: argparse.Namespace, *names: str) -> dict[str, Any]:
    """Return the named arguments as plain values."""
    rotor = [field.name for field in fields(ShaftDisk)]
    values = {name: getattr(arguments, name) for name in (*rotor, "tangency", *names)}
    if arguments.model == FINITE_ELEMENT:
        values |= {
            "model": FINITE_ELEMENT,
            "elements": arguments.elements,
            "modes": arguments.modes,
        }
    else:
        values |= {"model": LUMPED, "stiffness": _stiffness_law(arguments)}
    return {k: v.tolist() if isinstance(v, np.ndarray) else v for k, v in values.items()}


def run_whirl(arguments: argparse.Namespace) -> None:
    """Write or print whirl frequencies over spin speeds and loads."""
    spins, loads = arguments.spin_speed, arguments.load
    number("spin-speed × load values", spins.size * loads.size, 1, MOST_VALUES)
    frequencies = whirl_frequencies(_system(arguments).at_speed(spins[:, None]), loads)
    roots = frequencies.shape[-1]
    columns: dict[str, Sequence[Any]] = {
        "spin_speed": np.repeat(spins, loads.size * roots).tolist(),
        "load": np.tile(np.repeat(loads, roots), spins.size).tolist(),
        "root": list(range(1, roots + 1)) * (spins.size * loads.size),
        "frequency": frequencies.real.ravel().tolist(),
        "growth_rate": (-frequencies.imag.ravel() + 0.0).tolist(),
    }
    details = [
        "spin_speed, frequency, growth_rate [√(EI/ρAL⁴)], load [EI/L²]",
        "frequency above 0: forward whirl, below 0: backward",
    ]
    parameters = _parameters(arguments, "external_damping", "internal_damping")
    emit(
        text_table(columns),
        lambda name: TABLE_FORMATS[name].columns("Whirl frequencies", details, parameters, columns),
        arguments,
        TABLE_FORMATS,
    )


def run_regions(arguments: argparse.Namespace) -> None:
    """Write or print the Bolotin regions of a rotor that the arguments describe."""
    figure = own_regions(
        _system(arguments),
        arguments.shear,
        arguments.spin_speed.tolist(),
        arguments.static_factor.tolist(),
        arguments.largest_factor,
        _parameters(arguments),
    )
    columns: dict[str, list[Any]] = {"panel": [], "boundary": [], "beta_d": [], "theta/omega_n": []}
    for panel in figure.panels:
        for line in panel.series:
            for beta in np.linspace(0.0, arguments.largest_factor, 6):
                row = (panel.title, line.name, float(beta), float(np.interp(beta, line.y, line.x)))
                for column, value in zip(columns.values(), row, strict=True):
                    column.append(value)
    emit(
        text_table(columns),
        lambda name: figure_data(figure, [name])[name],
        arguments,
        FORMATS,
    )
