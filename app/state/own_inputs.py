"""The inputs of the page Your rotor, in units of that rotor: its frequency at rest, its load."""

from __future__ import annotations

import param

from .declaration import Facts, Number, Selector
from .own_presets import OWN_FILE, OWN_PRESETS

__all__ = ["OWN_SLIDERS", "OwnInputs"]

_FACTOR = (0.2, 5.0)
OWN_SLIDERS = (
    "own_spin",
    "own_load",
    "own_disk_mass",
    "own_inertia",
    "own_stiffness",
    "own_damping",
    "own_frequency",
    "own_factor",
)
"""The sliders of the page, in their order."""


class OwnInputs(param.Parameterized):
    """The rotor of the page Your rotor, its speed and load, and factors of its parts."""

    own_rotor = Selector(
        Facts("rotor"),
        default=next(iter(OWN_PRESETS)),
        objects=[*OWN_PRESETS, OWN_FILE],
        label="Your rotor",
        doc="An example rotor, or the one of a file.",
    )
    own_spin = Number(
        Facts("rspin", symbol="Ω"),
        default=0.6,
        bounds=(0.0, 4.0),
        step=0.01,
        label="Spin speed of your rotor",
        doc="Its unit is the first natural frequency of the rotor at rest.",
    )
    own_load = Number(
        Facts("rload", symbol="α_s"),
        default=0.3,
        bounds=(-1.0, 0.95),
        step=0.01,
        label="Static load of your rotor",
        doc="Share of its buckling load; compression is positive.",
    )
    own_disk_mass = Number(
        Facts("rmass", symbol="m"),
        default=1.0,
        bounds=_FACTOR,
        step=0.05,
        label="Disk masses, factor",
        doc="Multiplies the mass of every disk.",
    )
    own_inertia = Number(
        Facts("rinertia", symbol="I"),
        default=1.0,
        bounds=_FACTOR,
        step=0.05,
        label="Disk inertias, factor",
        doc="Multiplies both moments of inertia of every disk.",
    )
    own_stiffness = Number(
        Facts("rk", symbol="k"),
        default=1.0,
        bounds=_FACTOR,
        step=0.05,
        label="Bearing stiffness, factor",
        doc="Multiplies the stiffness of every bearing.",
    )
    own_damping = Number(
        Facts("rc", symbol="c"),
        default=1.0,
        bounds=(0.0, 5.0),
        step=0.05,
        label="Bearing damping, factor",
        doc="Multiplies the damping of every bearing.",
    )
    own_frequency = Number(
        Facts("rf", symbol="θ"),
        default=0.0,
        bounds=(0.0, 7.0),
        step=0.01,
        label="Marked point, frequency",
        doc="Excitation frequency θ/2π of the marked point; at 0 it follows the strongest tongue. "
        "A click on the stability chart sets it, too.",
    )
    own_factor = Number(
        Facts("rb", symbol="Pₜ"),
        default=0.25,
        bounds=(0.0, 0.5),
        step=0.005,
        label="Marked point, pulsating load",
        doc="Pulsating load of the marked point.",
    )
