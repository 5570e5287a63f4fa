"""Second horizontal components of the forty, whose correlation and spectra differ as those of recorded pairs do.

Method
------
A second component has the parameters of the first: duration, course of intensity, filter and high-pass, which hardly
differ between the components of a recording (Rezaeian and Der Kiureghian 2012, Earthquake Engng Struct. Dyn. 41:335).
Two things differ.

1. Its noise is that of the first times rho, and noise of its own times sqrt(1 - rho^2). Axes of instruments have no
   relation to the principal axes of the motion (Penzien and Watabe 1975), so that rho is drawn again for each pair.
2. Its target is that of the first times a lognormal level and wander over period.

One whose PGV/PGA or PGD/PGV is larger than that of any far-field recording is drawn again, as the first ones are.
The spreads were chosen such that the correlation of the accelerations and ln Sa2/Sa1 scatter as those of the 18 FEMA
P-695 far-field pairs as recorded (docs/synthetic.md). That the correlation is the same at all times and frequencies is
an assumption. Seeds count from `FIRST_SEED`; none was chosen.
"""

from __future__ import annotations

import math
import random
from typing import Final

import numpy as np

from seismass.motions.records.record import Record
from seismass.motions.records.synthetic.process import MATCHED_PERIODS, normals
from seismass.motions.records.synthetic.scenarios import Scenario, is_within_recordings, made_of, wander_of

FIRST_SEED: Final = 5000
CORRELATION_SPREAD: Final = 0.20
"""Standard deviation of the coefficient of correlation, whose mean is zero: recorded 0.20."""
MOST_CORRELATED: Final = 0.6
"""Largest coefficient: that of the recorded ones is 0.42."""
LEVEL_SPREAD: Final = 0.10
"""Lognormal spread of the second component's level over the first's."""
WANDER_SPREAD, LONG_PERIOD_GROWTH = 0.56, 0.30
"""Lognormal spread of the wander over period, at 1 s, and its growth with ln T."""


def seed_of(scenario: Scenario) -> int:
    """Return the seed of the second component of a motion."""
    return FIRST_SEED + scenario.number - 1


def generate_second(scenario: Scenario) -> Record:
    """Make the second component of a motion; the same on every machine to rounding."""
    parameters, target, first, _ = scenario.drawn
    source = random.Random(seed_of(scenario))
    correlated, level = normals(source, 2).tolist()
    rho = max(-MOST_CORRELATED, min(CORRELATION_SPREAD * correlated, MOST_CORRELATED))
    log_period = np.log(MATCHED_PERIODS)
    growth = np.maximum(1.0 + LONG_PERIOD_GROWTH * log_period, 0.3)
    while True:
        wander = WANDER_SPREAD * growth * wander_of(source, log_period)
        noise = rho * first + math.sqrt(1.0 - rho**2) * normals(source, len(first))
        record = made_of(parameters, target * np.exp(LEVEL_SPREAD * level + wander), noise)
        if is_within_recordings(record):
            break
    note = f"SYNTHETIC motion, not a recording; seed {seed_of(scenario)}; second component of {scenario.name}"
    return record.replace(
        name=f"{scenario.name}-second",
        component="second horizontal",
        remarks=(note, f"noise correlated by {rho:.3f} with that of the first; {record.remarks[-1]}"),
    )
