"""Stability over the whole plane of pulsating load and excitation frequency, and its margins.

`stability_map` computes growth rates on a grid with `solved_grid`, and `work` how much work that
takes. `grid_edges` finds the edges of what is unstable between the points of the grid, with
`thin_tongues` that it does not see. `margin` computes the smallest load that destabilises.
"""
