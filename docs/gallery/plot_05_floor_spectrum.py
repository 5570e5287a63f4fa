"""
Floor spectra
=============

What the equipment on a floor feels while the goods around it slide.
"""

# %%
import seismass as sm

building = sm.Building.uniform(3, 0.47, yield_shear_over_weight=[0.34, 0.27, 0.13], heights=3.5)
scene = sm.Scene(building, sm.blocks_on_floors([1.0, 1.0, 0.0], mu=0.2))
record = sm.builtin_record("synthetic-1").scaled(1.5)
response = sm.simulate(scene, record, histories=True)
response.plot.floor_spectra()

# %%
# The same building with all goods attached as mass:
attached = sm.simulate(sm.attached_scene(scene, 1.0), record, histories=True)
attached.plot.floor_spectra()
