"""Tongues of instability: their centres, edges, outlines and thresholds.

Named tongues: `collision_measure`, `tracking`, `pair_edges`, `edges`. What a chart shows:
`collisions`, `subpixel`, `intervals`, `linking`, `outlines`. The least pulsation that
destabilises: `plane`, `approaches`, `crossings`, `thresholds`, `band_threshold`.
"""
