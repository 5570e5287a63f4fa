"""Motions 8 to 11 of the built-in suite: the site-based stochastic model, brought near a target of their own.

Method
------
1. White noise through a filter whose frequency changes over time, modulated in intensity (`process`), after two quiet
   seconds.
2. The motion is the high-passed process plus the near-fault pulse, where there is one. The Fourier amplitudes of the
   process alone are corrected such that the spectrum of the whole comes near the motion's target (`shaping`): the two
   period shape of ASCE 7 times a smooth lognormal wander over period, so that the motions scatter as records do. Phases
   stay, and with them the course of intensity and frequency over time; the pulse stays as it is.
3. A taper and a baseline correction that ends the motion at rest at its starting place (`ends`).

The accelerations are rounded to 1e-7 g, as the files have them.
"""

from __future__ import annotations

import math
import random
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from seismass.motions.records.record import Record
from seismass.motions.records.synthetic.process import (
    LEVEL,
    LEVEL_SPREAD,
    MATCHED_PERIODS,
    SHAPE_CORRELATION,
    SHAPE_SPREAD,
    NearFaultPulse,
    SyntheticParameters,
    asce7_shape,
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

CORRECTIONS: Final = 6
LARGEST_GAIN: Final = 3.0
"""Largest factor by which one correction raises or lowers an amplitude."""

QUIET: Final = 2.0
"""Time (s) before the process sets in, for the slow precursors of filters without phase."""

KNOTS: Final = 0.5 * SHAPE_CORRELATION
"""Distance in ln T of the normal numbers that the wander is made of."""


@dataclass(frozen=True)
class SiteRecipe:
    """What makes one motion: seed, step and duration (s), and the parameters, whose clock starts after 2 s."""

    number: int
    seed: int
    dt: float
    duration: float
    parameters: SyntheticParameters

    @property
    def name(self) -> str:
        """The name of the motion and of its file."""
        return f"synthetic-{self.number}"

    @property
    def note(self) -> str:
        """What a reader should know of it, in a few words."""
        pulse = self.parameters.pulse
        text = "no pulse" if pulse is None else f"velocity pulse of {pulse.period:g} s"
        return f"SYNTHETIC motion {self.number}: not a recording; seed {self.seed}; {text}"


SITE_RECIPES: Final = (
    SiteRecipe(
        8,
        8000,
        0.005,
        30.0,
        SyntheticParameters(2.0, 8.0, 5.0, 4.0, -0.15, 0.35, 0.25, NearFaultPulse(2.2, 0.5, 4.5)),
    ),
    SiteRecipe(9, 9069, 0.01, 50.0, SyntheticParameters(2.5, 20.0, 13.0, 3.5, -0.05, 0.4, 0.15)),
    SiteRecipe(
        10,
        10055,
        0.005,
        38.0,
        SyntheticParameters(2.5, 12.0, 8.0, 3.0, -0.1, 0.3, 0.25, NearFaultPulse(3.4, 0.5, 7.0)),
    ),
    SiteRecipe(11, 11007, 0.01, 45.0, SyntheticParameters(2.5, 17.0, 10.0, 4.0, -0.1, 0.45, 0.15)),
)


def generate_site(recipe: SiteRecipe) -> Record:
    """Make one motion; the same on every machine to rounding, its random numbers being those of `random.Random`."""
    parameters = recipe.parameters
    source = random.Random(recipe.seed)
    time = sample_times(round(recipe.duration / recipe.dt) + 1, recipe.dt)
    target = _target(source)
    process = filtered_noise(parameters, normals(source, len(time)), recipe.dt, start=-QUIET)
    process = process * parameters.standard_deviation(time - QUIET)
    pulse = np.zeros(len(time)) if parameters.pulse is None else parameters.pulse.acceleration(time - QUIET)
    for _ in range(CORRECTIONS):
        motion = high_passed(process, recipe.dt, parameters.corner) + pulse
        ratio = np.log(target / spectrum(motion, recipe.dt, MATCHED_PERIODS))
        process = shaped(process, recipe.dt, np.clip(ratio, -math.log(LARGEST_GAIN), math.log(LARGEST_GAIN)))
    motion = tapered(high_passed(process, recipe.dt, parameters.corner) + pulse, time)
    return Record(
        acceleration=at_rest_in_the_end(motion, recipe.dt),
        dt=recipe.dt,
        name=recipe.name,
        event="synthetic",
        station="none",
        component="horizontal",
        synthetic=True,
        remarks=(recipe.note, parameters_text(parameters)),
    )


def _target(source: random.Random) -> Array:
    """Return a motion's own target at the matched periods: the shape times a lognormal wander, normal numbers at knots
    of ln T under a Gaussian bell of the correlation length over sqrt 2, scaled to unit deviation.
    """
    log_period = np.log(MATCHED_PERIODS)
    margin = 3.0 * SHAPE_CORRELATION
    knots = np.arange(log_period[0] - margin, log_period[-1] + margin, KNOTS)
    weights = np.exp(-(((log_period[:, None] - knots) / SHAPE_CORRELATION) ** 2))
    drawn = normals(source, len(knots))
    wander = SHAPE_SPREAD * np.sum(weights * drawn, axis=1) / np.sqrt(np.sum(weights**2, axis=1))
    level = LEVEL * math.exp(LEVEL_SPREAD * float(normals(source, 1)[0]))
    target: Array = level * asce7_shape(MATCHED_PERIODS) * np.exp(wander)
    return target
