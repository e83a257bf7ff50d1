"""Stability over the whole plane of pulsating load and excitation frequency, and its margins.

`stability_map` computes growth rates on a grid and `work` how much work that takes;
`tongue_outlines` finds the edges of what is unstable, `margin` the smallest load that destabilises.
"""
