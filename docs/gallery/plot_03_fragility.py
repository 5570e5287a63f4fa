"""
Fragility: what a rule does to the probability of exceeding a limit
===================================================================

Motions are scaled until a limit is exceeded, for the building with sliding goods and for the models of a code.
"""

# %%
import seismass as sm

building = sm.Building.uniform(3, 0.47, yield_shear_over_weight=[0.34, 0.27, 0.13], heights=3.5)
scene = sm.Scene(building, sm.blocks_on_floors([1.0, 1.0, 0.0], mu=0.2))
limit = sm.fragility.LimitState("drift_ratio", 0.02)
answer = sm.fragility.incremental_dynamic_analysis(scene, sm.builtin_suite("eleven"), [limit])
print(answer.text)

# %%
# Fragility curves with their intervals over the motions:
answer.plot()

# %%
# Demand against intensity, with fractiles:
answer.plot(answer.figure_names[1])
