# %% [markdown]
# # Any rotor in ten lines: ROSS file → map → figure
# Where does a pulsating thrust destabilise the rotor of a ROSS file? ROSS need not be installed.
# Run it with `python examples/any_rotor.py`, or cell by cell in an editor or as a notebook.

# %%
from pathlib import Path

import numpy as np

from rotorstab import Rotor, bolotin_chart, fundamental_frequency, stability_chart
from rotorstab.charts import GrowthGrid, chart_figure, instability_chart
from rotorstab.drawing.printed import figure_files

FILE = Path(__file__).parent / "overhung_rotor.toml"

# %% The rotor at 400 rad/s: one finite element for each of the file, four coordinates of each plane
rotor = Rotor.from_ross(FILE, spin_speed=400.0)
system = rotor.system(spin_speed=400.0, elements=1, modes=4)
buckling, frequency = rotor.critical_load(), fundamental_frequency(system)  # N, rad/s
print(f"buckling load {buckling / 1e3:.1f} kN, first natural frequency {frequency:.1f} rad/s")

# %% The map over θ/ω_n and β_d: a fifth of the buckling load is steady
window = (1.3, 2.4, 0.0, 0.5)
ratios, factors = np.linspace(1.3, 2.4, 67), np.linspace(0.0, 0.5, 11)
found = stability_chart(
    system, 0.2 * buckling, factors * buckling, ratios * frequency, density=0.5, edges=True
)
print(f"{found.unstable.mean():.1%} of the map is unstable")

# %% The picture, for print; `chart.plot()` shows it in a notebook
grid = GrowthGrid(
    found.peak_growth, found.unstable, None, window, edges=found.edges, rates=found.growth
)
regions = bolotin_chart(system, 0.2 * buckling, 0.5 * buckling)
chart = instability_chart(regions, frequency, buckling, window[:2], window[2:], grid)
Path("any_rotor.pdf").write_bytes(figure_files(chart_figure(chart, {}), ["pdf"])["pdf"])
