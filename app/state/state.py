"""The state of the dashboard: bounded, finite, free of Panel.

Every value, be it from a slider, a number box, an address or a forged message, is set by
`State.change`, which refuses a value out of range with the reason, and sets the others.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from contextlib import suppress
from typing import Any

import numpy as np
import param

from rotorstab import BASE_CASE, EULER_BERNOULLI_TWIN, TABLE_1_SI, Scales, ShaftDisk
from rotorstab.rotors.materials import MATERIALS

from ..reading.user_error import UserError
from .declaration import Use
from .inputs import NAMES, SI_INPUTS, Inputs, names_for
from .rates import rpm

__all__ = ["PRESETS", "State"]

_TABLE_1, _TABLE_1_SCALES = ShaftDisk.from_si(**TABLE_1_SI)
_THOUSAND_RPM = 1000 / rpm(_TABLE_1_SCALES)
_SHORTEST_RANGE = 0.4  # of θ/ωₙ
_ROUNDING = 1e-9  # by which a range may be shorter: 0.6 − 0.2 is less than 0.4


class State(Inputs):
    """Every input of the dashboard, and the rules by which they change."""

    def inputs(self) -> dict[str, Any]:
        """Return every input by name."""
        return {name: getattr(self, name) for name in NAMES}

    def effective_tangency(self) -> float:
        """Return μ of the chosen load type."""
        return {"axial": 0.0, "follower": 1.0}.get(self.load_type, float(self.tangency))

    def reset(self) -> None:
        """Return every input to its default."""
        self.param.update(**{name: State.param[name].default for name in NAMES})

    def rotor(self) -> ShaftDisk:
        """Return the rotor of the present inputs; only finite elements use its slenderness."""
        # r of the base case in proportion to √Φ, as for a solid shaft of one material
        slenderness = BASE_CASE.slenderness * math.sqrt(self.shear / BASE_CASE.shear)
        with suppress(UserError):
            shaft = self.si_rotor()[0]
            if math.isclose(shaft.shear, self.shear):
                slenderness = shaft.slenderness
        return ShaftDisk(
            shear=self.shear,
            disk_mass=self.disk_mass,
            diametral_inertia=self.diametral_inertia,
            polar_inertia=self.polar_inertia,
            slenderness=slenderness,
        )

    def si_data(self) -> dict[str, float]:
        """Return the shaft and the disk in SI, as arguments of `ShaftDisk.from_si`."""
        known = MATERIALS.get(self.material)
        return {
            "length": self.shaft_length,
            "diameter": self.shaft_diameter / 1e3,
            "youngs_modulus": known.youngs_modulus if known else self.youngs_modulus * 1e9,
            "shear_modulus": known.shear_modulus if known else self.shear_modulus * 1e9,
            "density": known.density if known else self.density,
            "shear_coefficient": known.shear_coefficient if known else self.shear_coefficient,
            "disk_mass": self.si_disk_mass,
            "diametral_inertia": self.si_diametral_inertia,
            "polar_inertia": self.si_polar_inertia,
        }

    def si_rotor(self) -> tuple[ShaftDisk, Scales]:
        """Return the rotor of the SI data, and the scales of its shaft.

        Raises
        ------
        UserError
            If the shaft is too thick for its length.
        """
        try:
            return ShaftDisk.from_si(**self.si_data())
        except ValueError:
            raise UserError("this shaft is too thick for its length") from None

    def scales(self) -> Scales:
        """Return one unit of each quantity of the charts in SI."""
        return self.si_rotor()[1]

    def shaft_in_use(self) -> bool:
        """Whether Φ, M̄_D, Ī_D and Ī_P are those of the SI data."""
        try:
            rotor = _rotor_values(self.si_rotor()[0])
        except UserError:
            return False
        return all(math.isclose(value, getattr(self, name)) for name, value in rotor.items())

    def use_shaft(self) -> dict[str, str]:
        """Set Φ, M̄_D, Ī_D and Ī_P from the SI data: all of them or, out of range, none."""
        try:
            values = _rotor_values(self.si_rotor()[0])
        except UserError as error:
            return {"shaft_diameter": str(error)}
        problems = {name: _problem(name, value) for name, value in values.items()}
        errors = {
            name: f"of this shaft is {values[name]:.4g}: it {problem}"
            for name, problem in problems.items()
            if problem
        }
        return errors or self.change(values)

    def change(self, values: Mapping[str, Any]) -> dict[str, str]:
        """Set what is valid, refuse the rest; return a message for each refused name.

        A value takes effect only if it is a finite number in its range or one of the
        choices (bool is not a number); names that do not exist are refused too.
        """
        errors: dict[str, str] = {}
        good: dict[str, Any] = {}
        for name, value in values.items():
            problem = _problem(name, value)
            if problem:
                errors[_short(name)] = problem
            else:
                good[name] = _plain(name, value)
        low = good.get("lowest_frequency", self.lowest_frequency)
        high = good.get("highest_frequency", self.highest_frequency)
        if high - low < _SHORTEST_RANGE - _ROUNDING:
            for name, rule in (
                ("lowest_frequency", "be below the highest"),
                ("highest_frequency", "exceed the lowest"),
            ):
                if good.pop(name, None) is not None:
                    errors[name] = f"must {rule} by {_SHORTEST_RANGE:g} or more"
        if "tangency" in good:
            # whoever moves this slider wants a partly follower load
            good.setdefault("load_type", "partly")
        if "marker_frequency" in good or "marker_factor" in good:
            # whoever moves the marker wants it to stay there
            good.setdefault("marker_follows", False)
        if any(name in good for name in names_for(Use.MATERIAL)):
            good.setdefault("material", "own")
        self.param.update(**good)
        return errors

    def apply_preset(self, name: Any) -> dict[str, str]:
        """Set the parameters of a named preset."""
        if not isinstance(name, str) or name not in PRESETS:
            return {"preset": f"no preset named {_short(name)!r}"}
        return self.change(PRESETS[name])


def _short(name: Any) -> str:
    """Return a foreign name, shortened; str() of an integer of 5000 digits would fail."""
    return name[:40] if isinstance(name, str) else type(name).__name__


def _plain(name: str, value: Any) -> Any:
    """Return a valid value as Python's bool, float or str."""
    parameter = State.param[name]
    if isinstance(parameter, param.Boolean):
        return bool(value)
    if isinstance(parameter, param.Selector):
        return value
    return float(value)


