"""
A chart for a code committee
============================

The effective fraction of many buildings against eta, the friction coefficient over the base shear coefficient of the
building with all goods attached.
"""

# %%
# The published chart has 4928 buildings under 36 recordings; this one has some hundred under seven synthetic motions.
import seismass as sm

parameters = sm.EffectiveMassParameters(
    buildings=((3, 0.47, "bare"),),
    mass_ratios=(0.5, 1.0, 1.5),
    response_modification=(1.0, 2.0, 4.0),
    mus=(0.1, 0.15, 0.2, 0.3, 0.4, 0.6),
)
chart = sm.effective_mass_map(sm.builtin_suite("seven"), sm.TargetSpectrum.asce7(), parameters)
print(chart.rules())

# %%
chart.plot()
