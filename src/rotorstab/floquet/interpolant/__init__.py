"""The characteristic polynomial of a rotor over a whole chart, interpolated, and its growth rates.

Read `nodes`, `characteristic`, `growth`, then `polynomial`.
"""
