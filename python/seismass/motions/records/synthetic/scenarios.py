"""The forty motions of the default suite, and their second components: the site-based stochastic model over classes of
event, distance and site.

Method
------
1. Two magnitudes, two distances and two sites make eight classes, of five motions each. A class gives medians: D5-95,
   the frequency of the filter, the corner of the high-pass, and the period T_S of a two-period shape. Each motion has
   its own parameters about them: the forty quantiles of a normal distribution, in an order of its own for each
   parameter (Latin hypercube). Medians, scatter and extremes of the parameters so depend on no seed.
2. White noise through the filter, modulated in intensity (`process`).
3. Two corrections of the Fourier amplitudes towards a target of the motion's own (`shaped`): the two-period shape with
   the motion's T_S, times a lognormal wander over period, times a power of the period beyond 1 s. Two corrections bring
   the course of the spectrum near the target, and leave the peaks and troughs that recorded motions have.
4. A high-pass of fourth order, as recordings are processed with; a taper, and a baseline correction that ends the
   motion at rest at its starting place.
5. A motion whose PGV/PGA or PGD/PGV is larger than that of any of the 36 FEMA P-695 far-field recordings is drawn
   again, wander and noise, with the same parameters.

Medians and spreads were chosen such that spectra, peaks, durations and effective fractions of the scaled motions agree
with those of the recordings (docs/default_suite.md). They are of no published relation, no source and no path:
"magnitude 7.2 at 30 km" says what a class is meant to be like, no more. Seeds count from `FIRST_SEED`. Six first seeds
were compared while medians and spreads were chosen, and the details by the suite of the first one; no seed was.

Second components
-----------------
A second component has the parameters of the first: duration, course of intensity, filter and high-pass, which hardly
differ between the components of a recording (Rezaeian and Der Kiureghian 2012, Earthquake Engng Struct. Dyn. 41:335).
Two things differ.

1. Its noise is that of the first times rho, and noise of its own times sqrt(1 - rho^2). Axes of instruments have no
   relation to the principal axes of the motion (Penzien and Watabe 1975), so that rho is drawn again for each pair.
2. Its target is that of the first times a lognormal level and wander over period.

The spreads were chosen such that the correlation of the accelerations and ln Sa2/Sa1 scatter as those of the 18 FEMA
P-695 far-field pairs as recorded (docs/synthetic.md). That the correlation is the same at all times and frequencies is
an assumption. Seeds count from `SECOND_FIRST_SEED`; none was chosen.
"""

from __future__ import annotations

import math
import random
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from statistics import NormalDist
from typing import Final

import numpy as np
from numpy.typing import NDArray

from seismass.base.units import STANDARD_GRAVITY
from seismass.motions.records.record import Record
from seismass.motions.records.synthetic.process import (
    MATCHED_PERIODS,
    SDS_G,
    SyntheticParameters,
    at_rest_in_the_end,
    filtered_noise,
    high_passed,
    normals,
    parameters_text,
    sample_times,
    shaped,
    spectrum,
    tapered,
)

Array = NDArray[np.float64]

STEP: Final = 0.02
"""Time step (s): the motions have nothing beyond 25 Hz, and forty of them are to be solved in seconds."""
FIRST_SEED: Final = 4000
PER_CLASS: Final = 5
CORRECTIONS: Final = 2
LARGEST_GAIN: Final = 3.0
"""Largest factor by which one correction raises or lowers an amplitude."""
QUIET: Final = 2.0
"""Time (s) before the process sets in."""

DURATIONS: Final = {(6.5, 10.0): 8.0, (6.5, 30.0): 10.0, (7.2, 10.0): 11.0, (7.2, 30.0): 15.0}
"""Median D5-95 (s) by magnitude and distance (km); the far-field recordings have 11.5 s, from 4 to 51 s."""
FREQUENCIES: Final = {"C": 5.0, "D": 3.2}
"""Median frequency of the filter (Hz) by site class."""
CORNERS: Final = {6.5: 0.17, 7.2: 0.125}
"""Median corner of the high-pass (Hz) by magnitude."""
SHAPE_PERIODS: Final = {("C", 6.5): 0.42, ("C", 7.2): 0.49, ("D", 6.5): 0.58, ("D", 7.2): 0.67}
"""Median T_S (s) of the shape by site class and magnitude."""
START, RISE = 0.45, 0.33
"""Level of the shape at a period of zero over its plateau, and period over T_S at which the plateau begins: recordings
rise from higher and later than the 0.4 and 0.2 of ASCE 7."""
DURATION_SPREAD, FREQUENCY_SPREAD, DAMPING_SPREAD, MIDDLE_SPREAD, CORNER_SPREAD = 0.45, 0.35, 0.3, 0.25, 0.4
"""Lognormal spreads of D5-95, frequency, damping of the filter, t_mid over D5-95, and corner of the high-pass."""
SHAPE_PERIOD_SPREAD, LEVEL_SPREAD, WANDER_SPREAD, WANDER_LENGTH = 0.2, 0.15, 0.36, 0.5
"""Lognormal spreads of T_S, of the level and of the wander, and the length of the wander in ln T."""
LONG_PERIOD_FALL, LONG_PERIOD_SPREAD = 0.25, 0.46
"""Power of the period by which spectra fall off beyond 1 s beside the shape, and its spread."""
DAMPING, MIDDLE, RATE, LEVEL = 0.4, 0.55, -0.016, 0.85
"""Medians of the filter's damping, t_mid over D5-95, change of frequency over frequency (1/s), level over the shape."""
LARGEST_PGV_PGA, LARGEST_PGD_PGV = 2.98, 1.02
"""Largest PGV/PGA (m/s per g) and PGD/PGV (s) of the 36 far-field recordings, which no motion exceeds."""


