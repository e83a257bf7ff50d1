"""Tongues of instability: their centres, edges, outlines and thresholds.

A *tongue* is the set of loads and frequencies at which one resonance |ω_i − ω_j|/k makes the rotor
unstable; a *region* is what several tongues become where they overlap, or a Bolotin region where it
is called so; a *piece* is a connected part of the unstable set on a grid of loads. Two multipliers
*meet* where they are equal on the unit circle; they *collide* if they leave the circle there, which
is the edge of a tongue. The *ridge* of a tongue is the line along which its two multipliers are
closest. A *band* is a range of frequencies.

Named tongues: `collision_measure`, `tracking`, `pair_edges`, `edges`. What a chart shows:
`collisions`, `subpixel`, `intervals`, `linking`, `outlines`. The least pulsation that
destabilises: `plane`, `approaches`, `crossings`, `thresholds`, `band_threshold`.
"""
