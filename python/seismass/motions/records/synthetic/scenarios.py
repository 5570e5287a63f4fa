"""The forty motions of the default suite: the site-based stochastic model over classes of event, distance and site.

Method
------
1. Two magnitudes, two distances and two sites make eight classes, of five motions each. A class gives medians: D5-95,
   the frequency of the filter, the corner of the high-pass, and the period T_S of a two-period shape. Each motion draws
   its own parameters about them.
2. White noise through the filter, modulated in intensity (`process`).
3. Two corrections of the Fourier amplitudes towards a target of the motion's own (`shaping`): the two-period shape with
   the motion's T_S, times a lognormal wander over period, times a power of the period beyond 1 s. Two corrections bring
   the course of the spectrum near the target, and leave the peaks and troughs that recorded motions have.
4. A taper and a baseline correction that ends the motion at rest at its starting place (`ends`).

The medians and spreads were chosen such that the scatter of the scaled spectra, and the effective fractions of many
buildings, agree with those of the FEMA P-695 far-field recordings (docs/synthetic.md). They are of no published
relation, no source and no path: "magnitude 7.2 at 30 km" says what a class is meant to be like, no more. Seeds count
from `FIRST_SEED`; none was chosen.
"""

from __future__ import annotations

import math
import random
from dataclasses import dataclass
from functools import cached_property
from itertools import product
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

DURATIONS: Final = {(6.5, 10.0): 8.0, (6.5, 30.0): 11.0, (7.2, 10.0): 12.0, (7.2, 30.0): 17.0}
"""Median D5-95 (s) by magnitude and distance (km); the far-field recordings have 11.5 s, from 4 to 51 s."""
FREQUENCIES: Final = {"C": 5.0, "D": 3.2}
"""Median frequency of the filter (Hz) by site class."""
CORNERS: Final = {6.5: 0.15, 7.2: 0.1}
"""Corner of the high-pass (Hz) by magnitude."""
SHAPE_PERIODS: Final = {("C", 6.5): 0.39, ("C", 7.2): 0.45, ("D", 6.5): 0.58, ("D", 7.2): 0.67}
"""Median T_S (s) of the shape by site class and magnitude."""
DURATION_SPREAD, FREQUENCY_SPREAD, DAMPING_SPREAD, MIDDLE_SPREAD = 0.4, 0.35, 0.3, 0.25
"""Lognormal spreads of D5-95, frequency, damping of the filter, and t_mid over D5-95."""
SHAPE_PERIOD_SPREAD, LEVEL_SPREAD, WANDER_SPREAD, WANDER_LENGTH = 0.25, 0.15, 0.4, 0.5
"""Lognormal spreads of T_S, of the level and of the wander, and the length of the wander in ln T."""
LONG_PERIOD_FALL, LONG_PERIOD_SPREAD = 0.25, 0.45
"""Power of the period by which spectra fall off beyond 1 s beside the shape, and its spread."""
DAMPING, MIDDLE, RATE, LEVEL = 0.4, 0.55, -0.016, 0.85
"""Medians of the filter's damping, t_mid over D5-95, change of frequency over frequency (1/s), level over the shape."""


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
    def drawn(self) -> tuple[SyntheticParameters, Array, random.Random]:
        """Parameters of the process, target (m/s2) at the matched periods, and the source of further numbers."""
        source = random.Random(self.seed)
        length, middle, rate, frequency, damping, shape, level, fall = normals(source, 8).tolist()
        d5_95 = DURATIONS[self.magnitude, self.distance] * math.exp(DURATION_SPREAD * length)
        hertz = FREQUENCIES[self.site] * math.exp(FREQUENCY_SPREAD * frequency)
        parameters = SyntheticParameters(
            arias=2.0,
            d5_95=d5_95,
            t_mid=min(max(MIDDLE * math.exp(MIDDLE_SPREAD * middle), 0.25), 2.0) * d5_95,
            frequency=hertz,
            frequency_rate=RATE * abs(rate) * hertz,
            damping=min(DAMPING * math.exp(DAMPING_SPREAD * damping), 0.8),
            corner=CORNERS[self.magnitude],
        )
        corner = SHAPE_PERIODS[self.site, self.magnitude] * math.exp(SHAPE_PERIOD_SPREAD * shape)
        log_period = np.log(MATCHED_PERIODS)
        long_period_slope = np.maximum(log_period, 0.0) * (LONG_PERIOD_SPREAD * fall - LONG_PERIOD_FALL)
        target: Array = two_period_shape(MATCHED_PERIODS, corner) * np.exp(
            math.log(LEVEL) + LEVEL_SPREAD * level + WANDER_SPREAD * wander_of(source, log_period) + long_period_slope
        )
        return parameters, target, source


