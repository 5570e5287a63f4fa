"""
A Rust program
==============

The kernel is a crate without Python. This is ``crates/seismass/examples/warehouse.rs``; the tests run it with
``cargo run --example warehouse`` and compare what it prints.

.. literalinclude:: ../../crates/seismass/examples/warehouse.rs
   :language: rust
"""

# %%
# The same scene from Python gives the same numbers.
import numpy as np

import seismass as sm

building = sm.Building.uniform(3, 0.6, mass=1e5, yield_shear_over_weight=[0.24, 0.20, 0.12])
goods = [sm.Block(floor, mass=1e5, mu=0.3) for floor in (1, 2)]
samples = 5.0 * np.sin(0.1 * np.arange(1000)) * np.exp(-0.002 * np.arange(1000))
response = sm.simulate(sm.Scene(building, goods), sm.Motion(samples, 0.01), histories=True)
print("drift (mm):", np.round(1e3 * response.peak_drift, 6))
print("slip (mm): ", np.round(1e3 * response.peak_slip, 6))

# %%
response.plot.drift()
