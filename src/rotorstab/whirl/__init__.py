"""How a rotor whirls under a static load, and which static load it bears.

Read `frequencies`, then `tracking` and `mode_names`, which follow and name the whirls; `campbell`
and `critical_speeds` are the diagrams; `critical_loads` holds buckling and flutter.

A whirl is a solution exp(jωt). Its signed frequency ω is positive for forward and negative for
backward precession; an imaginary part below 0 is growth.
"""
