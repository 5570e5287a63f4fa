"""
One's own warehouse
===================

The share of the live load to count as mass, for the warehouse of four storeys that ships with the package.
"""

# %%
# A building file states the building, its goods, its site and its code. ``seismass building --example`` prints this
# one.
import seismass as sm
from seismass.assessment.building_file import example_file

answer = sm.assess(example_file())
print(answer.text)

# %%
# The figures are those of the page that ``seismass building`` writes.
figures = answer.figures()
figures["effective_fraction"]

# %%
# Drifts with sliding goods, with the recommended share, the code's share, all and none attached:
figures["drift"]
