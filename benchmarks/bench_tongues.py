"""Compare outlines of random rotors with single points: tongues that are missed or false.

`python -m benchmarks tongues` takes some ten minutes on one core, `--quick` one. Every rotor is
scanned along the top row of its chart, θ̄ from 0.4 to 16 ω_n, by `floquet_solution` alone
(`benchmarks.tongue_scan`); a miss is a growth above 1e-4 outside every outline.
"""

from __future__ import annotations

import time

import numpy as np

from benchmarks.tongue_scan import compare, scan
from rotorstab import ShaftDisk, System, critical_load, fundamental_frequency, lumped
from rotorstab.floquet.tongues.outlines import unstable_outlines
from rotorstab.model.stiffness import largest_exact_load

LEAST = 1e-4  # growth that no outline may miss
GAP = 3.5e-3  # of θ̄: narrower gaps between two tongues may be closed

KINDS = ("at rest", "spinning", "at rest, damped", "spinning, damped")


def random_case(seed: int, kind: str) -> tuple[System, float, float, float]:
    """Return a rotor, its static load, largest pulsating load and ω_n."""
    rng = np.random.default_rng([seed, KINDS.index(kind)])
    inertia = 10 ** rng.uniform(-1, 0.3)
    rotor = ShaftDisk(
        shear=rng.uniform(0, 0.1),
        disk_mass=10 ** rng.uniform(0, 1.2),
        diametral_inertia=inertia,
        polar_inertia=rng.uniform(0, 2) * inertia,
    )
    buckling = float(critical_load(rotor.shear))
    static, load = rng.uniform(0, 0.6) * buckling, rng.uniform(0.05, 1) * buckling
    law = str(rng.choice(["linear", "exact"]))
    if law == "exact":
        load = min(load, 0.85 * (float(largest_exact_load(rotor.shear)) - static))
    damping = (10 ** rng.uniform(-4, -1), rng.choice([0, 10 ** rng.uniform(-4, -1)]))
    system = lumped(
        rotor,
        0.0 if "rest" in kind else rng.uniform(0.05, 4),
        rng.choice([0, 0.5, 1]),
        *(damping if "damped" in kind else (0.0, 0.0)),
        stiffness=law,
    )
    return system, static, load, float(fundamental_frequency(system))


def top_row(system: System, static: float, load: float, low: float, high: float, rows: int = 61):
    """Return the intervals of the outlines at their largest load."""
    return [
        (float(one.left[-1]), float(one.right[-1]))
        for one in unstable_outlines(system, static, load, low, high, rows)
        if one.pulsating_loads[-1] == load
    ]


def main(quick: bool = False) -> None:
    """Print one row a kind of rotor."""
    print(
        f"{'rotors':<20}{'of':>4}{'narrow':>8}{'missed':>8}{'largest':>10}{'false':>7}{'s each':>8}"
    )
    for kind in KINDS:
        missed: list[float] = []
        narrow = false = 0
        seconds = 0.0
        count = 3 if quick else 25
        for seed in range(count):
            system, static, load, frequency = random_case(seed, kind)
            low, high = 0.4 * frequency, 16 * frequency
            start = time.process_time()
            row = top_row(system, static, load, low, high)
            seconds += time.process_time() - start
            verdict = compare(scan(system, static, load, low, high), row, LEAST)
            narrow += verdict.narrow
            missed += [growth for _, growth in verdict.missed]
            false += sum(width > GAP for _, width in verdict.false)
        print(
            f"{kind:<20}{count:>9}{narrow:>9}{len(missed):>9}{max(missed, default=0):>9.1e}"
            f"{false:>9}{seconds / count:>9.2f}",
            flush=True,
        )


if __name__ == "__main__":
    main()
