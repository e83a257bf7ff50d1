"""Every threshold that decides what an answer means: what is zero, real, equal or growing.

Thresholds that only steer an algorithm (step sizes, meshes, numbers of iterations) stand in the
module of that algorithm. Each threshold is relative to the quantity that its text names.
"""

from __future__ import annotations

# What is zero

NEGLIGIBLE = 1e-12
"""Part of the largest value of a set below which a value is rounding and counts as zero.

Rounding is 1e-16 of the largest value; an eigenvalue solver of some ten modes adds two or three
digits to that.
"""

MASSLESS = 1e-6
"""Part of the largest root 1/θ̄ of Hill's determinant below which a root counts as zero.

The mean term of a solution of period T carries no inertia, so some 1/θ̄ are exactly zero. They are
multiple, and a double root is known to half of its digits, about 1e-8, only.
"""

# What is real, what is equal

REAL = 1e-7
"""Part |Im|/|root| below which a root counts as real.

Rounding splits a double real root into a complex pair whose imaginary parts are about the square
root of 1e-16, that is 1e-8, and up to 1e-7 in ill-conditioned cases.
"""

DOUBLE_ROOT = 1e-15
"""A discriminant that is below zero by less than this part of its terms counts as zero."""

COALESCED = 1e-6
"""Part |Im ω|/|Re ω| above which two whirl frequencies have coalesced (flutter).

It is larger than `REAL`, so that rounding is not taken for a coalescence. The same part of the
largest |Re ω| decides which whirls lie away from ω = 0, where a pair means buckling.
"""

CLOSE_SQUARES = 1e-4
"""Relative distance of two λ = θ̄²/4 below which Eq. (24) is solved again from its matrices.

The coefficients of a quartic hold half of the digits of roots that nearly meet: their error at this
distance is 1e-16/1e-4 = 1e-12 of λ, and it grows as they come closer.
"""

SAME_START = 9
"""Decimal digits of ω²/max|ω²| to which two boundary curves start from the same point.

At rest the backward and the forward whirl have one frequency; both halves of a pair are known to
more than nine digits there.
"""
