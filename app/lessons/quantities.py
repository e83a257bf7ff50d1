"""The quantities that a question may ask for, by name; each follows from the page's inputs alone.

A new quantity is one more entry of `QUANTITIES`.
"""

from __future__ import annotations

import math

import numpy as np

from rotorstab import in_bolotin_region

from ..results.curves import flutter, rotor_numbers
from ..results.growth import Motion, motion_of
from .quantity import Quantity
from .situation import Situation

__all__ = ["QUANTITIES", "find"]


def _speed(at: Situation, way: str, number: str = "1") -> float:
    speeds = at.speeds.forward if way == "forward" else at.speeds.backward
    index = int(number) - 1
    return float(speeds[index]) if index < len(speeds) else math.nan


def _threshold(at: Situation) -> float:
    return min(row.threshold for row in at.table) / at.reference


QUANTITIES = (
    Quantity(
        "whirl.<mode>",
        "whirl {0}, ω̄",
        "signed whirl frequency of a mode at the static load (forward above 0), real part",
        lambda at, mode: at.whirl(mode).real,
    ),
    Quantity(
        "whirl.<mode>.growth",
        "growth of whirl {0}",
        "its growth rate without pulsation: below 0 it dies out",
        lambda at, mode: -at.whirl(mode).imag,
    ),
    Quantity(
        "fundamental",
        "ω_n at rest",
        "first natural frequency ω_n of the resting, unloaded rotor",
        lambda at: at.fundamental,
    ),
    Quantity(
        "buckling",
        "buckling load p̄_cr",
        "static buckling load p̄_cr",
        lambda at: rotor_numbers(at.rotor).buckling_load,
    ),
    Quantity(
        "flutter",
        "flutter load p̄_f",
        "load at which the rotor flutters under a follower load, at its spin speed, lumped model",
        lambda at: flutter(at.rotor, at.spin),
    ),
    Quantity("static_load", "static load p̄_0", "the static load p̄₀", lambda at: at.static),
    Quantity(
        "critical.<way>",
        "first critical speed, {0}",
        "lowest spin speed with a synchronous whirl, forward (ω = Ω̄) or backward (ω = −Ω̄)",
        _speed,
    ),
    Quantity(
        "critical.<way>.<n>",
        "critical speed {1}, {0}",
        "the n-th critical speed, counted from the lowest",
        _speed,
    ),
    Quantity(
        "critical.<way>.count",
        "how many critical speeds, {0}",
        "number of critical speeds",
        lambda at, way: float(len(getattr(at.speeds, way))),
    ),
    Quantity(
        "tongue.<pair>.centre",
        "tongue {0}, centre θ/ω_n",
        "where the tongue of a pair of modes stands, θ/ωₙ, to first order in the pulsation",
        lambda at, pair: at.pair(pair).centre / at.fundamental,
    ),
    Quantity(
        "tongue.<pair>.width",
        "tongue {0}, width in θ/ω_n",
        "its whole width in θ/ωₙ at β_d of the marked point; 0 where there is none",
        lambda at, pair: 2 * at.pair(pair).half_width / at.fundamental,
        at_factor=True,
    ),
    Quantity(
        "tongue.<pair>.frequency",
        "tongue {0}, centre θ̄",
        "its centre as θ̄, in units of √(EI/ρAL⁴) and not of ωₙ",
        lambda at, pair: at.pair(pair).centre,
    ),
    Quantity(
        "tongue.<pair>.slope",
        "tongue {0}, width per unit of load",
        "its width in θ̄ for each unit of pulsating load p̄_t, undamped part",
        lambda at, pair: 4 * at.pair(pair).growth_per_load,
    ),
    Quantity(
        "tongue.<pair>.growth",
        "tongue {0}, growth rate",
        "growth rate at its centre at β_d of the marked point",
        lambda at, pair: at.pair(pair).growth,
        at_factor=True,
    ),
    Quantity(
        "tongue.<pair>.threshold",
        "tongue {0}, threshold β_d",
        "β_d from which it is unstable: 0 without damping",
        lambda at, pair: at.pair(pair).threshold / at.reference,
    ),
    Quantity(
        "tongue.<pair>.exists",
        "tongue {0} is there",
        "1 where this pair resonates at β_d of the marked point, else 0",
        lambda at, pair: float(at.pair(pair).unstable),
        flag=True,
        at_factor=True,
    ),
    Quantity(
        "tongues",
        "tongues in all",
        "how many pairs of modes resonate at β_d of the marked point",
        lambda at: float(len(at.table.tongues)),
        at_factor=True,
    ),
    Quantity(
        "threshold",
        "threshold β_d",
        "the smallest β_d that destabilises, by the resonance table",
        _threshold,
    ),
    Quantity(
        "bolotin.<mode>",
        "Bolotin boundary {0}, θ/ω_n",
        "Bolotin's boundary of a mode at β_d of the marked point, θ/ωₙ",
        lambda at, mode: at.boundary(mode) / at.fundamental,
        at_factor=True,
    ),
    Quantity(
        "bolotin.inside",
        "marked point in a Bolotin region",
        "1 where the marked point lies in a Bolotin region, else 0",
        lambda at: float(
            in_bolotin_region(at.operation.undamped, at.static, at.pulsating, at.frequency)
        ),
        True,
    ),
    Quantity(
        "growth",
        "growth rate σ̄ at the marked point",
        "growth rate at the marked point, by Floquet's method",
        lambda at: float(at.floquet.growth_rate),
    ),
    Quantity(
        "unstable",
        "unstable at the marked point",
        "1 where the rotor is unstable at the marked point, by Floquet's method, else 0",
        lambda at: float(motion_of(at.floquet) is Motion.GROWS),
        True,
    ),
    Quantity(
        "multiplier.largest",
        "largest multiplier |μ|",
        "the largest modulus of a Floquet multiplier at the marked point",
        lambda at: float(np.abs(at.floquet.multipliers).max()),
    ),
    Quantity(
        "multiplier.to_minus_one",
        "distance of a multiplier from −1",
        "distance of the nearest Floquet multiplier from −1 at the marked point",
        lambda at: float(np.abs(at.floquet.multipliers + 1).min()),
    ),
    Quantity(
        "spin_limit",
        "spin speed Ω̄ where the whirl grows",
        "lowest spin speed at which a whirl grows without pulsation",
        lambda at: at.spin_limit(),
    ),
    Quantity(
        "parameter.<name>",
        "{0}",
        "a parameter of the page, as it is set",
        lambda at, name: float(at.inputs[name]),
    ),
)


def find(name: str) -> tuple[Quantity, tuple[str, ...]] | None:
    """Return the quantity of a name and the name's parts, None where there is none."""
    for quantity in QUANTITIES:
        if match := quantity.pattern.fullmatch(name):
            return quantity, match.groups()
    return None