def _problem(name: Any, value: Any) -> str:
    """Return what is wrong with a value, or an empty text."""
    if not isinstance(name, str) or name not in NAMES:
        return "unknown parameter"
    parameter = State.param[name]
    if isinstance(parameter, param.Boolean):
        return "" if isinstance(value, bool | np.bool_) else "must be on or off"
    if isinstance(parameter, param.Selector):
        if isinstance(value, str) and value in parameter.objects:
            return ""
        return "must be one of " + ", ".join(parameter.objects)
    low, high = parameter.bounds
    allowed = f"must be a number from {low:g} to {high:g}"
    if isinstance(value, bool) or not isinstance(value, int | float | np.integer | np.floating):
        return allowed
    # the comparison is exact for integers of any length and false for nan
    return "" if low <= value <= high else allowed


def _rotor_values(rotor: ShaftDisk, **others: Any) -> dict[str, Any]:
    """Return the inputs of a rotor, and other ones."""
    return {
        "shear": rotor.shear,
        "disk_mass": rotor.disk_mass,
        "diametral_inertia": rotor.diametral_inertia,
        "polar_inertia": rotor.polar_inertia,
        **others,
    }


_START = {name: State.param[name].default for name in names_for(Use.PRESET)}

_TABLE_1_SHAFT = {name: State.param[name].default for name in SI_INPUTS}

PRESETS: dict[str, dict[str, Any]] = {
    "Base case": _rotor_values(BASE_CASE, **_START),
    "Euler–Bernoulli twin": _rotor_values(EULER_BERNOULLI_TWIN, **_START),
    "Table 1, at rest": _rotor_values(_TABLE_1, **(_START | _TABLE_1_SHAFT | {"spin_speed": 0.0})),
    "Table 1, 1000 rpm": _rotor_values(
        _TABLE_1, **(_START | _TABLE_1_SHAFT | {"spin_speed": _THOUSAND_RPM})
    ),
}
"""Named settings of the inputs; they leave the ranges of the charts as they are."""
