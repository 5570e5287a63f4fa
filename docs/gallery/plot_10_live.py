"""
The live page
=============

The kernel, compiled to WebAssembly, solves a building while a slider moves. ``seismass explore`` writes the page. Where
the site was built with the compiled kernel, it is below.

.. raw:: html
   :file: ../_build_live.html
"""

# %%
# A link to the page holds the case. "Download scene file" gives the scene for ``seismass run``, with the same numbers.
# Here is a case like the one that the page opens with, from Python:
import seismass as sm

suite = sm.builtin_suite("seven")
factors = sm.scaling.scale_asce7_10(suite, sm.TargetSpectrum.asce7()).factors
building = sm.Building.uniform(3, 0.47, yield_shear_over_weight=[0.341, 0.265, 0.134], heights=3.5)
scene = sm.Scene(building, sm.blocks_on_floors([1.0, 1.0, 0.0], mu=0.2))
response = sm.simulate(scene, suite[0].scaled(factors[0]), histories=True)
response.plot.profile()
