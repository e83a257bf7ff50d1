"""What does the page say? Results as sentences and as numbers with units.

Read `typography`, `units` and `si` first, which write one quantity; then `verdict` and `details` on
the instability chart, `point` on the marked point, and `refusals` where there is no result.
"""
