"""Values of the same model from separate codes, made before this library."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from ..._types import Array
from ...bolotin.boundaries import boundary_frequencies
from ...floquet.resonance import resonances
from ...model.finite_element import finite_element
from ...model.lumped import lumped
from ...rotors.shaft_disk import BASE_CASE
from ...whirl.critical_loads import critical_load, flutter_load
from ...whirl.frequencies import whirl_frequencies
from ..arguments import resting_frequency
from .structure import Published, item
from .table_1 import table_1_whirl

__all__ = ["separate"]

DERIVED = "Separate calculations of the same model"


def _whirl(spin: float, tangency: float, load: float, root: int) -> float:
    return float(whirl_frequencies(lumped(BASE_CASE, spin, tangency), load)[root].real)


def _boundary(spin: float, static: float, pulsating: float, root: int) -> float:
    """Return θ/ω_n of a Bolotin boundary of the base case under axial load."""
    buckling = critical_load(BASE_CASE.shear)
    boundaries: Array = boundary_frequencies(
        lumped(BASE_CASE, spin), static * buckling, pulsating * buckling
    )
    return float(boundaries[root] / resting_frequency(BASE_CASE))


def _tongue(spin: float, tangency: float, name: str, which: int) -> float:
    """Return a tongue's centre over ω_n, or its peak growth per β_d, at α_s = 0.5."""
    buckling = float(critical_load(BASE_CASE.shear))
    row = resonances(lumped(BASE_CASE, spin, tangency), 0.5 * buckling, buckling)[name]
    scale = resting_frequency(BASE_CASE)
    return (row.centre / scale, row.growth_per_load * buckling)[which]


def separate() -> list[Published]:
    """Return whirl, boundary, tongue and flutter values of the base case and of Table 1."""
    return [*_base_whirls(), *_boundaries(), *_table_1_whirls(), *_tongues(), *_flutter_loads()]


def _base_whirls() -> list[Published]:
    cases: list[tuple[float, float, float, tuple[str, ...]]] = [
        (0.0, 0.0, 0.0, ("-2.41457", "-0.64669", "0.64669", "2.41457")),
        (1.0, 0.0, 0.0, ("-1.93485", "-0.40411", "0.90922", "3.42974")),
        (2.0, 0.0, 0.0, ("-1.73338", "-0.26610", "1.07302", "4.92646")),
        (2.0, 0.0, 0.5, ("-1.66431", "-0.15786", "0.92652", "4.89565")),
        (2.0, 1.0, 0.5, ("-1.60497", "-0.31956", "1.03969", "4.88484")),
    ]
    names = ("2B", "1B", "1F", "2F")
    buckling = float(critical_load(BASE_CASE.shear))
    return [
        item(
            DERIVED,
            f"ω̄ of {names[root]}, Ω̄ = {spin:g}, α_s = {factor:g}"
            + (", follower" if tangency else ""),
            "-",
            printed,
            "separate solution of the quartic",
            partial(_whirl, spin, tangency, factor * buckling, root),
        )
        for spin, tangency, factor, row in cases
        for root, printed in enumerate(row)
    ]


def _boundaries() -> list[Published]:
    cases: list[tuple[float, float, float, tuple[str, ...]]] = [
        (0.0, 0.0, 0.5, ("1.73774", "2.23094")),
        (0.0, 0.0, 1.0, ("1.42699", "2.43947")),
        (0.0, 0.5, 0.5, ("1.02453", "1.73774")),
        (2.0, 0.5, 0.0, ("0.48821", "2.86540")),
        (2.0, 0.5, 0.5, ("0.42637", "2.86513")),
    ]
    return [
        item(
            DERIVED,
            f"θ/ω_n of boundary {root + 1}, Ω̄ = {spin:g}, α_s = {static:g}, β_d = {pulsating:g}",
            "-",
            printed,
            "separate solution of Eq. (24)",
            partial(_boundary, spin, static, pulsating, root),
        )
        for spin, static, pulsating, row in cases
        for root, printed in enumerate(row)
    ]


def _table_1_whirls() -> list[Published]:
    cases: list[tuple[str, float, float, str, str]] = [
        ("lumped", 0, 0.0, "2F", "1019.46"),
        ("fe", 0, 0.0, "1F", "146.811"),
        ("fe", 0, 0.0, "2F", "879.68"),
        ("lumped", 0, 0.5, "1F", "113.452"),
        ("lumped", 0, 0.5, "2F", "999.53"),
        ("fe", 0, 0.5, "1F", "104.176"),
        ("fe", 0, 0.5, "2F", "858.00"),
        ("fe", 1000, 0.0, "1B", "139.557"),
        ("fe", 1000, 0.0, "1F", "153.971"),
        ("fe", 1000, 0.0, "2B", "806.003"),
        ("fe", 1000, 0.0, "2F", "962.180"),
    ]
    words = {"lumped": "lumped", "fe": "finite elements"}
    return [
        item(
            DERIVED,
            f"Table 1's rotor, {mode}, {rpm:g} r.p.m., α_s = {factor:g}, {words[model]}",
            "rad/s",
            printed,
            "separate code of the same model",
            partial(table_1_whirl, model, rpm, factor, mode),
        )
        for model, rpm, factor, mode, printed in cases
    ]


def _tongues() -> list[Published]:
    cases: list[tuple[float, float, str, tuple[str, str]]] = [
        (1.0, 0.0, "1B+1F", ("1.5347", "0.18482")),
        (1.0, 0.0, "2B+1F", ("4.0422", "0.06944")),
        (1.0, 0.0, "2B+2F", ("8.1423", "0.03991")),
        (1.0, 0.0, "1B+2F", ("5.6348", "0.00613")),
        (2.0, 1.0, "1B+2B", ("1.9877", "0.10322")),
        (2.0, 1.0, "2B+1F", ("4.0895", "0.05647")),
        (2.0, 1.0, "2B+2F", ("10.0354", "0.07071")),
        (2.0, 1.0, "1F+2F", ("5.9459", "0.02536")),
    ]
    quantities = ("θ/ω_n", "growth over β_d")
    return [
        item(
            DERIVED,
            f"{quantities[which]} of tongue {name}, {'follower' if tangency else 'axial'}, "
            f"Ω̄ = {spin:g}, α_s = 0.5",
            "-",
            printed,
            "separate code, checked by Floquet",
            partial(_tongue, spin, tangency, name, which),
        )
        for spin, tangency, name, row in cases
        for which, printed in enumerate(row)
    ]


def _flutter_loads() -> list[Published]:
    cases: list[tuple[str, str, str, Callable[[], float]]] = [
        (
            "linear coefficients",
            "6.29010",
            "separate code, merging roots",
            lambda: flutter_load(lumped(BASE_CASE, 0.0, 1.0)),
        ),
        (
            "exact coefficients",
            "5.97797",
            "separate code, merging roots",
            lambda: flutter_load(lumped(BASE_CASE, 0.0, 1.0, stiffness="exact")),
        ),
        (
            "distributed shaft",
            "6.0268",
            "mesh limit of a separate code",
            lambda: flutter_load(finite_element(BASE_CASE, 0.0, 1.0, 80, 10), 8.0),
        ),
    ]
    return [
        item(DERIVED, f"flutter load at rest, {model}", "EI/L²", printed, source, ours)
        for model, printed, source, ours in cases
    ]
