"""Any rotor as a small system in units of its own: its frequency at rest and its buckling load.

Explore's code then makes its growth maps; the units give its charts in rpm, Hz and N.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from rotorstab import Rotor, Scales, System
from rotorstab.model.system import frequencies_at_rest

from ..reading.user_error import UserError
from ..state.own_file import OpenedRotor, elements_of, open_rotor
from .caches import Store

__all__ = [
    "OwnModel",
    "OwnOperation",
    "Parts",
    "keep_opened",
    "opened_model",
    "own_model",
    "scaled_rotor",
]

_MODES, _MODES_OF_FOLLOWER = 4, 6
_RIGID = 1e-3  # of the first bending frequency of the free shaft: slower motions are rigid


@dataclass(frozen=True)
class Parts:
    """A rotor and the factors by which its parts are multiplied.

    Parameters
    ----------
    rotor : Rotor
    disk_mass, inertia : float
        Of all disks.
    stiffness, damping : float
        Of all bearings.
    """

    rotor: Rotor
    disk_mass: float = 1.0
    inertia: float = 1.0
    stiffness: float = 1.0
    damping: float = 1.0


@dataclass(frozen=True)
class OwnModel:
    """A reduced rotor, as `Window` takes it.

    Parameters
    ----------
    resting : System
        The rotor at rest; its unit of frequency is `scales.frequency`, of load `scales.load`.
    scales : Scales
        These units in SI.
    buckles : bool
        Whether the unit of load is the buckling load.
    note : str
        Why it is not, for the user; else empty.
    """

    resting: System
    scales: Scales
    buckles: bool = True
    note: str = ""
    kind: str = "finite elements"

    @property
    def is_damped(self) -> bool:
        """Whether the model has damping or cross coupling."""
        return self.resting.is_damped

    @property
    def planes(self) -> bool:
        """Whether the bearings differ in two directions."""
        return self.resting.planes

    def system(self, spin_speed: float) -> System:
        """Return the system at a spin speed."""
        return self.resting.at_speed(float(spin_speed))


@dataclass(frozen=True)
class OwnOperation:
    """A rotor at its speed under its load, in its own units; `Window` takes it.

    Parameters
    ----------
    parts : Parts
    spin_speed, static_load : float
        Shares of the frequency at rest and of the buckling load.
    """

    parts: Parts
    spin_speed: float
    static_load: float

    @property
    def model(self) -> OwnModel:
        """The reduced rotor; UserError where it has none."""
        return own_model(self.parts)

    @property
    def system(self) -> System:
        """The system of the charts."""
        return self.model.system(self.spin_speed)

    @property
    def undamped(self) -> None:
        """None: the page compares with no region of Bolotin's."""
        return None

    def pulsating_load(self, factor: float) -> float:
        """Return the pulsating load of a factor, which has the same unit."""
        return factor

    def excitation_frequency(self, ratio: float) -> float:
        """Return the excitation frequency of a ratio, which has the same unit."""
        return ratio


_models: Store[Parts, OwnModel] = Store("own_model.models", 64)


def own_model(parts: Parts) -> OwnModel:
    """Return the model of a rotor with its factors; it is made once.

    Raises
    ------
    UserError
        If the rotor has no frequency at rest.
    """
    return _models.get(parts, lambda: _made(scaled_rotor(parts)))


def scaled_rotor(parts: Parts) -> Rotor:
    """Return the rotor whose parts have been multiplied."""
    disks = tuple(
        replace(
            disk,
            mass=parts.disk_mass * disk.mass,
            diametral_inertia=parts.inertia * disk.diametral_inertia,
            polar_inertia=parts.inertia * disk.polar_inertia,
        )
        for disk in parts.rotor.disks
    )
    bearings = []
    for bearing in parts.rotor.bearings:
        factors = {"k": parts.stiffness, "c": parts.damping}
        names = ("kxx", "kyy", "kxy", "kyx", "cxx", "cyy", "cxy", "cyx")
        values = {name: factors[name[0]] * getattr(bearing, name) for name in names}
        bearings.append(replace(bearing, **values))
    return replace(parts.rotor, disks=disks, bearings=tuple(bearings))


def _made(rotor: Rotor) -> OwnModel:
    elements = elements_of(rotor)
    modes = _MODES_OF_FOLLOWER if rotor.load.tangency else _MODES
    system = rotor.system(0.0, elements, modes)
    load, buckles, note = _load_unit(rotor, elements)
    frequency = _frequency_unit(rotor, system)
    section = max(rotor.sections, key=lambda one: one.length)
    scales = Scales(rotor.length, section.properties.mass * rotor.length, load, frequency)
    return OwnModel(_in_units(system, frequency, load), scales, buckles, note)


def _euler_load(rotor: Rotor) -> float:
    """Return π²EI/L² of the section that bends most easily, L of the whole shaft [N]."""
    softest = min(section.properties.bending for section in rotor.sections)
    return math.pi**2 * softest / rotor.length**2


def _load_unit(rotor: Rotor, elements: int) -> tuple[float, bool, str]:
    """Return what loads are a share of [N], whether it buckles the rotor, and why not."""
    euler = _euler_load(rotor)
    unit = "Loads are shares of π²EI/L² of its thinnest section."
    try:
        load = rotor.critical_load(elements)
    except ValueError:
        return (
            euler,
            False,
            (
                "Clamps and bearings do not hold this rotor at rest, so it has no buckling load. "
                + unit
            ),
        )
    if not math.isfinite(load):
        return euler, False, f"No static load buckles this rotor. {unit}"
    return load, True, ""


def _frequency_unit(rotor: Rotor, system: System) -> float:
    """Return the first natural frequency at rest that is no rigid motion [rad/s]."""
    mass = sum(section.length * section.properties.mass for section in rotor.sections)
    mass += sum(disk.mass for disk in rotor.disks)
    scale = math.sqrt(_euler_load(rotor) / (mass * rotor.length))
    with np.errstate(invalid="ignore"):
        frequencies = frequencies_at_rest(system)
    moving = frequencies[np.isfinite(frequencies) & (frequencies > _RIGID * scale)]
    if not moving.size:
        raise UserError("this rotor has no natural frequency at rest: its bearings push it away")
    return float(moving.min())


def _in_units(system: System, frequency: float, load: float) -> System:
    """Return a system whose unit of frequency and of load are these."""
    size = float(np.abs(system.elastic).max())
    factors = {
        "mass": frequency**2,
        "gyroscopic": frequency**2,
        "external_damping": frequency,
        "elastic": 1.0,
        "geometric": load,
        "cross_stiffness": 1.0,
        "cross_damping": frequency,
    }
    matrices = {
        name: factor / size * getattr(system, name)
        for name, factor in factors.items()
        if getattr(system, name) is not None
    }
    return replace(system, **matrices)


def opened_model(text: str) -> tuple[OpenedRotor, OwnModel | None]:
    """Return the rotor of a file and its model; another process may call this."""
    opened = open_rotor(text)
    if opened.rotor is None:
        return opened, None
    try:
        return opened, _made(opened.rotor)
    except ValueError as error:
        return OpenedRotor(None, str(error)), None


def keep_opened(found: tuple[OpenedRotor, OwnModel | None]) -> None:
    """Keep the model of a rotor that has been opened."""
    opened, model = found
    if opened.rotor is not None and model is not None:
        _models.keep(Parts(opened.rotor), model)
