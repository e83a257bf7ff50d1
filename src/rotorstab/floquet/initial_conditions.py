"""States from which a time response starts: a whirl mode, an impulse, noise."""

from __future__ import annotations

import math

import numpy as np

from .._arguments import number, whole_number
from .._types import Complex
from ..model.modal import modal_basis
from ..model.system import System, fundamental_frequency, single_speed
from ..whirl.mode_names import names_of

__all__ = ["initial_conditions", "tip_coordinate"]


def tip_coordinate(system: System, index: int) -> int:
    """Return the index of a tip coordinate, counted from the first; −1 is the last one."""
    return whole_number("tip", index, -system.size, system.size - 1) % system.size


def initial_conditions(
    system: System,
    static_load: float,
    kind: str = "knock",
    seed: int = 0,
    tip: tuple[int, int] = (0, 1),
) -> Complex:
    """Return a state (q, q̇) to start from.

    Parameters
    ----------
    system : System
        At one spin speed.
    static_load : float
        p̄₀ [EI/L²], at which the whirl modes are taken.
    kind : str
        "mode:1F" and the like: one whirl mode, with unit tip displacement along V. "knock": an
        impulse on the tip along V, after which it has the speed ω_n. "noise": every whirl mode,
        each with a random complex amplitude.
    seed : int
        Seed of the random numbers of "noise", 0 or more.
    tip : (int, int)
        Indices of the coordinates that are the tip's displacement and slope; (-2, -1) for a
        finite-element system that is not reduced.

    Returns
    -------
    (2n,) complex
        q, then q̇.

    Raises
    ------
    ValueError
        If the system has no single spin speed, or there is no such kind, mode or coordinate.

    Examples
    --------
    >>> from rotorstab import ShaftDisk, lumped
    >>> start = initial_conditions(lumped(ShaftDisk(), 2.0), 1.0, "mode:1F")
    >>> complex(start[0])
    (1+0j)
    """
    n = system.size
    single_speed(system)
    end = tip_coordinate(system, tip[0])
    if kind == "knock":
        impulse = np.linalg.solve(system.mass, np.eye(n)[end])
        speed = fundamental_frequency(system) * impulse / impulse[end]
        return np.concatenate([np.zeros(n), speed]).astype(complex)
    basis = modal_basis(system, number("static_load", static_load))
    names = names_of(system, float(static_load), basis.frequencies)
    modes = basis.vectors.astype(complex)
    # the state of the modal form is (q, −jq̇)
    modes[n:] *= 1j
    if kind == "noise":
        generator = np.random.default_rng(whole_number("seed", seed, 0))
        pairs = generator.standard_normal((2, 2 * n))
        amplitudes = (pairs[0] + 1j * pairs[1]) / math.sqrt(4 * n)
        sizes = np.einsum("ik,ij,jk->k", modes[:n].conj(), system.mass, modes[:n]).real
        modes = modes * np.sqrt(system.mass[end, end] / sizes)
        return np.asarray(modes @ amplitudes)
    chosen = kind.removeprefix("mode:") if isinstance(kind, str) else kind
    if not isinstance(kind, str) or not kind.startswith("mode:") or chosen not in names:
        known = ", ".join(repr(f"mode:{name}") for name in sorted(names))
        raise ValueError(f"`kind` must be 'knock', 'noise' or one of {known}, got {kind!r}")
    mode = modes[:, names.index(chosen)]
    return np.asarray(mode / mode[end])
