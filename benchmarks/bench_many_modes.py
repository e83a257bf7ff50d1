"""Growth maps of systems of many coordinates: with all whirls, reduced to the slow ones, by DOP853.

For each number of complex coordinates the same window is computed three times in one run:

- "all whirls": `stability_chart` without refinement, all multipliers of every pixel;
- "slow whirls": the same with `slow_whirls=True`, which reduces the system to what its four slowest
  whirls need in this window;
- "DOP853": SciPy's integrator at rtol 1e-8 for one pixel of the mean period, times all pixels.

The gap is the largest difference of growth rates of the first two. Then follow the pictures that a
page shows of a system of 20 roots: a moving one, a still one, both with edges. Times are of the
processor, the smallest of some turns; the ratios are what counts, for the machine may be busy.

    python -m benchmarks many_modes
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import TypeVar

import numpy as np
from scipy.integrate import solve_ivp

from rotorstab import (
    BASE_CASE,
    System,
    critical_load,
    finite_element,
    fundamental_frequency,
    lumped,
    stability_chart,
)
from rotorstab.model.modal import state_matrix

BUCKLING = float(critical_load(BASE_CASE.shear))
FUNDAMENTAL = fundamental_frequency(lumped(BASE_CASE, 0.0))
STATIC = 0.4 * BUCKLING
CASES = {"axial": (0.0, 0.0), "follower": (1.0, 0.0), "axial, damped": (0.0, 0.01)}
PICTURES = {"moving": (40, 324), "still": (120, 720)}  # rows and columns of the grid of the edges

Result = TypeVar("Result")


def timed(call: Callable[[], Result], turns: int = 3) -> tuple[float, Result]:
    """Return the shortest processor time of some turns, and the result."""
    times = []
    for _ in range(turns):
        start = time.process_time()
        result = call()
        times.append(time.process_time() - start)
    return min(times), result


def window(rows: int, columns: int) -> tuple[np.ndarray, np.ndarray]:
    """Return loads and frequencies of the window, θ/ω_n from 0.5 to 8."""
    return np.linspace(0.0, BUCKLING, rows), np.linspace(0.5, 8.0, columns) * FUNDAMENTAL


def chart(system: System, rows: int, columns: int, slow: bool, edges: bool = False) -> np.ndarray:
    """Return the growth rates of the window, without single points."""
    return stability_chart(
        system,
        STATIC,
        *window(rows, columns),
        refine=False,
        find_narrow=False,
        slow_whirls=slow,
        edges=edges,
        resolve=FUNDAMENTAL if edges else math.inf,
    ).growth


def dop853(system: System, load: float, theta: float) -> float:
    """Return the growth rate of one pixel by DOP853 on the physical equations."""
    size, period = 2 * system.size, 2 * np.pi / theta
    mean = 1j * state_matrix(system, system.stiffness(STATIC))
    change = 1j * state_matrix(system, system.stiffness(STATIC + load)) - mean

    def rate(time: float, z: np.ndarray) -> np.ndarray:
        matrix = mean + np.cos(theta * time) * change
        return np.asarray((matrix @ z.reshape(size, size)).ravel())

    start = np.eye(size, dtype=complex).ravel()
    run = solve_ivp(rate, (0, period), start, "DOP853", rtol=1e-8, atol=1e-8)
    monodromy = run.y[:, -1].reshape(size, size)
    return float(np.log(np.abs(np.linalg.eigvals(monodromy)).max()) / period)


def main(quick: bool = False) -> None:
    """Print the tables."""
    pixels = 40
    loads, thetas = window(pixels, pixels)
    print(f"{pixels} x {pixels} pixels: seconds, and how many times faster than all whirls")
    print(
        f"{'system':<22}{'DOP853':>10}{'all whirls':>12}{'slow whirls':>13}{'ratio':>8}{'gap':>10}"
    )
    for name, (tangency, damping) in CASES.items():
        for size in (4, 8) if quick else (4, 8, 10, 12):
            system = finite_element(BASE_CASE, 2.0, tangency, 20, size, damping, damping / 5)
            turns = 1 if quick else 2
            slow, four = timed(lambda s=system: chart(s, pixels, pixels, True))
            everything, all_whirls = timed(lambda s=system: chart(s, pixels, pixels, False), turns)
            # the period of one pixel is the mean of all
            middle = 2 * np.pi / np.mean(2 * np.pi / thetas)
            one, _ = timed(lambda s=system, t=middle: dop853(s, loads[-1] / 2, t), 1)
            gap = np.nanmax(np.abs(four - all_whirls))
            print(
                f"{name + f', n = {size}':<22}{one * pixels**2:>10.0f}{everything:>12.2f}"
                f"{slow:>13.3f}{everything / slow:>8.1f}{gap:>10.1e}",
                flush=True,
            )
    print("\nPictures with edges of a system of 10 complex coordinates, slow whirls: seconds")
    for name, (tangency, damping) in CASES.items():
        system = finite_element(BASE_CASE, 2.0, tangency, 20, 10, damping, damping / 5)
        times = [
            timed(lambda s=system, g=grid: chart(s, *g, slow=True, edges=True))[0]
            for grid in PICTURES.values()
        ]
        print(
            f"{name:<22}"
            + "  ".join(f"{kind} {t:.2f}" for kind, t in zip(PICTURES, times, strict=True)),
            flush=True,
        )


if __name__ == "__main__":
    main()
