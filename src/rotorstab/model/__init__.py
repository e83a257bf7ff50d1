"""What is solved: M q̈ + D q̇ + K(p̄) q = 0, lumped or by finite elements.

Read `stiffness`, then `system`, then `timoshenko`, `reduction` and `finite_element`; `modal` is
the form that the analyses use.
"""
