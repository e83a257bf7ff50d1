"""Fig. 4's boundaries by the lumped model, by finite elements, and by reduced ones.

`python benchmarks/bench_finite_element.py` times all in one run and prints ratios: absolute
times depend on the machine. The paper's point was the cost of its 80 × 80 comparator; 20
elements here are 40 complex degrees of freedom, 80 × 80 in first-order form as well (160 × 160
for the boundaries, whose two load levels K₋ and K₊ are coupled by the spin).
"""

from __future__ import annotations

import math
import statistics
import time
from collections.abc import Callable

import numpy as np

from rotorstab import (
    TABLE_1_SI,
    ShaftDisk,
    System,
    boundary_frequencies,
    critical_load,
    finite_element,
    fundamental_frequency,
    lumped,
)

POINTS = 101


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


def main() -> None:
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
