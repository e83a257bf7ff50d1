"""Mathematics that knows no rotor.

`quartic` holds the roots of many polynomials at once, `two_by_two` the determinants that lead to
them, `companion` turns a quadratic eigenvalue problem into a linear one, `roots` finds roots of
functions and tells which roots are real, `root_bounds` says how far a root may be. `chebyshev` is
interpolation; `parabola`, `extrapolation` and `angles` hold one formula each.
"""
