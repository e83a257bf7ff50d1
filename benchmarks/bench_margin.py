"""Compare margins of random rotors with an independent search: how many are wrong, and the time.

Run: python -m benchmarks margin [--quick]
"""

from __future__ import annotations

import time

import numpy as np

from rotorstab import (
    ShaftDisk,
    critical_load,
    fundamental_frequency,
    growth_rate,
    lumped,
    resonances,
    stability_margin,
)

SEED = 20261127


def random_case(rng):
    """Return a lightly damped rotor, its mean load, band and largest load."""
    inertia = rng.uniform(0.1, 2.0)
    rotor = ShaftDisk(
        shear=rng.uniform(0, 0.1),
        disk_mass=rng.uniform(0.5, 12),
        diametral_inertia=inertia,
        polar_inertia=rng.uniform(0, 2) * inertia,
    )
    load = float(critical_load(rotor.shear))
    system = lumped(
        rotor,
        rng.uniform(0, 4),
        tangency=float(rng.choice([0.0, 0.5, 1.0])),
        external_damping=10 ** rng.uniform(-4, -1.5),
        internal_damping=float(rng.choice([0.0, 10 ** rng.uniform(-5, -3)])),
    )
    frequency = fundamental_frequency(system)
    low, high = np.sort(rng.uniform(0.5, 8, 2))
    return system, rng.uniform(0, 0.6) * load, (low * frequency, (high + 0.3) * frequency), load


def found_below(system, static, band, load, columns=400):
    """Return the highest growth at a load: a plain scan of the band, fine near every resonance.

    Near θ̄ = |ω_i − ω_j|/k the columns gather towards the root and, one after another, towards
    where the growth rate is highest.
    """
    low, high = band
    theta = np.linspace(low, high, columns)
    offsets = np.concatenate([-np.geomspace(3e-2, 1e-6, 40), [0], np.geomspace(1e-6, 3e-2, 40)])
    roots = np.array([row.centre / k for row in resonances(system, static, 0.0) for k in (1, 2, 3)])
    near = (roots[:, None] * (1 + offsets)).ravel()
    theta = np.unique(np.concatenate([theta, near]).clip(low, high))
    rate = growth_rate(system, static, load, theta)
    highest = rate.max()
    for _ in range(3):
        peaks = np.flatnonzero((rate[1:-1] >= rate[:-2]) & (rate[1:-1] >= rate[2:])) + 1
        peaks = peaks[np.argsort(-rate[peaks])][:8]
        if not peaks.size:
            break
        steps = np.linspace(0, 1, 21)
        more = theta[peaks - 1, None] + steps * (theta[peaks + 1] - theta[peaks - 1])[:, None]
        theta, rate = more.ravel(), growth_rate(system, static, load, more.ravel())
        order = np.argsort(theta)
        theta, rate = theta[order], rate[order]
        highest = max(highest, rate.max())
    return float(highest)


def judged(system, static, band, largest):
    """Return the margin and a word on it: right, or what is wrong."""
    margin = stability_margin(system, static, *band, largest)
    load, place = margin.pulsating_load, margin.excitation_frequency
    if load == 0:
        return margin, "unstable mean"
    if np.isfinite(load):
        steps = load * (1 + np.array([-1e-5, 1e-5]))
        below, above = growth_rate(system, static, steps, place)
        if not below < 0 < above:
            return margin, "no crossing there"
    looked_at = min(0.999 * load, largest)
    if any(
        found_below(system, static, band, part * looked_at) > 1e-9 for part in (0.2, 0.5, 0.8, 1.0)
    ):
        return margin, "too large"
    return margin, "right"


def main(quick=False):
    """Print how many margins of random rotors are right."""
    rng = np.random.default_rng(SEED)
    words, seconds, worst = {}, [], []
    for index in range(20 if quick else 200):
        case = random_case(rng)
        start = time.perf_counter()
        stability_margin(case[0], case[1], *case[2], case[3])
        seconds.append(time.perf_counter() - start)
        margin, word = judged(*case)
        kind = f"{word}, {'finite' if np.isfinite(margin.pulsating_load) else 'infinite'}"
        words[kind] = words.get(kind, 0) + 1
        if not word.startswith(("right", "unstable")):
            worst.append((index, margin, word))
    print("| margins of random damped rotors | number |\n|---|---|")
    for word, count in sorted(words.items()):
        print(f"| {word} | {count} |")
    print(f"| median time [ms] | {1e3 * np.median(seconds):.0f} |")
    print(f"| longest time [ms] | {1e3 * max(seconds):.0f} |")
    for line in worst:
        print(*line)


if __name__ == "__main__":
    main()
