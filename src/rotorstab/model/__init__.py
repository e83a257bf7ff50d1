"""What is solved: M q̈ + D q̇ + K(p̄) q = 0, for a lumped rotor or by finite elements.

Read `system`, the form that every analysis takes. The lumped rotor is `stiffness`,
`stiffness_law` (also under a pulsating load) and `lumped`, and `shaft_shape` the curve of its
shaft; the distributed shaft is `timoshenko`, `reduction` and `finite_element`; both take their
damping from `damping`. Any rotor is `mesh`, `rotor_system`, `rotor_reduction` and `buckling`.
`modal` is the basis in which the analyses work.
"""
