"""Time the arrays of the dashboard's three charts against a plain loop over the points.

    OPENBLAS_NUM_THREADS=1 python benchmarks/bench_solver.py

Both run in one process, in turns, and must give the same numbers. The loop is what a reader of the
paper would write: the polynomial of Eq. (24) and `numpy.roots`, the first-order matrix and
`numpy.linalg.eigvals`. A second, lean loop computes what does not change only once, before it
begins.
"""

from __future__ import annotations

import argparse
import statistics
import timeit
from collections.abc import Callable

import numpy as np

import rotorstab as rs

ROTOR = rs.ShaftDisk()
REFERENCE = float(rs.critical_load(ROTOR.shear))
SPIN, STATIC = 1.0, 0.5 * REFERENCE
BETAS = np.linspace(0.0, 1.0, 300)
LOADS = {
    "axial": np.linspace(-1.0, 1.5, 400) * REFERENCE,
    "follower": np.linspace(-1.0, 3.0, 400) * REFERENCE,
}
SPEEDS = np.linspace(0.0, 4.0, 200)


def boundaries_loop(system: rs.System) -> np.ndarray:
    """Return θ̄ (300, 4) from the roots of Eq. (24)."""
    mass, inertia = np.diag(system.mass)
    gyroscopic = (float(system.spin_speed) * system.gyroscopic[1, 1]) ** 2
    rows = []
    for beta in BETAS:
        determinants, first = [], []
        for sign in (-1, 1):
            k = system.elastic + (STATIC + sign * beta * REFERENCE / 2) * system.geometric
            determinants.append(
                [
                    mass * inertia,
                    -(mass * k[1, 1] + inertia * k[0, 0]),
                    k[0, 0] * k[1, 1] - k[0, 1] * k[1, 0],
                ]
            )
            first.append([-mass, k[0, 0]])
        coupling = np.polymul([gyroscopic, 0.0], np.polymul(*first))
        squares = np.sort(np.roots(np.polysub(np.polymul(*determinants), coupling)))
        real = (np.abs(squares.imag) <= 1e-7 * np.abs(squares)) & (squares.real > 0)
        rows.append(np.where(real, 2 * np.sqrt(np.abs(squares.real)), np.nan))
    return np.array(rows)


def whirl_at(mass: np.ndarray, damping: np.ndarray, stiffness: np.ndarray) -> np.ndarray:
    """Return ω (4,) of M q̈ + D q̇ + K q = 0."""
    matrix = np.block(
        [
            [np.zeros((2, 2)), np.eye(2)],
            [-np.linalg.solve(mass, stiffness), -np.linalg.solve(mass, damping)],
        ]
    )
    return np.sort_complex(np.linalg.eigvals(matrix) / 1j)


def loads_loop(system: rs.System, loads: np.ndarray) -> np.ndarray:
    """Return ω (m, 4) over the loads."""
    damping = system.damping()
    return np.array(
        [whirl_at(system.mass, damping, system.elastic + p * system.geometric) for p in loads]
    )


def speeds_loop(system: rs.System) -> np.ndarray:
    """Return ω (m, 4) over the speeds."""
    stiffness = system.elastic + STATIC * system.geometric
    return np.array(
        [whirl_at(system.mass, -1j * speed * system.gyroscopic, stiffness) for speed in SPEEDS]
    )


def lean_boundaries_loop(system: rs.System) -> np.ndarray:
    """Return the same as `boundaries_loop`; every coefficient is computed before the loop."""
    mass, inertia = np.diag(system.mass)
    gyroscopic = (float(system.spin_speed) * system.gyroscopic[1, 1]) ** 2
    minus, plus = (
        (system.elastic + (STATIC + sign * BETAS[:, None, None] * REFERENCE / 2) * system.geometric)
        for sign in (-1, 1)
    )
    a = mass * inertia
    b1, b2 = (-(mass * k[:, 1, 1] + inertia * k[:, 0, 0]) for k in (minus, plus))
    c1, c2 = np.linalg.det(minus), np.linalg.det(plus)
    k1, k2 = minus[:, 0, 0], plus[:, 0, 0]
    polynomials = np.stack(
        [
            np.full(BETAS.size, a * a),
            a * (b1 + b2) - gyroscopic * mass**2,
            a * (c1 + c2) + b1 * b2 + gyroscopic * mass * (k1 + k2),
            b1 * c2 + c1 * b2 - gyroscopic * k1 * k2,
            c1 * c2,
        ],
        axis=1,
    )
    squares = np.sort([np.roots(row) for row in polynomials])
    return 2 * np.sqrt(squares.real)


