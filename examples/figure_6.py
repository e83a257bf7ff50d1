# %% [markdown]
# # Figure 6 in ten lines
# Bolotin regions of the paper's rotor under an axial load: effect of the static load factor.
# Run it with `python examples/figure_6.py`, or cell by cell in an editor or as a notebook.

# %%
from pathlib import Path

import numpy as np

from rotorstab.drawing.printed import figure_files
from rotorstab.paper import figure_6

figure = figure_6(spin_speeds=(0.0, 1.0, 2.0), static_factors=(0.0, 0.2, 0.5))

# %% What the text says of it, and what these numbers show
for statement in figure.reading:
    print(f"{statement.verdict}: {statement.text}\n  {statement.ours}")

# %% First region without spin at β_d = 0.5: left and right boundary
for line in figure.panel("a").group("α_s = 0")[:2]:
    print(f"{line.name}: θ/ω_n = {np.interp(0.5, line.y, line.x):.5f}")

# %% The picture, for print
Path("figure_6.pdf").write_bytes(figure_files(figure, ["pdf"])["pdf"])
