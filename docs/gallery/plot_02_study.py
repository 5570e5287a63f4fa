"""
The paper's study
=================

A part of the parametric study of the paper: what a code's rule makes of the drift, by the mass of the goods and by R.
"""

# %%
# The whole study is ``seismass study``. Here are its buildings of three storeys.
from matplotlib.figure import Figure

import seismass as sm
from seismass.studies.study import StudyParameters, run_study

parameters = StudyParameters(buildings=((3, 0.47),))
result = run_study(sm.builtin_suite("seven"), sm.TargetSpectrum.asce7(), parameters)
first = result.summary.filter(storey=1)
print(first.select("occupancy", "R", "alpha", "underestimation_percent").head(12))

# %%
# Underestimation of the mean drift of the first storey, in per cent of the code model's, against R, by the mass of the
# goods alpha (over that of the floor). Bars are 16 to 84 % of the motions.
figure = Figure(figsize=(8.0, 3.6), layout="constrained")
panels = figure.subplots(1, 2, sharey=True)
for axes, occupancy in zip(panels, ("storage", "commercial"), strict=True):
    for place, (alpha, marker) in enumerate(((0.5, "o"), (1.0, "s"), (1.5, "^"))):
        rows = first.filter(occupancy=occupancy, alpha=alpha).sort("R")
        at = rows["R"] + 0.12 * (place - 1)
        (line,) = axes.plot(at, rows["underestimation_percent"], marker=marker, label=f"alpha = {alpha:g}")
        low, high = (rows[f"{name}_underestimation_percent"] for name in ("p16", "p84"))
        axes.vlines(at, low, high, colors=line.get_color(), alpha=0.4)
    axes.set(title=occupancy, xlabel="R")
panels[0].set(ylabel="underestimation (%)")
panels[0].legend()
figure
