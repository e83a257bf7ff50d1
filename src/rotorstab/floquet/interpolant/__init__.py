"""The multipliers of a rotor over a whole chart, interpolated, and bounds on their error.

Read `panels` and `sampling`, which say where and how the monodromies are sampled, then
`characteristic`, `growth` and `matrix_growth`, which find the multipliers, `edge_measure`,
`slow_basis` and `slow_whirls` for more than two coordinates, then `chart_panels` and
`chart_interpolant`.
"""
