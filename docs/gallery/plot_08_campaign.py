"""
A study on a cluster
====================

A campaign is a folder. Its parts are solved by threads, by workers, or by jobs of an array, and any of them goes on
where another one stopped.
"""

# %%
from tempfile import TemporaryDirectory

import polars as pl
from matplotlib.figure import Figure

import seismass as sm

building = sm.Building.uniform(3, 0.47, yield_shear_over_weight=[0.34, 0.27, 0.13], heights=3.5)
grid = sm.Grid.sample(
    building,
    samples=512,
    seed=1,
    roof="bare",
    mass_ratio=1.0,
    occupancy=sm.distributions.beta(0.7, 0.15),
    mu=sm.distributions.lognormal(0.3, 0.25),
)
campaign = sm.campaign.Campaign(grid, sm.builtin_suite("seven"), part_runs=512, peaks_only=True)
campaign

# %%
# Two jobs of an array of two; on a cluster each is a process of its own. ``campaign.run(folder, workers=4)`` starts
# workers of dask, ``scheduler="tcp://head:8786"`` takes those of a running scheduler.
place = TemporaryDirectory()
for job in (1, 2):
    folder = campaign.run(place.name, shard=(job, 2))
folder

# %%
# Results are read lazily, with what varies joined to them.
rows = folder.scan().select(
    "mu_s",
    "occupancy",
    drift=100.0 * pl.col("peak_drift_ratio").list.max(),
    slip=1e3 * pl.col("peak_slip").list.max(),
)
table = rows.collect()
print(table.describe(percentiles=(0.16, 0.5, 0.84)))

# %%
figure = Figure(figsize=(8.0, 3.6), layout="constrained")
left, right = figure.subplots(1, 2)
for axes, name, label in ((left, "drift", "peak drift (% of the height)"), (right, "slip", "peak slip (mm)")):
    points = axes.scatter(table["mu_s"], table[name], c=table["occupancy"], s=3)
    axes.set(xlabel="friction coefficient", ylabel=label)
figure.colorbar(points, label="occupancy")
figure
