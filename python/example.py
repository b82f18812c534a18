"""The figures a researcher wants from a run.  Cells begin with # %%: run it whole, or cell by cell in an editor.

    python3 example.py runs/first [figures]

Needs numpy and matplotlib.  Figures go into the second folder, the run's own when it is not given.
"""
# %% The run
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import EllipseCollection

import livebed

run = livebed.Run(sys.argv[1])
figures = Path(sys.argv[2] if len(sys.argv) > 2 else run.folder)
figures.mkdir(parents=True, exist_ok=True)
T = run.case["derived"]["time"]["scale"]  # time scale of the scour [s]
x_pipe, y_pipe, D = run.pipe
level = run.case["bed"]["level"]  # of the bed at rest [m]


def save(figure, name):
    figure.savefig(figures / f"{name}.png", dpi=150, bbox_inches="tight")
    plt.close(figure)


# %% How deep, how soon: S/D over t/T
series = run.series
figure, axes = plt.subplots()
axes.plot(series["time_s"] / T, series["S_over_D"], label="deepest")
axes.plot(series["time_s"] / T, series["depth_under_pipe_over_D"], label="under the pipe")
axes.set(xlabel="t/T", ylabel="S/D", title=run.case["case"]["title"])
axes.legend()
save(figure, "depth")

# %% The bed at some times
bed = run.bed
figure, axes = plt.subplots()
for time in np.linspace(0, bed.t[-1], 5):
    axes.plot((bed.x - x_pipe) / D, (bed.at(time) - level) / D, label=f"t/T = {time / T:.2g}")
axes.add_patch(plt.Circle((0, (y_pipe - level) / D), 0.5, fill=False))
axes.set(xlabel="x/D", ylabel="y/D", aspect="equal")
axes.legend(fontsize="small", ncols=5, loc="upper center", bbox_to_anchor=(0.5, -0.25))
save(figure, "bed")

# %% The bed in space and time
figure, axes = plt.subplots()
change = (bed.y - bed.y[0]) / D
most = np.abs(change).max()
picture = axes.pcolormesh((bed.x - x_pipe) / D, bed.t / T, change, cmap="RdBu_r", vmin=-most, vmax=most, shading="nearest")
figure.colorbar(picture, label="change of the bed / D")
axes.set(xlabel="x/D", ylabel="t/T")
save(figure, "space-time")

# %% Grains and water at one moment
time = run.grain_times[len(run.grain_times) // 2]
water, grains = run.flow(time), run.grains(time)
figure, axes = plt.subplots(figsize=(12, 5))
speed = np.ma.masked_where(water.open < 0.5, water.speed)
picture = axes.pcolormesh(water.x, water.y, speed, cmap="viridis")
figure.colorbar(picture, label="speed of the water [m/s]")
discs = EllipseCollection(grains.diameter, grains.diameter, 0, units="xy", offsets=np.column_stack([grains.x, grains.y]),
                          offset_transform=axes.transData, array=grains.speed, cmap="copper")
axes.add_collection(discs)
figure.colorbar(discs, label="speed of the grains [m/s]")
axes.add_patch(plt.Circle((x_pipe, y_pipe), D / 2, color="grey"))
axes.set(xlabel="x [m]", ylabel="y [m]", aspect="equal", title=f"t = {water.time:.3g} s")
save(figure, "moment")

# %% The moving grains under the gap: number of them and mean speed by height
under = np.abs(grains.x - x_pipe) < D / 2
edges = np.arange(0, y_pipe - D / 2 + 1e-9, grains.diameter.mean())
if edges.size > 1:
    layer = np.digitize(grains.y[under], edges) - 1
    speeds = [grains.velocity[under, 0][layer == n].mean() if (layer == n).any() else np.nan for n in range(edges.size - 1)]
    figure, axes = plt.subplots()
    axes.plot(speeds, (edges[1:] + edges[:-1]) / 2 - level, marker="o")
    axes.set(xlabel="mean velocity along the current [m/s]", ylabel="height above the original bed [m]",
             title=f"grains under the pipe, t = {grains.time:.3g} s")
    save(figure, "under-the-gap")

# %% Numbers
if (run.folder / "summary.json").is_file():
    for name in ("scour_depth_over_D", "S_eq_over_D", "T_s", "theta_measured"):
        print(name, "=", run.summary[name])
