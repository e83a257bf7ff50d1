"""Values of rotors of sections, disks and bearings, from a textbook and from another program."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial

import numpy as np

from ...floquet.point import growth_rate
from ...floquet.resonance import resonances
from ...model.finite_element import first_modes
from ...rotors.parts import Bearing
from ...rotors.presets import PRESETS
from ...rotors.rotor import Rotor
from ...whirl.frequencies import whirl_frequencies
from .structure import Published, item

__all__ = ["any_rotor"]

ANY_ROTOR = "Any rotor"
_BOOK = "Friswell, Penny, Garvey, Lees 2010"
_RPM = math.pi / 30


def _frequency(rotor: Rotor, turns: float, load: float, unit: float, number: int) -> float:
    """Return one of the slowest frequencies |ω|, in rising order."""
    whirl = np.sort(np.abs(whirl_frequencies(rotor.system(turns * _RPM), load).real))
    return float(whirl[number] / unit)


def _frequencies(
    rotor: Rotor, label: str, turns: float, load: float, unit: str, printed: tuple[str, ...]
) -> list[Published]:
    """Return the frequencies that a table prints; at rest every second one is another."""
    step = 2 if turns == 0 else 1
    size = 2 * math.pi if unit == "Hz" else 1.0
    return [
        item(
            ANY_ROTOR,
            f"{label}, {turns:g} r.p.m., frequency {at + 1}",
            unit,
            text,
            _BOOK,
            partial(_frequency, rotor, turns, load, size, step * at),
        )
        for at, text in enumerate(printed)
    ]


def _tongue(which: int) -> float:
    """Return the centre [Hz] or the growth there [1/s] of 1B+1F, in six free modes at rest."""
    rotor = PRESETS["overhung disk"]
    load = rotor.critical_load()
    system = first_modes(rotor.system(4000 * _RPM), 0.0, 6)
    centre = resonances(system, 0.3 * load, 0.1 * load)["1B+1F"].centre
    growth = growth_rate(system, 0.3 * load, 0.1 * load, centre)
    return (centre / (2 * math.pi), float(growth))[which]


def any_rotor() -> list[Published]:
    """Return the values of Friswell et al., of ROSS, and of a tongue of a separate code."""
    two, overhung = PRESETS["two disks"], PRESETS["overhung disk"]
    thin = PRESETS["thin overhung shaft"]
    soft = tuple(Bearing(place, kxx=1e6, kyy=0.8e6) for place in (0.0, 1.5))
    equal = replace(two.disks[0], position=1.0)
    example = replace(two, disks=(two.disks[0], equal), bearings=soft)
    tension = "example 5.9.7, tension 100 kN"
    return [
        *_frequencies(two, tension, 0, -1e5, "Hz", ("15.020440", "46.132265", "120.620287")),
        *_frequencies(
            two,
            tension,
            4000,
            -1e5,
            "Hz",
            ("14.867629", "15.156882", "42.570013", "49.325073", "100.969101", "139.063735"),
        ),
        *_frequencies(
            overhung,
            "example 5.9.9",
            4000,
            0.0,
            "rad/s",
            ("76.19", "103.91", "565.99", "634.23", "647.75", "1174.2"),
        ),
        *_frequencies(thin, "example 6.8.1", 0, 0.0, "rad/s", ("44.322", "397.537")),
        *_frequencies(
            thin, "example 6.8.1", 1000, 0.0, "rad/s", ("42.250", "46.404", "389.801", "402.327")
        ),
        *(
            item(
                ANY_ROTOR,
                f"rotor_example of ROSS, kxx = 1 MN/m, kyy = 0.8 MN/m, at rest, frequency {at + 1}",
                "rad/s",
                text,
                "documentation of Rotor.run_modal, ROSS 2.3",
                partial(_frequency, example, 0.0, 0.0, 1.0, 2 * at),
            )
            for at, text in enumerate(("91.79655318", "96.28899977"))
        ),
        item(
            ANY_ROTOR,
            "example 5.9.9, buckling load, whole shaft compressed",
            "N",
            "206435.6",
            "separate code",
            overhung.critical_load,
        ),
        *(
            item(
                ANY_ROTOR,
                f"example 5.9.9, 4000 r.p.m., α_s = 0.3, {words} of tongue 1B+1F at β_d = 0.1",
                unit,
                text,
                "separate code, six free modes at rest",
                partial(_tongue, at),
            )
            for at, (words, unit, text) in enumerate(
                [("centre", "Hz", "24.3524"), ("growth at the centre", "1/s", "2.49777")]
            )
        ),
    ]
