"""Mathematics that knows no rotor: roots, parabolas, extrapolation.

`quartic` holds the roots of many polynomials at once, `companion` turns a quadratic eigenvalue
problem into a linear one, `roots` finds roots of functions and tells which roots are real,
`parabola` and `extrapolation` hold one formula each.
"""