@dataclass(frozen=True)
class Scenario:
    """One motion: its number from 1, and the class that it belongs to."""

    number: int
    magnitude: float
    distance: float
    site: str

    @property
    def seed(self) -> int:
        """Seed of its random numbers."""
        return FIRST_SEED + self.number - 1

    @property
    def name(self) -> str:
        """The name of the motion."""
        return f"scenario-{self.number}"

    @property
    def note(self) -> str:
        """What a reader should know of it."""
        return (
            f"SYNTHETIC motion, not a recording; seed {self.seed}; as of magnitude {self.magnitude:g} at "
            f"{self.distance:g} km on site class {self.site}"
        )

    @cached_property
    def drawn(self) -> tuple[SyntheticParameters, Array, Array, Record]:
        """Parameters of the process, target (m/s2) at the matched periods, noise, and the motion that they make."""
        length, middle, rate, frequency, damping, shape, level, fall, high_pass = DRAWS[:, self.number - 1].tolist()
        d5_95 = DURATIONS[self.magnitude, self.distance] * math.exp(DURATION_SPREAD * length)
        hertz = FREQUENCIES[self.site] * math.exp(FREQUENCY_SPREAD * frequency)
        parameters = SyntheticParameters(
            arias=2.0,
            d5_95=d5_95,
            t_mid=min(max(MIDDLE * math.exp(MIDDLE_SPREAD * middle), 0.25), 2.0) * d5_95,
            frequency=hertz,
            frequency_rate=RATE * abs(rate) * hertz,
            damping=min(DAMPING * math.exp(DAMPING_SPREAD * damping), 0.8),
            corner=CORNERS[self.magnitude] * math.exp(CORNER_SPREAD * high_pass),
        )
        corner = SHAPE_PERIODS[self.site, self.magnitude] * math.exp(SHAPE_PERIOD_SPREAD * shape)
        log_period = np.log(MATCHED_PERIODS)
        long_period_slope = np.maximum(log_period, 0.0) * (LONG_PERIOD_SPREAD * fall - LONG_PERIOD_FALL)
        smooth = two_period_shape(MATCHED_PERIODS, corner) * np.exp(
            math.log(LEVEL) + LEVEL_SPREAD * level + long_period_slope
        )
        count = math.ceil((QUIET + parameters.intensity_end + 1.0 / parameters.corner) / STEP) + 1
        source = random.Random(self.seed)
        while True:
            target: Array = smooth * np.exp(WANDER_SPREAD * wander_of(source, log_period))
            noise = normals(source, count)
            record = made_of(parameters, target, noise)
            if is_within_recordings(record):
                return parameters, target, noise, record


def is_within_recordings(record: Record) -> bool:
    """Whether PGV/PGA and PGD/PGV are at most the largest that were recorded."""
    return record.pgv <= LARGEST_PGV_PGA * record.pga_g and record.pgd <= LARGEST_PGD_PGV * record.pgv


SCENARIOS: Final = tuple(
    Scenario(number, magnitude, distance, site)
    for number, (_, site, distance, magnitude) in enumerate(
        product(range(PER_CLASS), FREQUENCIES, (10.0, 30.0), CORNERS), start=1
    )
)


def quantiles_in_random_order(columns: int) -> Array:
    """Return the quantiles of the normal distribution, one for each motion, in an order of its own for each row."""
    count = len(SCENARIOS)
    source = random.Random(FIRST_SEED - 1)
    quantiles = [NormalDist().inv_cdf((i + 0.5) / count) for i in range(count)]
    # Of the methods of Random, Python promises the numbers of random() alone to be the same in all its versions.
    return np.array([sorted(quantiles, key=lambda _: source.random()) for _ in range(columns)])


