"""What follows from the inputs? Curves, growth maps and charts, cached and shared by sessions.

Read `caches`, `limits`, `model` and `operation` first; then `curves`, `window`, `growth_maps` and
`floquet_answer`, which `analysis` puts together, and `views` for a zoom; then `growth`, `nearest`,
`default_marker` and `marked_point` on one point; `comparisons` serves the other pages.
"""
