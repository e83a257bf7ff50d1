"""Whirl frequencies followed by continuity from one parameter value to the next."""

from __future__ import annotations

import numpy as np
from scipy.optimize import linear_sum_assignment

from .._types import Complex, Index

__all__ = ["nearest_columns", "track"]


def track(rows: Complex, start: int = 0) -> Complex:
    """Reorder the entries of each row so that every column is continuous.

    Parameters
    ----------
    rows : (m, k) complex
        Each row sorted by real part; neighbouring rows belong to neighbouring parameter values.
    start : int
        Number of the row whose order is kept.

    Returns
    -------
    (m, k) complex

    Notes
    -----
    Real roots of one family do not cross: they veer or merge. So the sorted order is the
    continuous one where all roots of both neighbours are real. Entries change places only where a
    complex pair passes another root.
    """
    if not rows.imag.any():
        return rows
    is_complex = np.ascontiguousarray(rows.imag.T) != 0  # a row for each column
    has_pair = is_complex.any(axis=0)
    moved = (is_complex[:, 1:] != is_complex[:, :-1]).any(axis=0) | is_complex[:, 1:].all(axis=0)
    steps = np.flatnonzero(has_pair[1:] & has_pair[:-1] & moved)
    if not steps.size:
        return rows
    costs = np.abs(rows[steps, :, None] - rows[steps + 1, None, :]) ** 2
    # no other order is better where every root is nearest to the root in its own column
    kept = (costs.argmin(axis=2) == np.arange(rows.shape[1])).all(axis=1)
    if kept.all():
        return rows
    orders = np.tile(np.arange(rows.shape[1]), (len(rows), 1))
    for step, cost in zip(steps[~kept], costs[~kept], strict=True):
        orders[step + 1 :] = linear_sum_assignment(cost)[1][orders[step]]
    return np.take_along_axis(rows, orders, axis=1)[:, np.argsort(orders[start])]


def nearest_columns(wanted: Complex, found: Complex) -> Index:
    """Return which entry of `found` (k,) belongs to each entry of `wanted` (k,).

    The assignment is one to one and has the smallest sum of squared distances.
    """
    costs = np.abs(np.subtract.outer(wanted, found)) ** 2
    return np.asarray(linear_sum_assignment(costs)[1])
