"""Bolotin's method, the paper's: boundary frequencies and regions of parametric resonance.

Solutions of period 2T are sought as one harmonic, q = a sin(θ̄t/2) + b cos(θ̄t/2). With λ = θ̄²/4,
K∓ = K₀ ∓ K₁/2 (K₀ and K₁ are the first two harmonics of K(p̄(t))), and b → jb, an undamped rotor
has such a solution where a real determinant vanishes:

    P(λ) = det [[K₋ − λM, −√λ Ω̄H], [−√λ Ω̄H, K₊ − λM]] = 0.            (24)

A *Bolotin region* is where P < 0. Once the rotor spins, it is not where the rotor is unstable: a
Floquet multiplier may pass through −1 and stay on the unit circle.

Read `boundaries`, then `regions`; `chart` follows the boundaries over the pulsating load, and
`boundary_names` names them by whirl modes. `hill` takes more harmonics and the period T.
"""
