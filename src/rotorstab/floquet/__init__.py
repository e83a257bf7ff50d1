"""What is unstable under a pulsating load: Floquet's theory, point by point and along tongues.

Read `schemes`, `kicks` and `integrator`; `multipliers`, `criterion` (what counts as unstable) and
`point`; `averaging`, `resonance` and `first_order`. Motion is in `initial_conditions`,
`sampled_period` and `response`. `interpolant` makes whole charts quick, and `tongues` finds what
lies between their pixels.
"""
