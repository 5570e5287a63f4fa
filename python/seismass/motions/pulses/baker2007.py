"""Velocity pulses of one component, and by orientation of a pair: Baker (2007), BSSA 97:1486."""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from seismass.base.errors import InvalidOption
from seismass.base.values import FloatArray, as_count, as_number, frozen
from seismass.motions.pulses.extraction import (
    ARRIVAL,
    CENTIMETRES,
    LEAST_PGV,
    NO_PULSE_BELOW,
    PULSE_ABOVE,
    cumulative_share,
    doubtful_period,
    drift_of,
    extract,
    horizontals,
    scale_range,
    single_velocity,
    transform,
)
from seismass.motions.pulses.result import BAKER, Candidate, Kind, OrientationScan, PulseResult
from seismass.motions.records.formats.labels import is_vertical
from seismass.motions.records.pair import Pair
from seismass.motions.records.record import Record

MOST_ORIENTATIONS: Final = 3600
_OWNER: Final = "pulse identification"


def pulse_indicator_2007(pgv_ratio: float, energy_ratio: float) -> float:
    """Return Baker's pulse indicator, 0 to 1.

    Parameters
    ----------
    pgv_ratio, energy_ratio : float
        Peak and energy of the residual velocity over those of the velocity.

    Notes
    -----
    Baker (2007): 1 / (1 + exp(-23.3 + 14.6 r_PGV + 20.5 r_E)). Above 0.85 a pulse, below 0.15 none.

    Examples
    --------
    >>> f"{pulse_indicator_2007(0.6, 0.6):.3f}"
    '0.904'
    """
    pgv_ratio, energy_ratio = (
        as_number(value, "ratio", "pulse indicator", InvalidOption) for value in (pgv_ratio, energy_ratio)
    )
    return 1.0 / (1.0 + math.exp(-23.3 + 14.6 * pgv_ratio + 20.5 * energy_ratio))


def baker2007(record: Record) -> PulseResult:
    """Judge whether one component is pulse-like.

    Parameters
    ----------
    record : Record
        One horizontal component; the method was made for the one normal to the fault.

    Returns
    -------
    PulseResult
        Its one candidate is the pulse around the largest db4 wavelet coefficient of the velocity.

    Raises
    ------
    InvalidMotion
        No record, no motion, or a step too long for a pulse of 0.25 s.
    MissingPackage
        PyWavelets is not installed.

    Notes
    -----
    A record is pulse-like if the indicator is above 0.85, the peak velocity above 30 cm/s, and the pulse early: at the
    time of 10 % of the pulse's cumulative squared velocity the record is below 20 % of its own. The pulse is the sum of
    ten wavelets of one scale within 0.4 scales of the first (Shahi and Baker, 2014); the paper of 2007 may have left
    the further nine more freedom. Energies are integrals of the squared velocity. The answer depends on the direction
    of the component: see `baker2007_orientations`.
    """
    velocity = single_velocity(record, _OWNER)
    row, sample = _largest(velocity, scale_range(record.dt, _OWNER))
    candidate = _candidate(velocity, record.dt, row, sample, angle=0.0, azimuth=record.azimuth)
    remarks = drift_of((record,)) + doubtful_period(candidate.period, record.duration)
    if is_vertical(record.component):
        remarks += (f"{record.name or 'record'} is a vertical component: the method was made for horizontal ones",)
    return PulseResult(BAKER, (record.name,), (candidate,), remarks)


