"""Reads and writes rotor files: TOML whose quantities have units.

A file is either an SI rotor, tables [shaft] and [disk], or plain numbers, [nondimensional],
to which a [shaft] may give the scales. [operation] may add the spin speed and the load.
Every error is one line of text with the line of the file, the key, what is allowed and the value.
"""

from __future__ import annotations

from typing import Any

from ..reading.user_error import UserError
from .inputs import SI_INPUTS, SYMBOLS
from .rates import rpm
from .rotor_tables import KEYS, RotorTables
from .state import State

__all__ = ["LARGEST_FILE", "read_rotor_file", "write_rotor_file"]

LARGEST_FILE = 8_000
"""Largest size of a rotor file in bytes; a usual one has some hundred."""


def read_rotor_file(text: str) -> tuple[dict[str, Any], list[str]]:
    """Return the inputs that a rotor file sets, and what of its [operation] is out of range.

    A rotor with an error is refused as a whole. A value of [operation] that the dashboard cannot
    show, such as a speed beyond the slider's range, is left out and named.

    Returns
    -------
    inputs : dict
        By the state's names; all of them are in range.
    left_out : list of str
        One line for the user each.

    Raises
    ------
    UserError
        With one line for the user.
    """
    if len(text.encode("utf-8", "surrogatepass")) > LARGEST_FILE:
        raise UserError(f"the file is larger than {LARGEST_FILE // 1000} kB")
    reader = RotorTables(text)
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
    quantity = f"{value:.5g} {unit}".strip()
    if name in SI_INPUTS:
        return f"{problem} {unit}".strip() + f"; {quantity} is not"
    return f"gives {SYMBOLS[name]} = {quantity}, which {problem}"


def write_rotor_file(state: State) -> str:
    """Return the rotor file of the present inputs; reading it gives the same inputs."""
    lines = ["# A rotor, written by rotorstab."]
    if state.units == "SI":
        lines += ["", *_shaft_lines(state)]
    if state.units == "SI" and state.shaft_in_use():
        lines += ["", "[disk]", f'mass = "{state.si_disk_mass!r} kg"']
        lines.append(f'diametral_inertia = "{state.si_diametral_inertia!r} kg m^2"')
        lines.append(f'polar_inertia = "{state.si_polar_inertia!r} kg m^2"')
        turns = state.spin_speed * rpm(state.scales())
        speed = f'"{turns:.12g} rpm"'
    else:
        lines += ["", "[nondimensional]"]
        lines += [f"{key} = {getattr(state, key)!r}" for key in KEYS["nondimensional"]]
        speed = repr(state.spin_speed)
    lines += ["", "[operation]", f"spin_speed = {speed}", f'load_type = "{state.load_type}"']
    if state.load_type == "partly":
        lines.append(f"tangency = {state.tangency!r}")
    lines.append(f"static_load_factor = {state.static_load_factor!r}")
    return "\n".join(lines) + "\n"


def _shaft_lines(state: State) -> list[str]:
    lines = ["[shaft]", f'length = "{state.shaft_length!r} m"']
    lines.append(f'diameter = "{state.shaft_diameter!r} mm"')
    if state.material != "own":
        return [*lines, f'material = "{state.material}"']
    lines.append(f'youngs_modulus = "{state.youngs_modulus!r} GPa"')
    lines.append(f'shear_modulus = "{state.shear_modulus!r} GPa"')
    lines.append(f'density = "{state.density!r} kg/m^3"')
    lines.append(f"shear_coefficient = {state.shear_coefficient!r}")
    return lines
