"""Curves and numbers of a rotor that do not depend on the growth map: cached, shared."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotorstab import (
    STIFFNESS_LAWS,
    ShaftDisk,
    System,
    WhirlCurves,
    campbell_diagram,
    critical_load,
    flutter_load,
    fundamental_frequency,
    grows_or_decays,
    load_frequency_curves,
    lumped,
    whirl_frequencies,
)
from rotorstab._tolerances import CURVES_SHORT_OF_POLE, FLUTTER_IN_VIEW
from rotorstab.model.stiffness import largest_exact_load
from rotorstab.model.stiffness_law import LINEAR
from rotorstab.whirl.mode_names import mode_names, named_frequencies

from ..reading.user_error import UserError
from ..state import State
from .caches import shared_cache
from .model import Model
from .sampling import samples, seen_part
from .views import View

__all__ = [
    "LARGEST_SPEED",
    "LOADS",
    "SPEEDS",
    "LoadCase",
    "RotorNumbers",
    "campbell",
    "curves_name",
    "flutter",
    "largest_load",
    "load_cases",
    "load_curves",
    "marked_loads",
    "reference_load",
    "rotor_numbers",
    "whirl_numbers",
]

Floats = NDArray[np.float64]

LOADS = 400  # points of a load–frequency curve
SPEEDS = 200  # points of a Campbell diagram
LARGEST_SPEED = float(State.param.spin_speed.bounds[1])


class RotorNumbers(NamedTuple):
    """Numbers of a resting rotor, non-dimensional.

    Parameters
    ----------
    buckling_load : float
        p̄_cr.
    fundamental_frequency : float
        ω_n.
    flutter_load : float
        Of a follower load; inf where there is none.
    """

    buckling_load: float
    fundamental_frequency: float
    flutter_load: float


@shared_cache(256)
def rotor_numbers(rotor: ShaftDisk) -> RotorNumbers:
    """Return the numbers of a resting rotor."""
    buckling = float(critical_load(rotor.shear))
    return RotorNumbers(buckling, fundamental_frequency(lumped(rotor, 0.0)), flutter(rotor, 0.0))


def reference_load(rotor: ShaftDisk, reference: str) -> float:
    """Return the load [EI/L²] that load factors refer to, "buckling" or "flutter".

    Raises
    ------
    UserError
        Where the rotor has no flutter load.
    """
    numbers = rotor_numbers(rotor)
    if reference == "buckling":
        return numbers.buckling_load
    if not math.isfinite(numbers.flutter_load):
        pole = float(largest_exact_load(rotor.shear))
        raise UserError(
            f"This rotor has no flutter load below p̄ = {pole:.4g}, where a shaft clamped at both "
            "ends buckles and this model ends: let the load factors refer to static buckling."
        )
    return numbers.flutter_load


@shared_cache(256)
def flutter(rotor: ShaftDisk, spin_speed: float) -> float:
    """Return the follower flutter load [EI/L²] at a spin speed, lumped and linear.

    It is inf where there is none below the pole of the exact stiffness: there the shaft itself
    buckles, which the linear law does not know.
    """
    return flutter_load(lumped(rotor, spin_speed, 1.0), float(largest_exact_load(rotor.shear)))


def largest_load(rotor: ShaftDisk) -> float:
    """Return the largest load of the load–frequency curves, short of the pole."""
    return (1 - CURVES_SHORT_OF_POLE) * float(largest_exact_load(rotor.shear))


def _loads(rotor: ShaftDisk, spin_speed: float) -> np.ndarray:
    """Return the load axis: from tension to beyond buckling, and flutter if that is not too far."""
    buckling = rotor_numbers(rotor).buckling_load
    pole = float(largest_exact_load(rotor.shear))
    at = flutter(rotor, spin_speed)
    far = max(1.6 * buckling, 1.2 * at if at < (1 - FLUTTER_IN_VIEW) * pole else 0.0)
    step = 0.5
    low = -step * np.ceil(buckling / step)
    high = min(step * np.ceil(far / step), largest_load(rotor))
    return np.linspace(low, high, LOADS)


def curves_name(load: str, law: str) -> str:
    """Return the name of a set of load–frequency curves, which is also its key in `ROLES`."""
    return load if law == LINEAR else f"{load} {law}"


class LoadCase(NamedTuple):
    """Of which load and stiffness law a set of load–frequency curves is.

    Parameters
    ----------
    load_type : str
        "axial", "follower" or "partly".
    tangency : float
        μ of this load.
    law : str
        "linear" or "exact".
    """

    load_type: str
    tangency: float
    law: str

    @property
    def name(self) -> str:
        """The name of the curves, by which `ROLES` says how they are drawn."""
        return curves_name(self.load_type, self.law)


def load_cases(model: str, tangency: float, stiffness: str) -> list[LoadCase]:
    """Return the load and the law of each set of load–frequency curves.

    Parameters
    ----------
    model : str
        "lumped" or "finite elements".
    tangency : float
        μ of the load.
    stiffness : str
        "linear", "exact" or "both".
    """
    tangencies = {"axial": 0.0, "follower": 1.0}
    if tangency not in tangencies.values():
        tangencies["partly"] = tangency
    laws = tuple(STIFFNESS_LAWS) if stiffness == "both" else (stiffness,)
    if model != "lumped":
        laws = (LINEAR,)  # the distributed shaft has no other
    return [LoadCase(load_type, mu, law) for law in laws for load_type, mu in tangencies.items()]


def marked_loads(
    rotor: ShaftDisk, spin_speed: float, cases: Sequence[LoadCase]
) -> dict[str, float]:
    """Return the critical loads that the load–frequency chart marks, by name.

    Parameters
    ----------
    rotor : ShaftDisk
    spin_speed : float
        Ω̄.
    cases : sequence of LoadCase
        What the curves are of. The flutter load is that of the linear law, and its name says so
        where there are curves of another one.
    """
    has_other_law = any(case.law != LINEAR for case in cases)
    return {
        "buckling": rotor_numbers(rotor).buckling_load,
        f"flutter, {LINEAR}" if has_other_law else "flutter": flutter(rotor, spin_speed),
    }


@shared_cache(128)
def load_curves(
    model: Model, spin_speed: float, tangency: float, stiffness: str, seen: View | None = None
) -> dict[str, WhirlCurves]:
    """Return whirl over static load by the names of `load_cases`, of the part that is seen."""
    loads = _loads(model.rotor, spin_speed)
    if seen is not None:
        # no curve goes beyond this load, which moves with the rotor while a zoom stays
        seen = replace(seen, right=min(seen.right, largest_load(model.rotor)))
    found = {}
    for case in load_cases(model.kind, tangency, stiffness):
        system = model.system(spin_speed, case.tangency, case.law)
        found[case.name] = _followed(
            partial(load_frequency_curves, system), partial(whirl_frequencies, system), loads, seen
        )
    return found


@shared_cache(128)
def campbell(model: Model, tangency: float, load: float, seen: View | None = None) -> WhirlCurves:
    """Return whirl over spin speed at a static load [EI/L²], of the part that is seen."""
    speeds = np.linspace(0.0, LARGEST_SPEED, SPEEDS)
    system = model.system(0.0, tangency)
    return _followed(
        lambda speeds: campbell_diagram(system, speeds, load),
        lambda speeds: whirl_frequencies(system.at_speed(speeds), load),
        speeds,
        seen,
    )


def _followed(
    curves: Callable[[Floats], WhirlCurves],
    frequencies: Callable[[Floats], NDArray[np.complex128]],
    whole: Floats,
    seen: View | None,
) -> WhirlCurves:
    """Return curves over the whole axis, or those of the part that is seen.

    The modes of a part are followed and named over the whole axis, too.
    """
    if seen is None or seen.right <= seen.left:
        return curves(whole)
    found = curves(samples(lambda at: frequencies(at).real, whole, seen))
    part = seen_part(found.parameter, seen)
    return replace(found, parameter=found.parameter[part], frequencies=found.frequencies[part])


def whirl_numbers(system: System, load: float) -> dict[str, list[float]]:
    """Return the whirl frequencies by name, as [real, imaginary].

    The imaginary part is 0 where a whirl neither grows nor decays by more than rounding, so that
    a text or the page shows growth or decay wherever this part is not 0.
    """
    found = named_frequencies(system, load)
    imaginary = np.where(grows_or_decays(found), found.imag, 0.0)
    parts = np.stack([found.real, imaginary], axis=-1).tolist()
    return dict(zip(mode_names(system.size), parts, strict=True))