SCENARIOS: Final = tuple(
    Scenario(number, magnitude, distance, site)
    for number, (_, site, distance, magnitude) in enumerate(
        product(range(PER_CLASS), FREQUENCIES, (10.0, 30.0), CORNERS), start=1
    )
)


def generate_scenario(scenario: Scenario) -> Record:
    """Make one motion; the same on every machine to rounding, its random numbers being those of `random.Random`."""
    parameters, target, _ = scenario.drawn
    record = made_of(parameters, target, noise_of(scenario))
    return record.replace(name=scenario.name, remarks=(scenario.note, *record.remarks))


def noise_of(scenario: Scenario) -> Array:
    """Return the white noise of a motion, one standard normal number for each of its samples."""
    parameters, _, source = scenario.drawn
    # The source continues after the draws of the parameters; its state is restored for the next call.
    state = source.getstate()
    noise = normals(source, math.ceil((QUIET + parameters.intensity_end + 1.0 / parameters.corner) / STEP) + 1)
    source.setstate(state)
    return noise


def made_of(parameters: SyntheticParameters, target: Array, noise: Array) -> Record:
    """Make a motion of noise: filtered, modulated, brought near its target (m/s2, at the matched periods)."""
    time = sample_times(len(noise), STEP)
    process = filtered_noise(parameters, noise, STEP, start=-QUIET)
    process = process * parameters.standard_deviation(time - QUIET)
    for _ in range(CORRECTIONS):
        motion = high_passed(process, STEP, parameters.corner)
        ratio = np.log(target / spectrum(motion, STEP, MATCHED_PERIODS))
        process = shaped(process, STEP, np.clip(ratio, -math.log(LARGEST_GAIN), math.log(LARGEST_GAIN)))
    motion = tapered(high_passed(process, STEP, parameters.corner), time)
    return Record(
        acceleration=at_rest_in_the_end(motion, STEP),
        dt=STEP,
        event="synthetic",
        station="none",
        component="horizontal",
        synthetic=True,
        remarks=(parameters_text(parameters),),
    )


def two_period_shape(period: Array, corner: float) -> Array:
    """Return the ASCE 7 design spectrum (11.4.5) of S_DS = 1.07 g with T_S = `corner` (m/s2), without T_L."""
    rising = 0.4 + 0.6 * period / (0.2 * corner)
    shape: Array = STANDARD_GRAVITY * SDS_G * np.minimum(np.minimum(rising, 1.0), corner / period)
    return shape


def wander_of(source: random.Random, log_period: Array) -> Array:
    """Return normal numbers at knots of ln T under a Gaussian bell, divided by its standard deviation."""
    margin = 3.0 * WANDER_LENGTH
    knots = np.arange(log_period[0] - margin, log_period[-1] + margin, 0.5 * WANDER_LENGTH)
    weights = np.exp(-(((log_period[:, None] - knots) / WANDER_LENGTH) ** 2))
    wander: Array = np.sum(weights * normals(source, len(knots)), axis=1) / np.sqrt(np.sum(weights**2, axis=1))
    return wander
