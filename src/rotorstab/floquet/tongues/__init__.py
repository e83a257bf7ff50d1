"""Tongues of instability: their edges, the narrow ones, their outlines and their lowest loads.

Read `tracking` and `edges`; `collisions`, `narrow`, `intervals` and `outlines` find what a chart
shows; `crossings` and `lowest_load` find the least pulsation that destabilises.
"""
