"""
The paper's study
=================

A part of the parametric study of the paper: what a code's rule makes of the drift, by the mass of the goods and by R.
"""

# %%
# The whole study is ``seismass study``. Here are its buildings of three storeys.
import seismass as sm
from seismass.report.findings import findings, findings_text
from seismass.study import StudyParameters, run_study

parameters = StudyParameters(buildings=((3, 0.47),))
result = run_study(sm.builtin_suite("seven"), sm.TargetSpectrum.asce7(), parameters)
first = result.summary.filter(storey=1)
print(first.select("occupancy", "R", "alpha", "underestimation_percent").head(12))
