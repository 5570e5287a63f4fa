"""What the two methods share: velocities of two components, the scales searched, and the pulse of ten wavelets.

The algorithm is that of Shahi and Baker (2014), Bulletin of the Seismological Society of America 104:2456.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from scipy.integrate import cumulative_trapezoid

from seismass._values import FloatArray, brief, refusal
from seismass.errors import InvalidMotion
from seismass.pulses.wavelet import PERIOD_OF_SCALE, coefficient, transform_near, wavelet_history
from seismass.records.record import Record

SHORTEST_PERIOD: Final = 0.25
"""Shortest pulse period that is looked for (s)."""
LONGEST_PERIOD: Final = 15.0
"""Longest pulse period that is looked for (s)."""
STEPS_OF_SCALE: Final = 50
"""Scales searched are this many and one more."""
WAVELETS: Final = 10
"""Wavelets of one scale whose sum is the pulse."""
REFINEMENTS: Final = 201
"""Scales at most that are tried between two of the search: every one for steps above 2 ms, as in the papers' code."""
NEIGHBOURHOOD: Final = 0.4
"""Further wavelets of a pulse, and no other candidate, are within this many scales of its first wavelet."""
LENGTHS_OF_THE_CODE: Final = 20
"""The code of Shahi and Baker leaves out pairs whose lengths differ by more samples."""
CENTIMETRES: Final = 100.0
"""Velocities in cm/s, the unit of both methods' constants, over those in m/s."""
_SQUARE: Final = 1.0
"""Two components are at right angles within this (degrees)."""


@dataclass(frozen=True, eq=False)
class Horizontals:
    """Two perpendicular horizontal velocities of one length.

    Attributes
    ----------
    names : tuple of str
        Names of the two records.
    velocities : tuple of ndarray, shape (samples,)
        The two velocities (m/s).
    dt : float
        Time step (s).
    azimuths : tuple of float, optional
        Directions of the two (degrees from north), where both records state them.
    remarks : tuple of str
        What was done to make them of one length.
    """

    names: tuple[str, str]
    velocities: tuple[FloatArray, FloatArray]
    dt: float
    azimuths: tuple[float, float] | None
    remarks: tuple[str, ...]

    def towards(self, angle: float) -> FloatArray:
        """Return the velocity (m/s) along a direction `angle` radians from the first component to the second."""
        first, second = self.velocities
        return np.asarray(first * math.cos(angle) + second * math.sin(angle))

    def azimuth(self, angle: float) -> float | None:
        """Return the direction of an angle in degrees from north, 0 to 180, or None where it is not known."""
        if self.azimuths is None:
            return None
        first, second = self.azimuths
        turn = 1.0 if (second - first) % 360.0 < 180.0 else -1.0
        return (first + turn * math.degrees(angle)) % 180.0


def single_velocity(record: Any, owner: str) -> FloatArray:
    """Return the velocity (m/s) of one record, the acceleration linear between samples and the start at rest.

    Raises
    ------
    InvalidMotion
        It is no record, its step is longer than the shortest pulse allows, or it has no motion.
    """
    if not isinstance(record, Record):
        raise refusal(InvalidMotion, "record", owner, "a Record", brief(record))
    scale_range(record.dt, owner)
    velocity = cumulative_trapezoid(record.acceleration, dx=record.dt, initial=0.0)
    if not velocity.any():
        raise refusal(
            InvalidMotion,
            "acceleration",
            f"record {record.name}".rstrip(),
            "other than zero somewhere",
            "zero throughout",
        )
    return np.asarray(velocity)


def horizontals(first: Any, second: Any, owner: str) -> Horizontals:
    """Return the velocities of two records, or of a pair: anything that holds two records.

    Raises
    ------
    InvalidMotion
        Not two records, different steps, directions that are stated and not perpendicular, or no motion.
    """
    records = _two_records(first, second, owner)
    steps = [record.dt for record in records]
    if not math.isclose(*steps, rel_tol=1e-9):
        raise refusal(InvalidMotion, "dt", f"the two records of {owner}", "equal", f"{steps[0]:g} and {steps[1]:g} s")
    azimuths = None
    if records[0].azimuth is not None and records[1].azimuth is not None:
        azimuths = (records[0].azimuth, records[1].azimuth)
        apart = (azimuths[1] - azimuths[0]) % 180.0
        if abs(apart - 90.0) > _SQUARE:
            got = f"{azimuths[0]:g} and {azimuths[1]:g} degrees"
            raise refusal(InvalidMotion, "azimuth", f"the two records of {owner}", "perpendicular", got)
    lengths = [record.samples for record in records]
    shortest = min(lengths)
    remarks = []
    if lengths[0] != lengths[1]:
        said = f"cut to {shortest} samples: {lengths[0]} and {lengths[1]}"
        if abs(lengths[0] - lengths[1]) > LENGTHS_OF_THE_CODE:
            said += f", a difference above the {LENGTHS_OF_THE_CODE} at which Shahi and Baker's code leaves a pair out"
        remarks.append(said)
    velocities = tuple(single_velocity(record, owner)[:shortest] for record in records)
    return Horizontals(
        names=(records[0].name, records[1].name),
        velocities=(velocities[0], velocities[1]),
        dt=records[0].dt,
        azimuths=azimuths,
        remarks=tuple(remarks),
    )


