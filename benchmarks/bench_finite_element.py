"""Finite elements: their time for Fig. 4, and the errors of reduced ones over the slider ranges.

The first tables time Fig. 4's boundaries by the lumped model, by finite elements and by reduced
ones in one run, and print ratios: absolute times depend on the machine. The paper discusses the
cost of its finite-element model with 80 × 80 matrices; 20 elements here are 40 complex degrees of
freedom, 80 × 80 in first-order form as well (160 × 160 for the boundaries, whose two load levels
K₋ and K₊ are coupled by the spin).

The other tables draw rotors at random from the ranges of the dashboard's sliders and compare the
reduced elements with all of them: whirl frequencies and growth rates.
"""

from __future__ import annotations

import math
import statistics
import time
from collections.abc import Callable

import numpy as np

from app.results.model import MODES
from rotorstab import (
    TABLE_1_SI,
    ShaftDisk,
    System,
    boundary_frequencies,
    critical_load,
    finite_element,
    fundamental_frequency,
    growth_rate,
    lumped,
    whirl_frequencies,
)

POINTS = 101
ACCURATE = 6  # coordinates against which growth is measured; all would take hours
GROWS = 1e-6  # growth of a whirl without pulsation, above which its frequency is not compared


def boundaries(system: System, buckling: float) -> np.ndarray:
    """Return the first four boundaries at α_s = 0.5, β_d = 0 to 1."""
    factors = np.linspace(0.0, 1.0, POINTS)
    return boundary_frequencies(system, 0.5 * buckling, factors * buckling)[:, :4]


def timed(call: Callable[[], np.ndarray], budget: float = 1.5) -> tuple[float, np.ndarray]:
    """Return the median time of as many calls as fit a budget, and the result."""
    times: list[float] = []
    while not times or (sum(times) < budget and len(times) < 200):
        start = time.perf_counter()
        result = call()
        times.append(time.perf_counter() - start)
    return statistics.median(times), result


def random_cases(count: int, seed: int, rigid: bool) -> list[tuple[ShaftDisk, float, float, float]]:
    """Return rotor, spin speed, tangency and static load factor, drawn from the sliders' ranges.

    A rigid disk has Ī_P of at most 2 Ī_D; the sliders allow more. r² = Φ/3 as the dashboard has it.
    """
    draw = np.random.default_rng(seed)
    cases = []
    for _ in range(count):
        diametral = float(np.exp(draw.uniform(np.log(0.01), np.log(3.0))))
        shear = float(draw.uniform(0.0, 0.1) * (draw.random() < 0.8))
        rotor = ShaftDisk(
            shear=shear,
            disk_mass=float(np.exp(draw.uniform(np.log(0.5), np.log(20.0)))),
            diametral_inertia=diametral,
            polar_inertia=float(draw.uniform(0.0, 2 * diametral if rigid else 6.0)),
            slenderness=math.sqrt(shear / 3),
        )
        tangency = float(draw.choice([0.0, 1.0, draw.random()]))
        cases.append((rotor, float(draw.uniform(0, 4)), tangency, float(draw.uniform(0, 0.95))))
    return cases


def slowest_whirls(system: System, load: float) -> np.ndarray:
    """Return 2B, 1B, 1F, 2F: the two nearest to 0 of each direction; complex where it grows."""
    whirl = whirl_frequencies(system, load)
    whirl = whirl[np.argsort(np.abs(whirl))]
    backward, forward = whirl[whirl.real < 0][:2], whirl[whirl.real >= 0][:2]
    return np.concatenate([backward[::-1], forward])


def whirl_errors(
    cases: list[tuple[ShaftDisk, float, float, float]], modes: tuple[int, ...]
) -> dict[int, np.ndarray]:
    """Return the errors of 2B, 1B, 1F, 2F (k, 4) by number of coordinates, against all of them.

    Relative to the frequency, or to 0.1 ω_n where the frequency is lower than that.
    """
    errors: dict[int, list[np.ndarray]] = {count: [] for count in modes}
    for rotor, spin, tangency, factor in cases:
        buckling = float(critical_load(rotor.shear))
        everything = finite_element(rotor, spin, tangency)
        floor = 0.1 * fundamental_frequency(everything)
        reduced = {count: finite_element(rotor, spin, tangency, modes=count) for count in modes}
        for load in (-buckling, 0.0, factor * buckling):
            wanted = slowest_whirls(everything, load)
            if np.abs(wanted.imag).max() > GROWS:
                continue
            for count, system in reduced.items():
                gap = np.abs(slowest_whirls(system, load) - wanted)
                errors[count].append(gap / np.maximum(np.abs(wanted), floor))
    return {count: np.array(found) for count, found in errors.items()}


