"""The Python program that computes what the Explore page shows, with rotorstab alone."""

from __future__ import annotations

from .analysis import (
    BOUNDARY_ROWS,
    ELEMENTS,
    LARGEST_SPEED,
    MODES,
    PIXELS,
    SPEEDS,
    map_options,
    model_of,
)
from .state import State

__all__ = ["python_snippet"]


def _arguments(**values: object) -> str:
    return ", ".join(f"{name}={value!r}" for name, value in values.items())


def _system(state: State, damped: bool) -> str:
    """Return the call that makes the system at `spin_speed`."""
    tangency = state.effective_tangency()
    options: dict[str, object] = {"tangency": tangency} if tangency else {}
    maker = "lumped"
    if state.model != "lumped":
        maker = "finite_element"
        options |= {"elements": ELEMENTS, "modes": MODES}
    elif state.law == "exact":
        options["stiffness"] = "exact"
    if damped:
        for name in ("external_damping", "internal_damping"):
            if getattr(state, name):
                options[name] = getattr(state, name)
    more = f", {_arguments(**options)}" if options else ""
    return f"{maker}(rotor, {state.spin_speed!r}{more})"


def python_snippet(state: State) -> str:
    """Return a program that reproduces the view's arrays.

    It defines `whirl`, `bolotin`, `stability`, `campbell`, `critical` and `tongues`.
    """
    rotor = state.rotor()
    rows, columns, _ = PIXELS[state.model, True]
    options = _arguments(**map_options(model_of(state), settled=True))
    damped = bool(state.external_damping or state.internal_damping)
    maker = "lumped" if state.model == "lumped" else "finite_element, lumped"
    reference = (
        "float(critical_load(rotor.shear))"
        if state.reference == "buckling"
        else "flutter_load(lumped(rotor, 0.0, tangency=1.0))"
    )
    plain = f"undamped = {_system(state, False)}  # Bolotin's method knows no damping\n"
    linear = "undamped" if damped else "system"
    fields = _arguments(
        shear=rotor.shear,
        disk_mass=rotor.disk_mass,
        diametral_inertia=rotor.diametral_inertia,
        polar_inertia=rotor.polar_inertia,
        slenderness=rotor.slenderness,
    )
    return f"""\
# What rotorstab shows, as Python. Non-dimensional: L = EI = ρA = 1.
import numpy as np

from rotorstab import ShaftDisk, {maker}
from rotorstab import bolotin_chart, campbell_diagram, critical_load, critical_speeds, flutter_load
from rotorstab import fundamental_frequency, resonances, stability_chart, whirl_frequencies

rotor = ShaftDisk({fields})
system = {_system(state, damped)}
{plain if damped else ""}\
reference_load = {reference}  # what a load factor of 1 stands for
static_load = {state.static_load_factor!r} * reference_load
frequency = fundamental_frequency(lumped(rotor, 0.0))  # ω_n

# whirl frequencies at the static load, and over spin speed
whirl = whirl_frequencies(system, static_load)
campbell = campbell_diagram(system, np.linspace(0.0, {LARGEST_SPEED!r}, {SPEEDS}), static_load)
critical = critical_speeds(system, static_load)

# Bolotin's boundaries: bolotin.frequency / frequency over bolotin.pulsating_load / reference_load
largest_load = {state.largest_factor!r} * reference_load
bolotin = bolotin_chart({linear}, static_load, largest_load, {BOUNDARY_ROWS})

# Floquet's growth rates on the chart's pixels, and the true tongues at a load factor of 0.1
low, high = {state.lowest_frequency!r} * frequency, {state.highest_frequency!r} * frequency
loads = (np.arange({rows}) + 0.5) / {rows} * largest_load
frequencies = low + (np.arange({columns}) + 0.5) / {columns} * (high - low)
stability = stability_chart(system, static_load, loads, frequencies, {options})
tongues = resonances(system, static_load, 0.1 * reference_load).tongues

print("whirl frequencies:", whirl)
print("unstable share of the window:", (stability.growth > stability.error).mean())
for tongue in tongues:
    print(tongue.name, "at θ/ωₙ =", tongue.centre / frequency)
"""
