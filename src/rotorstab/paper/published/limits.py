"""Limits with exact answers: follower columns, rotating damping, and Mathieu's equation."""

from __future__ import annotations

from functools import partial

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from ..._numerics.extrapolation import extrapolation_weights
from ...floquet.point import floquet_multipliers
from ...maps.margin import critical_pulsation
from ...model.finite_element import finite_element
from ...model.stiffness import exact_stiffness
from ...model.system import System
from ...rotors.shaft_disk import ShaftDisk
from ...whirl.critical_loads import flutter_load
from ...whirl.frequencies import whirl_frequencies
from .structure import Published, item

__all__ = ["limits"]

LIMITS = "Exact limits"
_COLUMN = ShaftDisk(0.0, 0.0, 0.0, 0.0, 0.0)
_Q = 25.0
_EXTERNAL, _INTERNAL = 0.02, 0.008


def one_mass(elastic: float, geometric: float, external: float, internal: float) -> System:
    """Return q̈ + 2(ζ_e + ζ_i)q̇ + (k + p b − 2jΩζ_i)q = 0, without a gyroscopic moment."""
    return System(
        mass=np.ones((1, 1)),
        gyroscopic=np.zeros((1, 1)),
        external_damping=np.full((1, 1), 2 * external),
        internal_damping=np.full((1, 1), 2 * internal),
        elastic=np.full((1, 1), elastic),
        geometric=np.full((1, 1), geometric),
        spin_speed=np.array(0.0),
    )


def _determinant(load: float, tangency: float) -> float:
    return float(np.linalg.det(exact_stiffness(load, 0.0, tangency)))


def _divergence(tangency: float) -> float:
    """Return the first load at which the column has a second position of rest."""
    if tangency == 0.5:  # the determinant only touches 0
        found = minimize_scalar(
            _determinant, bounds=(8.0, 12.0), args=(tangency,), options={"xatol": 1e-10}
        )
        return float(found.x)
    return float(brentq(_determinant, 1.0, 9.5, args=(tangency,), xtol=1e-12))


def _partly_follower_flutter() -> float:
    return flutter_load(finite_element(_COLUMN, 0.0, tangency=0.5, elements=24))


def _damped_beck() -> float:
    """Return Beck's load with an external damping so large that inertia no longer counts."""

    def on_mesh(elements: int) -> float:
        system = finite_element(_COLUMN, 0.0, 1.0, elements, external_damping=1e4)

        def growth(load: float) -> float:
            return -float(whirl_frequencies(system, load).imag.min())

        return float(brentq(growth, 30.0, 39.0, xtol=1e-9))

    loads = np.array([on_mesh(12), on_mesh(24)])
    return float(extrapolation_weights((12, 24), order=4) @ loads)


def _threshold_of_rotating_damping() -> float:
    rotor = one_mass(1.0, 1.0, _EXTERNAL, _INTERNAL)

    def growth(speed: float) -> float:
        return float(whirl_frequencies(rotor.at_speed(speed), 0.0).imag.min())

    return float(brentq(growth, 1.0, 9.0, xtol=1e-12))


def _characteristic_value(sign: float, low: float, high: float) -> float:
    """Return a of q̈ + (a − 2·25 cos 2t)q = 0 between two others, where both multipliers are ±1."""

    def beyond(value: float) -> float:
        equation = one_mass(value, -1.0, 0.0, 0.0)
        return float(floquet_multipliers(equation, 0.0, 2 * _Q, 2.0).sum().real) - 2 * sign

    return float(brentq(beyond, low, high, xtol=1e-12))


def _damped_threshold(ratio: float, frequency: float) -> float:
    equation = one_mass(1.0, 1.0, ratio, 0.0)
    return float(critical_pulsation(equation, 0.0, [frequency], 1.5).pulsating_load[0])


def limits() -> list[Published]:
    """Return values that an exact solution gives."""
    divergence = [(0.25, "3.6505194"), (0.4, "5.2924106"), (0.5, "9.8696044")]
    mathieu = [("b₅", -1, 27.9, 28.1, "28.062765899"), ("a₈", 1, 69.3, 69.7, "69.524065166")]
    damped = [
        (0.05, 2.0, "0.2001093421"),
        (0.05, 1.95, "0.2201539336"),
        (0.05, 1.0, "0.7436639456"),
        (0.1, 2.0, "0.4008739526"),
    ]
    return [
        *(
            item(
                LIMITS,
                f"column under a partly follower load, divergence, μ = {tangency:g}",
                "EI/L²",
                printed,
                "cos √p = −μ/(1 − μ)",
                partial(_divergence, tangency),
                1e-5 if tangency == 0.5 else None,
            )
            for tangency, printed in divergence
        ),
        item(
            LIMITS,
            "column under a partly follower load, flutter, μ = 0.5",
            "EI/L²",
            "16.0525",
            "exact determinant",
            _partly_follower_flutter,
        ),
        item(
            LIMITS,
            "Beck's column with large external damping",
            "EI/L²",
            "37.6954",
            "v⁗ + pv″ = λv, Re λ = 0, by its determinant",
            _damped_beck,
        ),
        item(
            LIMITS,
            "rotating damping, threshold of Ω/ω_n, ζ_e = 0.02, ζ_i = 0.008",
            "-",
            "3.5",
            "1 + ζ_e/ζ_i",
            _threshold_of_rotating_damping,
            1e-9,
        ),
        *(
            item(
                LIMITS,
                f"Mathieu's equation, characteristic value {name} at q = 25",
                "-",
                printed,
                "NIST Digital Library of Mathematical Functions, 28.1",
                partial(_characteristic_value, float(sign), low, high),
            )
            for name, sign, low, high, printed in mathieu
        ),
        *(
            item(
                LIMITS,
                f"damped Mathieu equation, smallest ε, ζ = {ratio:g}, θ = {frequency:g}",
                "-",
                printed,
                "separate code, Hill's determinant",
                partial(_damped_threshold, ratio, frequency),
            )
            for ratio, frequency, printed in damped
        ),
    ]
