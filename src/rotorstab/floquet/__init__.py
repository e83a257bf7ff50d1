"""What is unstable under a pulsating load: Floquet's theory, point by point and along tongues.

Read `integrator`, then `point`, `resonance`, `first_order` and `response`; then `interpolant`,
which makes whole charts quick, and `tongues`, which finds what lies between their pixels.
"""