def growth_errors(cases: list[tuple[ShaftDisk, float, float, float]], points: int) -> np.ndarray:
    """Return errors of growth rates (k, points) of the dashboard's system, over each largest.

    Only for loads slower than any resonance of the third mode, whose frequency is right to 1 %.
    """
    errors = []
    for seed, (rotor, spin, tangency, factor) in enumerate(cases):
        buckling = float(critical_load(rotor.shear))
        draw = np.random.default_rng(seed)
        small, accurate = (
            finite_element(rotor, spin, tangency, modes=count) for count in (MODES, ACCURATE)
        )
        whirl = whirl_frequencies(accurate, factor * buckling).real
        slow, fast = np.split(whirl[np.argsort(np.abs(whirl))], [4])
        scale = fundamental_frequency(accurate)
        high = min(16 * scale, 0.95 * float(np.abs(np.subtract.outer(fast, slow)).min()))
        theta = draw.uniform(0.6 * scale, high, points)
        at = factor * buckling, draw.uniform(0, 1, points) * buckling, theta
        wanted = growth_rate(accurate, *at)
        if wanted.max() > 1e-3 * scale:
            errors.append(np.abs(growth_rate(small, *at) - wanted) / wanted.max())
    return np.array(errors)


def reduction(quick: bool) -> None:
    """Print how far reduced elements are off over the ranges of the sliders."""
    counts = (3, 4, 5, 6, 8)
    for rigid in (True, False):
        disk = "disks with Ī_P of at most 2 Ī_D" if rigid else "disks with any Ī_P to 6"
        cases = random_cases(30 if quick else 300, 1, rigid)
        print(f"\n{len(cases)} random rotors, {disk}: error of 2B, 1B, 1F, 2F\n")
        print(f"{'coordinates':>11}{'median':>10}{'95 %':>10}{'largest':>10}")
        for count, found in whirl_errors(cases, counts).items():
            low, high = np.quantile(found, [0.5, 0.95])
            print(f"{count:>11}{low:>10.1e}{high:>10.1e}{found.max():>10.1e}")
        growths = growth_errors(cases[: 4 if quick else 20], 40)
        print(
            f"\nGrowth rates, {MODES} coordinates against {ACCURATE}, over the largest of each "
            f"rotor: 95 % {np.quantile(growths, 0.95):.1e}, 99 % {np.quantile(growths, 0.99):.1e}, "
            f"largest {growths.max():.1e}"
        )


def main(quick: bool = False) -> None:
    """Print the tables."""
    timings()
    reduction(quick)


def timings() -> None:
    """Print one table a speed."""
    rotor, scales = ShaftDisk.from_si(**TABLE_1_SI)
    buckling = float(critical_load(rotor.shear))
    scale = fundamental_frequency(lumped(rotor, 0.0))
    for rpm in (0.0, 1000.0):
        spin = rpm * math.pi / 30 / scales.frequency
        models: dict[str, Callable[[], System]] = {
            "lumped": lambda spin=spin: lumped(rotor, spin),
            "finite elements, all": lambda spin=spin: finite_element(rotor, spin),
            **{
                f"reduced to {modes}": lambda spin=spin, m=modes: finite_element(
                    rotor, spin, modes=m
                )
                for modes in (2, 4, 6, 8)
            },
        }
        results = {
            name: timed(lambda make=make: boundaries(make(), buckling))
            for name, make in models.items()
        }
        base, _ = results["lumped"]
        reference = results["finite elements, all"][1]
        print(f"\nFig. 4 at {rpm:g} r.p.m., {POINTS} values of β_d, model built each time")
        print(
            f"{'model':<22}{'time/lumped':>12}{'ms':>9}{'largest error':>15}  first, second region"
        )
        for name, (seconds, values) in results.items():
            # the left boundary runs to 0 at β_d = 1: relative to ω_n, not to itself
            error = np.abs(values - reference).max() / scale
            middle = values[POINTS // 2] / scale
            edges = "  ".join(f"{edge:.4f}" for edge in middle)
            print(f"{name:<22}{seconds / base:>12.1f}{1e3 * seconds:>9.1f}{error:>15.1e}  {edges}")


if __name__ == "__main__":
    main()
