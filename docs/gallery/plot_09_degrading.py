"""
A degrading storey
==================

A peak-oriented storey that softens and loses strength with the energy it dissipates: driven slowly, and in an
earthquake.
"""

# %%
import numpy as np
from matplotlib.figure import Figure

import seismass as sm

building = sm.Building(
    mass=2e4,
    stiffness=2e6,
    yield_shear=6e4,
    hysteresis="peak-oriented",
    overstrength=1.2,
    second_slope=0.05,
    third_slope=-0.03,
    unloading_exponent=0.4,
    energy_capacity=60.0,
    residual_strength=0.3,
)
turns = 0.03 * np.array([1, -1, 2, -2, 3, -3, 4, -4, 5, -5, 0])
drifts = np.concatenate([np.linspace(a, b, 60) for a, b in zip([0.0, *turns[:-1]], turns, strict=True)])
path = sm.runs.spring_forces(building, 1, drifts)
figure = Figure(figsize=(6.0, 4.0), layout="constrained")
axes = figure.subplots()
axes.plot(1e3 * drifts, 1e-3 * path.force)
axes.set(xlabel="drift (mm)", ylabel="shear (kN)")
figure

# %%
# The same storey with goods that slide, under a motion:
scene = sm.Scene(building, [sm.Block(1, mass=1e4, mu=0.3)])
response = sm.simulate(scene, sm.builtin_record("synthetic-3").scaled(1.5), histories=True)
response.plot.loops()