DRAWS: Final = quantiles_in_random_order(9)
"""Standard normal numbers by parameter and motion."""


def generate_scenario(scenario: Scenario) -> Record:
    """Make one motion; the same on every machine to rounding, its random numbers being those of `random.Random`."""
    *_, record = scenario.drawn
    return record.replace(name=scenario.name, remarks=(scenario.note, *record.remarks))


def made_of(parameters: SyntheticParameters, target: Array, noise: Array) -> Record:
    """Make a motion of noise: filtered, modulated, brought near its target (m/s2, at the matched periods)."""
    time = sample_times(len(noise), STEP)
    process = filtered_noise(parameters, noise, STEP, start=-QUIET)
    process = process * parameters.standard_deviation(time - QUIET)
    for _ in range(CORRECTIONS):
        motion = twice_high_passed(process, parameters.corner)
        ratio = np.log(target / spectrum(motion, STEP, MATCHED_PERIODS))
        process = shaped(process, STEP, np.clip(ratio, -math.log(LARGEST_GAIN), math.log(LARGEST_GAIN)))
    motion = tapered(twice_high_passed(process, parameters.corner), time)
    return Record(
        acceleration=at_rest_in_the_end(motion, STEP),
        dt=STEP,
        event="synthetic",
        station="none",
        component="horizontal",
        synthetic=True,
        remarks=(parameters_text(parameters),),
    )


def twice_high_passed(process: Array, corner: float) -> Array:
    """Return a process that the critically damped oscillator has gone over twice: gain (f^2 / (f^2 + corner^2))^2."""
    return high_passed(high_passed(process, STEP, corner), STEP, corner)


def two_period_shape(period: Array, corner: float) -> Array:
    """Return the design spectrum of ASCE 7 (11.4.5) of S_DS = 1.07 g with T_S = `corner` (m/s2), without T_L and with
    a plateau from `RISE` T_S on.
    """
    rising = START + (1.0 - START) * period / (RISE * corner)
    shape: Array = STANDARD_GRAVITY * SDS_G * np.minimum(np.minimum(rising, 1.0), corner / period)
    return shape


def wander_of(source: random.Random, log_period: Array) -> Array:
    """Return normal numbers at knots of ln T under a Gaussian bell, divided by its standard deviation."""
    margin = 3.0 * WANDER_LENGTH
    knots = np.arange(log_period[0] - margin, log_period[-1] + margin, 0.5 * WANDER_LENGTH)
    weights = np.exp(-(((log_period[:, None] - knots) / WANDER_LENGTH) ** 2))
    wander: Array = np.sum(weights * normals(source, len(knots)), axis=1) / np.sqrt(np.sum(weights**2, axis=1))
    return wander


SECOND_FIRST_SEED: Final = 5000
CORRELATION_SPREAD: Final = 0.20
"""Standard deviation of the coefficient of correlation, whose mean is zero: recorded 0.20."""
MOST_CORRELATED: Final = 0.6
"""Largest coefficient: that of the recorded ones is 0.42."""
SECOND_LEVEL_SPREAD: Final = 0.10
"""Lognormal spread of the second component's level over the first's."""
SECOND_WANDER_SPREAD, LONG_PERIOD_GROWTH = 0.56, 0.30
"""Lognormal spread of the wander over period, at 1 s, and its growth with ln T."""


def seed_of(scenario: Scenario) -> int:
    """Return the seed of the second component of a motion."""
    return SECOND_FIRST_SEED + scenario.number - 1


def generate_second(scenario: Scenario) -> Record:
    """Make the second component of a motion; the same on every machine to rounding."""
    parameters, target, first, _ = scenario.drawn
    source = random.Random(seed_of(scenario))
    correlated, level = normals(source, 2).tolist()
    rho = max(-MOST_CORRELATED, min(CORRELATION_SPREAD * correlated, MOST_CORRELATED))
    log_period = np.log(MATCHED_PERIODS)
    growth = np.maximum(1.0 + LONG_PERIOD_GROWTH * log_period, 0.3)
    while True:
        wander = SECOND_WANDER_SPREAD * growth * wander_of(source, log_period)
        noise = rho * first + math.sqrt(1.0 - rho**2) * normals(source, len(first))
        record = made_of(parameters, target * np.exp(SECOND_LEVEL_SPREAD * level + wander), noise)
        if is_within_recordings(record):
            break
    note = f"SYNTHETIC motion, not a recording; seed {seed_of(scenario)}; second component of {scenario.name}"
    return record.replace(
        name=f"{scenario.name}-second",
        component="second horizontal",
        remarks=(note, f"noise correlated by {rho:.3f} with that of the first; {record.remarks[-1]}"),
    )