def baker2007_orientations(
    first: Record | Pair, second: Record | None = None, *, orientations: int = 36
) -> OrientationScan:
    """Judge each orientation of a pair as one component.

    Parameters
    ----------
    first : Record or Pair
        First horizontal component, or a pair of both.
    second : Record, optional
        Second horizontal component, where `first` is a record.
    orientations : int, default 36
        Angles, evenly from 0 to below 180 degrees from the first component to the second.

    Raises
    ------
    InvalidMotion
        As for `shahi_baker2014`.
    InvalidOption
        `orientations` is not a whole number from 1 to 3600.
    MissingPackage
        PyWavelets is not installed.
    """
    count = as_count(orientations, "orientations", _OWNER, InvalidOption, least=1)
    if count > MOST_ORIENTATIONS:
        raise InvalidOption(f"orientations of {_OWNER} must be at most {MOST_ORIENTATIONS}; got {count}")
    pair = horizontals(first, second, _OWNER)
    degrees = np.arange(count) * (180.0 / count)
    angles = np.radians(degrees)
    places = _largest_by_angle(pair.velocities, scale_range(pair.dt, _OWNER), angles)
    results = []
    for angle, (row, sample) in zip(angles, places, strict=True):
        candidate = _candidate(
            pair.towards(angle), pair.dt, row, sample, angle=math.degrees(angle), azimuth=pair.azimuth(angle)
        )
        remarks = pair.remarks + doubtful_period(candidate.period, (len(candidate.velocity) - 1) * pair.dt)
        results.append(PulseResult(BAKER, pair.names, (candidate,), remarks))
    return OrientationScan(pair.names, tuple(results), frozen(degrees), pair.remarks)


def _largest(velocity: FloatArray, scales: range) -> tuple[int, int]:
    """Row of the scale and sample of the largest coefficient."""
    return _largest_by_angle((velocity, np.zeros_like(velocity)), scales, np.zeros(1))[0]


def _largest_by_angle(
    velocities: tuple[FloatArray, FloatArray], scales: range, angles: FloatArray
) -> list[tuple[int, int]]:
    """Row and sample of the largest coefficient in each direction; the transform is linear, so that two suffice."""
    cosine, sine = np.cos(angles)[:, None], np.sin(angles)[:, None]
    largest = np.full(len(angles), -1.0)
    places = [(0, 0)] * len(angles)
    for row, scale in enumerate(scales):
        first, second = (transform(velocity, scale) for velocity in velocities)
        size = np.abs(first * cosine + second * sine)
        samples = np.argmax(size, axis=1)
        for number, sample in enumerate(samples):
            if size[number, sample] > largest[number]:
                largest[number] = size[number, sample]
                places[number] = (row, int(sample))
    return places


def _candidate(
    velocity: FloatArray, dt: float, row: int, sample: int, *, angle: float, azimuth: float | None
) -> Candidate:
    extraction = extract(velocity, scale_range(dt, _OWNER), row, sample)
    pgv = float(np.max(np.abs(velocity)))
    pgv_ratio = float(np.max(np.abs(extraction.residual))) / pgv
    energy_ratio = float(np.sum(np.square(extraction.residual)) / np.sum(np.square(velocity)))
    indicator = pulse_indicator_2007(pgv_ratio, energy_ratio)
    of_record, of_pulse = cumulative_share(velocity), cumulative_share(extraction.pulse)
    share_of_pulse, share_of_record = ARRIVAL[BAKER]
    begins = int(np.argmax(of_pulse >= share_of_pulse))
    early = int(np.argmax(of_record >= share_of_record)) > begins
    reasons = []
    if indicator <= PULSE_ABOVE:
        unclear = ", between the limits of no pulse, 0.15, and pulse, 0.85" if indicator >= NO_PULSE_BELOW else ""
        reasons.append(f"indicator {indicator:.3f} is not above 0.85{unclear}")
    if pgv <= LEAST_PGV:
        reasons.append(f"peak velocity {CENTIMETRES * pgv:.1f} cm/s is not above 30 cm/s")
    if not early:
        reasons.append(
            f"it arrives late: the record has {100.0 * of_record[begins]:.0f} % of its squared velocity where the "
            "pulse has 10 %"
        )
    kind: Kind = "no pulse"
    if not reasons:
        kind = "pulse"
    elif NO_PULSE_BELOW <= indicator <= PULSE_ABOVE and len(reasons) == 1:
        kind = "ambiguous"
    return Candidate(
        number=1,
        kind=kind,
        reasons=tuple(reasons),
        scale=extraction.scale,
        dt=dt,
        angle=angle,
        azimuth=azimuth,
        indicator=indicator,
        energy_ratio=energy_ratio,
        early=early,
        energy_before=float(of_record[begins]),
        arrival=begins * dt,
        centres=frozen(np.array(extraction.samples) * dt),
        coefficients=frozen(extraction.coefficients),
        velocity=frozen(velocity),
        pulse=frozen(extraction.pulse),
        residual=frozen(extraction.residual),
    )