def _two_records(first: Any, second: Any, owner: str) -> tuple[Record, Record]:
    given = [first, second]
    if second is None:
        held = [getattr(first, name, None) for name in ("first", "second")]
        if all(isinstance(one, Record) for one in held):
            given = held
        elif isinstance(first, tuple | list) and len(first) == 2:
            given = list(first)
        else:
            raise refusal(InvalidMotion, "records", owner, "a pair of records, or two records", brief(first))
    for number, one in enumerate(given, start=1):
        if not isinstance(one, Record):
            raise refusal(InvalidMotion, f"record {number}", owner, "a Record", brief(one))
    return given[0], given[1]


def scale_range(dt: float, owner: str) -> range:
    """Return the 51 scales searched, in samples: from the shortest to just above the longest pulse period.

    Raises
    ------
    InvalidMotion
        The step is too long for the shortest pulse.
    """
    smallest = math.floor(SHORTEST_PERIOD / PERIOD_OF_SCALE / dt)
    if smallest < 1:
        most = SHORTEST_PERIOD / PERIOD_OF_SCALE
        raise refusal(InvalidMotion, "dt", owner, f"at most {most:.4g} s, to show pulses of 0.25 s", f"{dt:g} s")
    step = math.ceil((LONGEST_PERIOD / PERIOD_OF_SCALE / dt - smallest) / STEPS_OF_SCALE)
    return range(smallest, smallest + STEPS_OF_SCALE * step + 1, step)


@dataclass(frozen=True, eq=False)
class Extraction:
    """A pulse that was taken out of a velocity.

    Attributes
    ----------
    scale : int
        Scale of its wavelets, in samples.
    samples : tuple of int
        Centres of the ten wavelets, in order of extraction.
    coefficients : tuple of float
        Their coefficients.
    pulse, residual : ndarray, shape (samples,)
        Sum of the wavelets, and what is left of the velocity.
    """

    scale: int
    samples: tuple[int, ...]
    coefficients: tuple[float, ...]
    pulse: FloatArray
    residual: FloatArray


def extract(velocity: FloatArray, scales: range, row: int, sample: int) -> Extraction:
    """Take ten wavelets of one scale out of a velocity.

    Parameters
    ----------
    velocity : ndarray, shape (samples,)
        The velocity, in any unit.
    scales : range
        The scales of the search.
    row : int
        Place in it of the scale at which the coefficient is largest.
    sample : int
        Sample on which that coefficient is centred.

    Notes
    -----
    The scale is refined to the whole number of samples, between its neighbours in the search, at which the coefficient
    at the sample is largest in size (at steps below 2 ms to every second, third, ... number of samples). Each wavelet
    is that of the largest coefficient, within 0.4 scales of the sample, of what the ones before it left.
    """
    low, high = scales[max(0, row - 1)], scales[min(len(scales) - 1, row + 1)]
    between = range(low, high + 1, math.ceil((high + 1 - low) / REFINEMENTS))
    scale = max(between, key=lambda one: abs(coefficient(velocity, one, sample)))
    reach = math.ceil(NEIGHBOURHOOD * scale)
    lowest, highest = max(0, sample - reach), min(len(velocity) - 1, sample + reach)
    residual, pulse = velocity.copy(), np.zeros(len(velocity))
    centres, coefficients = [], []
    for _ in range(WAVELETS):
        near = transform_near(residual, scale, lowest, highest)
        place = int(np.argmax(np.abs(near)))
        centres.append(lowest + place)
        coefficients.append(float(near[place]))
        pulse += coefficients[-1] * wavelet_history(len(velocity), scale, centres[-1])
        residual = velocity - pulse
    return Extraction(scale, tuple(centres), tuple(coefficients), pulse, residual)


def cumulative_share(velocity: FloatArray) -> FloatArray:
    """Return the running sum of squares over the whole, at each sample; zero where the whole is."""
    running = np.cumsum(np.square(velocity))
    return np.asarray(running / running[-1] if running[-1] > 0.0 else running)