def lean_whirl_loop(system: rs.System, stiffness: np.ndarray, speeds: np.ndarray) -> np.ndarray:
    """Return ω (m, 4) by eigenvalues of one real matrix that is refilled at each point."""
    inverse = 1 / np.diag(system.mass)
    lower = inverse[:, None] * stiffness
    spin = inverse[1] * system.gyroscopic[1, 1] * speeds
    matrix = np.eye(4, k=2)
    result = np.empty((len(lower), 4), complex)
    for row, block, whirl in zip(result, lower, spin, strict=True):
        matrix[2:, :2] = block
        matrix[3, 3] = whirl
        row[:] = np.linalg.eigvals(matrix)
    return np.sort(result)


def sorted_boundaries(chart: rs.BolotinChart) -> np.ndarray:
    """Return the chart's rows at the even loads, ascending."""
    rows = np.searchsorted(chart.pulsating_load, BETAS * REFERENCE - 1e-12)
    return np.sort(chart.frequency[rows])


def timed(calls: list[Callable[[], object]], repeats: int) -> list[float]:
    """Return the median time of each call [ms]: turn by turn, each turn 10 ms or one call."""
    counts = [max(1, round(1e-2 / timeit.timeit(call, number=1))) for call in calls]
    times = [
        [
            timeit.timeit(call, number=count) / count
            for call, count in zip(calls, counts, strict=True)
        ]
        for _ in range(repeats)
    ]
    return [1e3 * statistics.median(column) for column in zip(*times, strict=True)]


def main(repeats: int = 15) -> float:
    """Print the table and return the ratio plain loop / library of all charts together."""
    axial, follower = rs.lumped(ROTOR, SPIN), rs.lumped(ROTOR, SPIN, tangency=1.0)

    def lean_loads(system: rs.System, loads: np.ndarray) -> np.ndarray:
        stiffness = system.elastic + loads[:, None, None] * system.geometric
        return lean_whirl_loop(system, stiffness, np.full(loads.size, SPIN))

    def lean_speeds(system: rs.System) -> np.ndarray:
        stiffness = system.elastic + STATIC * system.geometric
        return lean_whirl_loop(system, np.broadcast_to(stiffness, (SPEEDS.size, 2, 2)), SPEEDS)

    charts: dict[str, tuple[Callable[[], np.ndarray], ...]] = {
        "boundaries, 300 x 4": (
            lambda: sorted_boundaries(rs.bolotin_chart(axial, STATIC, REFERENCE, BETAS.size)),
            lambda: boundaries_loop(axial),
            lambda: lean_boundaries_loop(axial),
        ),
        "loads, axial, 400": (
            lambda: rs.load_frequency_curves(axial, LOADS["axial"]).frequencies,
            lambda: loads_loop(axial, LOADS["axial"]),
            lambda: lean_loads(axial, LOADS["axial"]),
        ),
        "loads, follower, 400": (
            lambda: rs.load_frequency_curves(follower, LOADS["follower"]).frequencies,
            lambda: loads_loop(follower, LOADS["follower"]),
            lambda: lean_loads(follower, LOADS["follower"]),
        ),
        "speeds, 200": (
            lambda: rs.campbell_diagram(axial, SPEEDS, STATIC).frequencies,
            lambda: speeds_loop(axial),
            lambda: lean_speeds(axial),
        ),
    }
    header = ("", "library ms", "plain ms", "ratio", "lean ms", "ratio", "difference")
    print("{:22}{:>12}{:>10}{:>8}{:>10}{:>8}{:>12}".format(*header))
    total = np.zeros(3)
    for label, calls in charts.items():
        reference, *others = (np.sort(call().round(8)) for call in calls)
        difference = max(np.nanmax(np.abs(np.sort(other) - reference)) for other in others)
        assert difference < 1e-6, (label, difference)
        times = np.array(timed(list(calls), repeats))
        total += times
        print_row(label, times, f"{difference:12.0e}")
    print_row("all", total, "")
    return float(total[1] / total[0])


def print_row(label: str, times: np.ndarray, end: str) -> None:
    """Print one line of the table."""
    library, plain, lean = times
    print(
        f"{label:22}{library:12.3f}{plain:10.2f}{plain / library:8.0f}"
        f"{lean:10.2f}{lean / library:8.0f}{end}"
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeats", type=int, default=30)
    main(parser.parse_args().repeats)
