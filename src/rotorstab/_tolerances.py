"""Every threshold that decides what an answer means: what is zero, real, equal or growing.

Thresholds that only steer an algorithm (step sizes, meshes, numbers of iterations) stand in the
module of that algorithm. The text of a threshold says what it is a part of; growth rates are
non-dimensional [√(EI/(ρAL⁴))].
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

STRAIGHT_ORBIT = 1e-6
"""Part of a whirl's kinetic energy by which its forward and backward parts must differ.

If they differ by less, the rotor vibrates along straight lines. The modes of a rotor at rest are
such; their eigenvectors are real to about 1e-8 of their size.
"""

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

SAME_BOUNDARY = 1e-9
"""Distance in θ/ω_n up to which a reading of the paper takes two boundary curves for one.

Both are roots of one quartic, known to 1e-12 or better, and interpolated on the same loads.
"""

NO_WIDTH = 1e-6
"""Width in θ/ω_n below which a reading says that a region has none where nothing pulsates.

The two boundaries of a resting rotor start from a double root, which is known to 1e-8.
"""

SAME_START = 9
"""Decimal digits of ω²/max|ω²| to which two boundary curves start from the same point.

At rest the backward and the forward whirl have one frequency; both halves of a pair are known to
more than nine digits there.
"""

# What grows

SMALLEST_GROWTH = 1e-8
"""Growth rate σ̄ [√(EI/(ρAL⁴))] above which a point is unstable, if it also exceeds its error.

A multiplier is known to about 1e-11 where it is simple, and to the square root of rounding, 1e-8,
where two of them meet: at the edge of every tongue.
"""

UNSTABLE_MEAN = 1e-9
"""Growth rate, relative to the largest |ω|, above which a rotor is unstable without pulsation.

Only `criterion.grows_or_decays` compares with it; decay below this part is not shown either.

It separates the rounding of simple eigenvalues, 1e-12 at most, from flutter, buckling and rotating
damping, which grow faster by orders of magnitude as soon as their limit is passed.
"""

TRUE_PART_OF_BOUND = 0.5
"""Part of the error bound of an interpolated growth rate that the edges of a chart take for error.

The bound allows for four times the errors of the coefficients that were measured, and where two
multipliers meet, the error of the growth rate is the square root of theirs. Edges by the whole
bound would lie inside the tongues.
"""

VISIBLE_GROWTH = 1e-6
"""Growth rate σ̄ above which an undamped rotor counts as unstable in margins and thresholds.

Without damping a tongue of order k ≥ 2 reaches down to p̄_t = 0 as a cusp, so the smallest load
depends on the growth that counts. This is the smallest one that stands clear of `SMALLEST_GROWTH`
along a whole cusp. Mean rotors that decay more slowly count as undamped.

On a map it is also the growth rate, in a tongue narrower than a pixel, from which a doubtful one is
solved again point by point: a map must not lack what a margin counts. A growth rate is doubtful if
it is smaller than its error bound.
"""

DOUBTFUL_IN_OUTLINE = 3e-5
"""Growth rate σ̄ below which a doubtful tongue is left out of the outlines.

It is larger than `VISIBLE_GROWTH` of the maps, for outlines are drawn while a slider moves.
"""

FIRST_ORDER_GROWTH = 1e-4
"""Growth of averaged amplitudes, relative to the strongest coupling, that counts.

Two eigenvalues of the averaged matrix that meet are known to 1e-8 of the coupling only; between
two tongues that touch, growth below this part makes no gap of a width that could be seen.
"""

ON_UNIT_CIRCLE = 1e-10
"""Distance |μ| − 1 below which the largest multiplier of an undamped rotor counts as neutral.

A time response over 10,000 periods then neither grows nor decays through the error of its
propagator, 1e-11.
"""

UNCERTAIN_PIXEL = 1e-5
"""Error of a growth rate σ̄ on a map above which the pixel is solved again point by point."""

ROUGH_PART = 0.01
"""Error of a growth rate, as a part of it, above which a pixel that may not be solved again is NaN.

Charts that leave out loads too slow for it would otherwise show growth that is wrong by half.
"""

NO_VERDICT = 1.0
"""Error of ln max|μ| from which a doubtful pixel has no verdict.

Not even the order of magnitude of the multiplier is known then.
"""

# How near to the pole of the exact stiffness answers go, as a part of the load at the pole

FLUTTER_SEARCH_SHORT_OF_POLE = 1e-9
"""The search for flutter ends so much below the pole: K is still finite, and nothing is missed."""

MAP_SHORT_OF_POLE = 1e-3
"""Charts over the pulsating load end so much below the pole, and the map is blank beyond.

The stiffness, and with it the number of steps of every integrator, grows without bound there.
"""

COEFFICIENTS_SHORT_OF_POLE = 0.015
"""Charts of the influence coefficients end so much below the pole.

There k₂₂ is 20 to 30 times as large as without load, far outside its chart.
"""

CURVES_SHORT_OF_POLE = 0.1
"""Whirl curves, outlines of tongues and the shape of the shaft are drawn so far from the pole only.

Of outlines it is the part of the way from the mean load to the pole. Nearer, single frequencies
run away, and their curves leave no room for the others.
"""

FLUTTER_IN_VIEW = 0.2
"""The axis of the whirl curves reaches to a flutter load that is farther below the pole than this.

It is twice `CURVES_SHORT_OF_POLE`, so that some of the curve beyond flutter is seen.
"""

# What agrees with a printed number

DECIMAL_ROUNDING = 1e-9
"""Part of an allowed difference by which a difference may exceed it.

Decimal numbers are rounded in binary, so that 12.302 − 12.301 exceeds 0.001 by 1e-16.
"""

# Edges of tongues

EDGE = 1e-9
"""Relative width of the last bracket of an edge θ̄ or of a critical load, solved point by point."""

LIVE_EDGE = 1e-7
"""As `EDGE`, on the interpolated polynomial: its coefficients have an error of 1e-7."""

MERGED_TONGUES = 1e-5
"""Part of θ̄: where the rotor is unstable so close beyond an edge, the tongues have merged."""

TOUCHING = 1e-12
"""Part of θ̄: intervals that are closer are one, cut by the border of two panels."""

SAME_FREQUENCY = 1e-9
"""Part of θ̄: an edge that is closer to the border of a window lies on the border."""

SAME_POINT = 1e-6
"""Part of θ̄ or p̄_t: points of a search that are closer are one."""

# What is one place of a rotor

SAME_POSITION = 1e-9
"""Part of the shaft's length: two stations that are closer are one.

Positions are sums of the lengths of sections, with a rounding error of 1e-16 each. An element that
is shorter than this would lose half of the digits of every result.
"""

RIGID = 1e-10
"""Part of the largest stiffness of a rotor's supports below which a support does not hold it.

The stiffness against the two rigid motions of the shaft, as a deflection and as a turn by the
shaft's length, is compared; 1e-16 of the largest is rounding.
"""
