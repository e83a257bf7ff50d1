"""What is unstable under a pulsating load: Floquet's theory, point by point and along tongues.

Read `schemes`, `kicks` and `integrator`, then `criterion` (what counts as unstable) and `point`,
then `resonance` and `first_order`; `initial_conditions`, `response` and `shaft_shape` show motion.
`interpolant` makes whole charts quick, and `tongues` finds what lies between their pixels.
"""
