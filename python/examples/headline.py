"""The bias of the reference coil under the paper's profile, and its sensitivity by part: a notebook as a script.

Run it cell by cell in an editor or Jupyter, or as a whole: `python headline.py FOLDER` writes `headline.svg` and `headline.png` there; without a folder
nothing is written.
"""

# %% The design and the paper's profile
from __future__ import annotations

import sys
from pathlib import Path

import matplotlib
import numpy as np

import fogcoil

# a notebook has arguments of its own
folder = Path(sys.argv[1]) if len(sys.argv) == 2 and "ipykernel" not in sys.modules else None
if folder is not None and not folder.is_dir():
    sys.exit(f"{folder}: is no folder; make it, or give another")
fixtures = Path(__file__).resolve().parents[2] / "fixtures"
coil = fogcoil.Coil(fixtures / "coil-reference.ron")
profile = np.genfromtxt(fixtures / "profiles" / "paper.csv", delimiter=",", names=True)

# %% Bias in time, and in a steady ramp
result = fogcoil.simulate(coil, profile["time_s"], profile["chamber_c"])
ramp = fogcoil.sensitivity(coil)
print(f"sensitivity {ramp['total']:.4f} +- {ramp['error_estimate']:.4f} (deg/h)/(degC/min)")

# %% A sweep: designs side by side, two threads
from concurrent.futures import ThreadPoolExecutor  # noqa: E402

thickness = np.linspace(2.0, 8.0, 7)
with ThreadPoolExecutor() as pool:
    hubs = pool.map(lambda mm: fogcoil.sensitivity(coil.replace({"spool.hub_thickness_mm": mm, "sensor.radius_mm": 43.5 - mm})), thickness)
    totals = np.array([hub["total"] for hub in hubs])

# %% The picture
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

plt.rcParams.update({"font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "svg.hashsalt": "fogcoil"})
figure = plt.figure(figsize=(9.0, 6.0), layout="constrained")
grid = figure.add_gridspec(2, 2, height_ratios=(1, 2.2), width_ratios=(2.6, 1))
hours = result["time_s"] / 3600

chamber = figure.add_subplot(grid[0, 0])
chamber.plot(hours, result["chamber_c"], color="0.6", label="chamber")
chamber.plot(hours, result["spool_c"], color="black", label="spool")
chamber.set_ylabel("temperature [°C]")
chamber.tick_params(labelbottom=False)
chamber.legend(frameon=False)

bias = figure.add_subplot(grid[1, 0], sharex=chamber)
parts = {"shupe": "Shupe", "eo_axial": "axial strain", "eo_radial": "radial strain"}
for key, label in parts.items():
    bias.plot(hours, result[f"{key}_deg_per_h"], linewidth=1, label=label)
bias.plot(hours, result["rate_deg_per_h"], color="black", linewidth=1.5, label="sum")
bias.set_xlabel("time [h]")
bias.set_ylabel("bias [°/h]")
bias.legend(frameon=False, ncols=2)

bars = figure.add_subplot(grid[0, 1])
names = [*parts.values(), "sum"]
values = [ramp["shupe"], ramp["eo_axial"], ramp["eo_radial"], ramp["total"]]
bars.barh(names, values, color=["C0", "C1", "C2", "black"])
bars.axvline(0, color="0.6", linewidth=0.8)
bars.invert_yaxis()
bars.set_title(f"in a steady ramp: {ramp['total']:.4f} ± {ramp['error_estimate']:.4f}", fontsize=9, loc="right")
bars.set_xlabel("(°/h)/(°C/min)")

sweep = figure.add_subplot(grid[1, 1])
sweep.plot(thickness, totals, "o-", color="black", markersize=4)
sweep.axvline(float(coil["spool.hub_thickness_mm"]), color="0.6", linewidth=0.8)
sweep.set_xlabel("thickness of the hub [mm]")
sweep.set_ylabel("sensitivity [(°/h)/(°C/min)]")

if folder is not None:
    figure.savefig(folder / "headline.svg")
    figure.savefig(folder / "headline.png", dpi=150)
figure
