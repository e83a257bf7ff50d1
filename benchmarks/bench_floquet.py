"""Time of the growth map against DOP853 at each pixel, against the quartic, by pixels and modes.

Run: python benchmarks/bench_floquet.py [--quick]
"""

from __future__ import annotations

import sys
import time

import numpy as np
from scipy.integrate import solve_ivp

from app.results.limits import Detail
from app.results.model import Model, Operation
from app.results.views import View
from app.results.window import Window, floquet_map
from rotorstab import BASE_CASE, critical_load, finite_element, fundamental_frequency, lumped
from rotorstab.floquet.interpolant.characteristic import self_inversive_multipliers
from rotorstab.floquet.point import growth_rate
from rotorstab.maps.stability_map import stability_chart
from rotorstab.model.modal import state_matrix

QUICK = "--quick" in sys.argv
LOAD = float(critical_load(BASE_CASE.shear))
SYSTEM = lumped(BASE_CASE, 2.0)
FREQUENCY = fundamental_frequency(SYSTEM)


def best(call, repeats=7):
    """Shortest of several runs, in seconds: the machine's other work only adds."""
    times = []
    for _ in range(1 if QUICK else repeats):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return min(times)


def grid(columns=240, rows=120, low=0.2, high=12.0):
    return np.linspace(0, 1, rows) * LOAD, np.linspace(low, high, columns) * FREQUENCY


def chart(system=SYSTEM, columns=240, rows=120, low=0.2, **options):
    loads, theta = grid(columns, rows, low)
    return stability_chart(system, 0.5 * LOAD, loads, theta, **options)


def dop853(load, theta):
    """Return one pixel's growth rate the ordinary way."""
    mean = state_matrix(SYSTEM, SYSTEM.stiffness(0.5 * LOAD))
    swing = state_matrix(SYSTEM, SYSTEM.stiffness(0.5 * LOAD + load)) - mean

    def rate(t, z):
        return (1j * ((mean + np.cos(theta * t) * swing) @ z.reshape(4, 4))).ravel()

    start = np.eye(4, dtype=complex).ravel()
    period = 2 * np.pi / theta
    run = solve_ivp(rate, (0, period), start, "DOP853", rtol=1e-8, atol=1e-10)
    return np.log(np.abs(np.linalg.eigvals(run.y[:, -1].reshape(4, 4))).max()) / period


def interleaved(*calls, rounds=40):
    """Return the shortest time of each call [s], in turns: one slow moment hits all of them."""
    times = np.full(len(calls), np.inf)
    for _ in range(1 if QUICK else rounds):
        for k, call in enumerate(calls):
            times[k] = min(times[k], best(call, 1))
    return times


def dashboard():
    """Print what the Explore page asks for: maps while moving, maps with edges at rest."""
    models = {
        "lumped": {},
        "lumped, damped": {"external_damping": 0.01, "internal_damping": 0.002},
        "lumped, exact stiffness": {"law": "exact"},
        "finite elements": {"kind": "finite elements"},
        "finite elements, damped": {"kind": "finite elements", "external_damping": 0.01},
    }
    for name, options in models.items():
        model = Model(BASE_CASE, **options)
        operation = Operation(model, 2.0, 0.0, 0.5 * LOAD, LOAD, FREQUENCY)
        window = Window(operation, View(0.0, 16.0, 0.0, 1.0))
        moving = best(lambda w=window: floquet_map(w, Detail.COARSE), 5)
        settled = best(lambda w=window: floquet_map(w, Detail.FULL), 3)
        made = floquet_map(window, Detail.FULL)
        line(f"page, moving: {name}", moving)
        note = f"{made.growth.refined} pixels refined, {len(made.edges.thin)} thin tongues"
        line(f"page, at rest: {name}", settled, note)


def line(what, seconds, note=""):
    print(f"{what:<46}{seconds * 1e3:>12.2f} ms  {note}")


def main():
    coefficients = np.random.default_rng(0).uniform(-2, 2, (3, 120, 240))
    floor, bare = interleaved(
        lambda: self_inversive_multipliers(coefficients),
        lambda: chart(refine=False, find_narrow=False),
    )
    line("floor: multipliers of 240 x 120 known quartics", floor)
    line("map 240 x 120, bare", bare, f"{bare / floor:.1f} x floor")
    line("map 240 x 120, doubtful pixels refined", best(lambda: chart(find_narrow=False)))
    line("chart 240 x 120, thin tongues marked as well", best(chart))
    coarse = best(lambda: chart(columns=80, rows=40, density=0.8, refine=False, find_narrow=False))
    line("map 80 x 40, density 0.8, bare", coarse)

    rng = np.random.default_rng(1)
    loads, theta = grid()
    sample = [(rng.choice(loads), rng.choice(theta)) for _ in range(4 if QUICK else 60)]
    slow = [dop853(*point) for point in sample]
    # the shortest of three turns a point: the machine's other work only adds
    pixel = np.mean([best(lambda p=point: dop853(*p), 3) for point in sample])
    fast = growth_rate(SYSTEM, 0.5 * LOAD, *np.array(sample).T)
    line("DOP853 (rtol 1e-8), one pixel", pixel, f"largest gap {np.abs(slow - fast).max():.1e}")
    line("DOP853, whole map", pixel * 28800, f"{pixel * 28800 / bare:,.0f} x the map")

    for columns, rows in ((240, 120), (775, 387), (2450, 1225))[: 2 if QUICK else 3]:
        seconds = best(
            lambda c=columns, r=rows: chart(columns=c, rows=r, refine=False, find_narrow=False), 2
        )
        each = seconds / columns / rows * 1e9
        line(f"map of {columns * rows:,} pixels", seconds, f"{each:.0f} ns a pixel")
    for modes in (2, 3) if QUICK else (2, 3, 4, 6, 8):
        system = finite_element(BASE_CASE, 2.0, modes=modes)
        seconds = best(
            lambda s=system: chart(
                s, columns=24, rows=12, low=1.0, refine=False, find_narrow=False
            ),
            1,
        )
        line(f"map 24 x 12 of {modes} finite-element modes", seconds)
    dashboard()


if __name__ == "__main__":
    main()
