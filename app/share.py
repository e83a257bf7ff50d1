"""The address: every input of the state as a short query, and back with all doubt named.

Nothing that stands in an address is trusted. What is missing keeps its default; what is
unknown, repeated, too long, not a number or out of range is named and left out.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any
from urllib.parse import urlencode

import param

from .state import State

__all__ = ["VERSION", "describe_problems", "from_arguments", "to_query"]

VERSION = 1
_KEYS = {
    "load_type": "load",
    "tangency": "mu",
    "static_load_factor": "as",
    "spin_speed": "spin",
    "shear": "phi",
    "disk_mass": "md",
    "diametral_inertia": "id",
    "polar_inertia": "ip",
    "reference": "ref",
    "largest_factor": "bmax",
    "lowest_frequency": "fmin",
    "highest_frequency": "fmax",
    "stiffness": "stiff",
    "external_damping": "ze",
    "internal_damping": "zi",
    "law": "law",
    "model": "model",
    "show_growth": "growth",
    "show_bolotin": "bolotin",
    "show_disagreement": "differ",
    "growth_unit": "unit",
    "marker": "at",
    "marker_frequency": "f",
    "marker_factor": "b",
    "initial": "ic",
    "seed": "seed",
    "periods": "n",
    "units": "u",
    "shaft_length": "len",
    "shaft_diameter": "dia",
    "material": "mat",
    "youngs_modulus": "e",
    "shear_modulus": "g",
    "density": "rho",
    "shear_coefficient": "kappa",
    "si_disk_mass": "simd",
    "si_diametral_inertia": "siid",
    "si_polar_inertia": "siip",
}
_NAMES = {key: name for name, key in _KEYS.items()}
_LONGEST = 40  # characters of one value; the longest honest one has 18
_MOST_NAMED = 8


def to_query(inputs: Mapping[str, Any]) -> str:
    """Return every input as a query without its question mark, version first."""
    pairs = [("v", str(VERSION))]
    for name, key in _KEYS.items():
        value = inputs[name]
        if isinstance(value, bool):
            text = "1" if value else "0"
        elif isinstance(value, float):
            text = f"{value:.10g}"
        else:
            text = value
        pairs.append((key, text))
    return urlencode(pairs)


def _value(name: str, text: str) -> Any:
    """Return what a text means for an input; the text itself where it means nothing."""
    parameter = State.param[name]
    if isinstance(parameter, param.Boolean):
        return {"0": False, "1": True}.get(text, text)
    if isinstance(parameter, param.Number):
        try:
            return float(text)
        except ValueError:
            return text
    return text


def from_arguments(
    arguments: Mapping[str, Sequence[bytes | str]],
) -> tuple[dict[str, Any], list[str]]:
    """Return the values of an address by input name, and the keys that were not understood.

    Ranges are not checked here: `State.change` does that.
    """
    values: dict[str, Any] = {}
    doubtful: list[str] = []
    for key, given in arguments.items():
        texts = [
            one.decode("utf-8", "replace") if isinstance(one, bytes) else str(one) for one in given
        ]
        if key == "v":
            if texts != [str(VERSION)]:
                doubtful.append("v")
        elif key not in _NAMES or len(texts) != 1 or len(texts[0]) > _LONGEST:
            doubtful.append(str(key)[:20])
        else:
            values[_NAMES[key]] = _value(_NAMES[key], texts[0])
    return values, doubtful


def describe_problems(doubtful: Sequence[str], refused: Mapping[str, str]) -> str:
    """Return one sentence that names what an address held in vain, or nothing."""
    named = [*doubtful, *(f"{_KEYS.get(name, name)} ({why})" for name, why in refused.items())]
    if not named:
        return ""
    more = f" and {len(named) - _MOST_NAMED} more" if len(named) > _MOST_NAMED else ""
    return f"Ignored in the address: {', '.join(named[:_MOST_NAMED])}{more}."
