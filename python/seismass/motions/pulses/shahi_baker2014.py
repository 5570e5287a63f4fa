"""Velocity pulses of a pair of horizontal components: Shahi and Baker (2014), BSSA 104:2456."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Final

import numpy as np

from seismass.base.errors import InvalidOption
from seismass.base.values import FloatArray, as_number, frozen
from seismass.motions.pulses.extraction import (
    ARRIVAL,
    CENTIMETRES,
    NEIGHBOURHOOD,
    Horizontals,
    approximation_energy,
    cumulative_share,
    doubtful_period,
    extract,
    horizontals,
    scale_range,
    transform,
)
from seismass.motions.pulses.result import SHAHI_BAKER, Candidate, PulseResult
from seismass.motions.records.pair import Pair
from seismass.motions.records.record import Record

CANDIDATES: Final = 5
_OWNER: Final = "pulse identification"


def pulse_indicator_2014(pgv_ratio: float, energy_ratio: float, pgv_cm_s: float) -> float:
    """Return the pulse indicator of Shahi and Baker; positive for a pulse.

    Parameters
    ----------
    pgv_ratio, energy_ratio : float
        Peak velocity and energy of the residual over those of the velocity.
    pgv_cm_s : float
        Peak of the velocity (cm/s).

    Notes
    -----
    Shahi and Baker (2014), as in the code of the authors, with the principal component 0.63 r_PGV + 0.777 r_E and the
    peak velocity both centred and divided by their standard deviations.

    Examples
    --------
    >>> f"{pulse_indicator_2014(0.5, 0.5 * (1.0 - 0.63) / 0.777, 30.0):.3f}"
    '1.963'
    """
    pgv_ratio, energy_ratio, pgv_cm_s = (
        as_number(value, "ratio or peak", "pulse indicator", InvalidOption)
        for value in (pgv_ratio, energy_ratio, pgv_cm_s)
    )
    principal = (0.63 * pgv_ratio + 0.777 * energy_ratio - 1.208421) / 0.2462717
    peak = (pgv_cm_s - 11.58861) / 18.88015
    return (
        -7.817
        - 0.5679 * principal**2
        - 0.1516 * peak**2
        - 3.0253 * principal
        - 1.7396 * peak
        - 2.7156 * principal * peak
    )


def shahi_baker2014(first: Record | Pair, second: Record | None = None) -> PulseResult:
    """Judge whether a pair of horizontal components is pulse-like, in any direction.

    Parameters
    ----------
    first : Record or Pair
        First horizontal component, or a pair of both.
    second : Record, optional
        Second horizontal component, perpendicular to the first, where `first` is a record.

    Returns
    -------
    PulseResult
        Five candidates, each in the direction in which its wavelet is largest. The pair is pulse-like if any is, with
        the period of the first that is.

    Raises
    ------
    InvalidMotion
        Neither a pair nor two records, different steps, directions that are stated and not at right angles, no motion
        in one of them, or a step too long for a pulse of 0.25 s.
    MissingPackage
        PyWavelets is not installed.

    Notes
    -----
    Components of different length are cut to the shorter; the authors' code leaves a pair out that differs by more than
    20 samples. r_E is the ratio of the energies of the db4 approximation coefficients
    of one level, as there. A pulse is late, and none, if the record has 17 % of its cumulative squared velocity where
    the pulse still has 5 %.
    """
    pair = horizontals(first, second, _OWNER)
    scales = scale_range(pair.dt, _OWNER)
    size, rows, angles = _largest_by_time(pair, scales)
    candidates = []
    for number in range(1, CANDIDATES + 1):
        sample = int(np.argmax(size))
        row = int(rows[sample])
        candidates.append(_candidate(pair, scales, number, row, sample, float(angles[sample])))
        reach = NEIGHBOURHOOD * scales[row]
        size[np.abs(np.arange(len(size)) - sample) < reach] = 0.0
        if not size.any():
            break
    result = PulseResult(SHAHI_BAKER, pair.names, tuple(candidates), pair.remarks)
    doubtful = doubtful_period(result.primary.period, (len(pair.velocities[0]) - 1) * pair.dt)
    return replace(result, remarks=result.remarks + doubtful)


def _largest_by_time(pair: Horizontals, scales: range) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Largest c1^2 + c2^2 over the scales at each sample, the row of that scale, and the direction there."""
    samples = len(pair.velocities[0])
    size, rows, angles = np.full(samples, -1.0), np.zeros(samples), np.zeros(samples)
    for row, scale in enumerate(scales):
        first, second = (transform(velocity, scale) for velocity in pair.velocities)
        here = np.square(first) + np.square(second)
        larger = here > size
        size[larger], rows[larger] = here[larger], row
        # The angle of a line, not of an arrow: above -90 to 90 degrees.
        turned = np.where(first[larger] < 0.0, -1.0, 1.0)
        angles[larger] = np.arctan2(turned * second[larger], turned * first[larger])
    return size, rows, angles


def _candidate(pair: Horizontals, scales: range, number: int, row: int, sample: int, angle: float) -> Candidate:
    velocity = pair.towards(angle)
    extraction = extract(velocity, scales, row, sample)
    pgv = float(np.max(np.abs(velocity)))
    pgv_ratio = float(np.max(np.abs(extraction.residual))) / pgv
    energy_ratio = approximation_energy(extraction.residual) / approximation_energy(velocity)
    indicator = pulse_indicator_2014(pgv_ratio, energy_ratio, CENTIMETRES * pgv)
    of_record, of_pulse = cumulative_share(velocity), cumulative_share(extraction.pulse)
    # A pulse that begins with the record has nothing before it.
    share_of_pulse, share_of_record = ARRIVAL[SHAHI_BAKER]
    begins = int(np.count_nonzero(of_pulse <= share_of_pulse)) - 1
    before = float(of_record[begins]) if begins >= 0 else 0.0
    early = before < share_of_record
    reasons = []
    if indicator <= 0.0:
        reasons.append(f"indicator {indicator:.3f} is not positive")
    if not early:
        reasons.append(
            f"it arrives late: the record has {100.0 * before:.0f} % of its squared velocity, 17 % or more, where the "
            "pulse has 5 %"
        )
    return Candidate(
        number=number,
        kind="no pulse" if reasons else "pulse",
        reasons=tuple(reasons),
        scale=extraction.scale,
        dt=pair.dt,
        angle=math.degrees(angle),
        azimuth=pair.azimuth(angle),
        indicator=indicator,
        energy_ratio=energy_ratio,
        early=early,
        energy_before=before,
        arrival=max(begins, 0) * pair.dt,
        centres=frozen(np.array(extraction.samples) * pair.dt),
        coefficients=frozen(extraction.coefficients),
        velocity=frozen(velocity),
        pulse=frozen(extraction.pulse),
        residual=frozen(extraction.residual),
    )
