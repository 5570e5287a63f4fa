"""Steps that change the samples of a record on purpose: baseline, filter, resampling. Each is kept in its history.

The vertical component is processed in the same way as the horizontal one.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction
from typing import Any, Final, Literal, Protocol, Self, TypeVar

import numpy as np

from seismass.base.arguments import as_word
from seismass.base.errors import InvalidOption
from seismass.base.values import FloatArray, as_count, as_flag, as_number, brief, refusal, signed
from seismass.motions.records.intensity import integrals

HIGHEST_ORDER: Final = 10
"""Of baselines and filters; above it neither is stable or meant."""
LONGEST_PERIODS: Final = 10.0
"""Longest period of a filter's corner as a multiple of the duration: below its frequency a record says nothing."""
LARGEST_TERM: Final = 10_000
"""Largest of the two whole numbers whose ratio is that of two steps."""


class Processed(Protocol):
    """What is read of a record here, and how another is made of it."""

    @property
    def acceleration(self) -> FloatArray:
        """Samples (m/s2)."""

    @property
    def vertical(self) -> FloatArray | None:
        """Samples of the vertical component, if there is one."""

    @property
    def dt(self) -> float:
        """Time step (s)."""

    @property
    def name(self) -> str:
        """Its name."""

    @property
    def history(self) -> tuple[str, ...]:
        """What was done to it."""

    @property
    def remarks(self) -> tuple[str, ...]:
        """What is to be known of it."""

    @property
    def samples(self) -> int:
        """Number of samples."""

    @property
    def pga(self) -> float:
        """Peak acceleration (m/s2)."""

    @property
    def pga_g(self) -> float:
        """Peak acceleration (g)."""

    def replace(self, **changes: Any) -> Self:
        """Return another one, with these arguments changed."""


R = TypeVar("R", bound=Processed)


def baseline_corrected(record: R, order: int = 1, fit: Literal["velocity", "acceleration"] = "velocity") -> R:
    """Return a record less a polynomial (degree `order`, 0 to 10) of least squares to the acceleration, or whose
    integral fits the velocity (Boore 2001, Bull. Seism. Soc. Am. 91:1199-1211).
    """
    degree = as_count(order, "order", "baseline correction", InvalidOption)
    if degree > HIGHEST_ORDER:
        raise refusal(InvalidOption, "order", "baseline correction", f"at most {HIGHEST_ORDER}", brief(order))
    as_word(fit, ("velocity", "acceleration"), "fit", "baseline correction")
    if record.samples < degree + 2:
        requirement = f"at least {degree + 2} for a polynomial of degree {degree}"
        raise refusal(InvalidOption, "samples", "baseline correction", requirement, str(record.samples))
    # Legendre polynomials span those of time and keep the fit well conditioned.
    along = np.linspace(-1.0, 1.0, record.samples)
    terms = np.asarray(np.polynomial.legendre.legvander(along, degree).T, dtype=np.float64)
    fitted = integrals(terms, record.dt)[0] if fit == "velocity" else terms

    def corrected(acceleration: FloatArray) -> FloatArray:
        wanted = integrals(acceleration, record.dt)[0] if fit == "velocity" else acceleration
        coefficients = np.linalg.lstsq(fitted.T, wanted, rcond=None)[0]
        left: FloatArray = acceleration - coefficients @ terms
        return left

    return _both(record, corrected, f"baseline of degree {degree} fitted to the {fit} and removed")


def band_passed(
    record: R,
    low_hz: float | None,
    high_hz: float | None,
    order: int = 4,
    *,
    taper: float = 0.01,
    keep_pads: bool = False,
) -> R:
    """Return a record filtered by a tapered, zero-padded Butterworth filter run forwards and backwards: gain 1/2 (-6
    dB) at the corners. Pads as in Boore (2005), Bull. Seism. Soc. Am. 95:745-750.
    """
    from scipy import signal  # slow to import

    poles = as_count(order, "order", "band-pass filter", InvalidOption, least=1)
    if poles > HIGHEST_ORDER:
        raise refusal(InvalidOption, "order", "band-pass filter", f"at most {HIGHEST_ORDER}", brief(order))
    share = as_number(taper, "taper", "band-pass filter", InvalidOption)
    if not 0.0 <= share <= 0.5:
        raise refusal(InvalidOption, "taper", "band-pass filter", "a share from 0 to 0.5", brief(taper))
    low, high = _corners(record, low_hz, high_hz)
    kind, corners = {
        (False, True): ("lowpass", high),
        (True, False): ("highpass", low),
        (True, True): ("bandpass", [low, high]),
    }[low is not None, high is not None]
    sections = signal.butter(poles, corners, kind, fs=1.0 / record.dt, output="sos")
    tapered = round(share * (record.samples - 1))
    rise = 0.5 * (1.0 - np.cos(np.pi * np.arange(tapered) / max(tapered, 1)))
    lowest = low if low is not None else high
    assert lowest is not None
    keep_pads = as_flag(keep_pads, "keep_pads", "filter", InvalidOption)
    pad = math.ceil(1.5 * poles / (lowest * record.dt))

    def filtered(acceleration: FloatArray) -> FloatArray:
        padded = np.pad(acceleration, pad)
        padded[pad : pad + tapered] *= rise
        padded[len(padded) - pad - tapered : len(padded) - pad] *= rise[::-1]
        passed: FloatArray = signal.sosfiltfilt(sections, padded, padtype=None)
        return passed if keep_pads else passed[pad : pad + record.samples]

    band = f"above {low:g} Hz" if high is None else f"below {high:g} Hz" if low is None else f"{low:g} to {high:g} Hz"
    pads = "kept" if keep_pads else "removed again"
    note = (
        f"filtered {band}: Butterworth of order {poles} forwards and backwards, ends tapered over {tapered} samples, "
        f"{pad} zeros at each end {pads}"
    )
    changed = _both(record, filtered, note)
    peak = int(np.argmax(np.abs(record.acceleration)))
    if tapered and not tapered <= peak < record.samples - tapered:
        changed = changed.replace(remarks=(*changed.remarks, "the taper reduced its largest acceleration"))
    return changed


def resampled(record: R, dt: float) -> R:
    """Return a record at another step (s). A divisor of the old step gives the same motion, linear in between;
    otherwise `scipy.signal.resample_poly` filters above the lower Nyquist frequency, with a remark on PGA.
    """
    step = as_number(dt, "dt", "resampled record", InvalidOption)
    if not (math.isfinite(step) and step > 0.0):
        raise refusal(InvalidOption, "dt", "resampled record", "a positive number", brief(dt))
    # So small a step has no ratio to the record's that a double can hold.
    ratio = Fraction(min(record.dt / step, 2.0 * LARGEST_TERM)).limit_denominator(LARGEST_TERM)
    if ratio.numerator > LARGEST_TERM or abs(float(ratio) * step - record.dt) > 1e-9 * record.dt:
        requirement = f"in a ratio of whole numbers up to {LARGEST_TERM} to its step, {record.dt:g} s"
        raise refusal(InvalidOption, "dt", "resampled record", requirement, f"{step:g} s")
    if ratio == 1:
        return record
    if ratio.denominator == 1:
        times = ratio.numerator
        finer = np.arange((record.samples - 1) * times + 1) / times
        indices = np.arange(record.samples)
        note = f"resampled from {record.dt:g} to {step:g} s on the lines between samples: the same motion"
        return _both(record, lambda acceleration: np.interp(finer, indices, acceleration), note, dt=step)
    from scipy import signal  # slow to import

    def interpolated(acceleration: FloatArray) -> FloatArray:
        samples: FloatArray = signal.resample_poly(acceleration, ratio.numerator, ratio.denominator)
        return samples

    note = f"resampled from {record.dt:g} to {step:g} s by band-limited interpolation ({ratio})"
    changed = _both(record, interpolated, note, dt=step)
    if record.pga == 0.0:
        return changed
    loss = 100.0 * (changed.pga / record.pga - 1.0)
    remark = (
        f"resampling from {record.dt:g} to {step:g} s changed PGA from {record.pga_g:.4f} g by {signed(loss, '+.2f')} %"
    )
    return changed.replace(remarks=(*changed.remarks, remark))


def _both(record: R, change: Callable[[FloatArray], FloatArray], note: str, **others: Any) -> R:
    """The record with both components changed, and what was done."""
    vertical = None if record.vertical is None else change(record.vertical)
    return record.replace(
        acceleration=change(record.acceleration), vertical=vertical, history=(*record.history, note), **others
    )


def _corners(record: Processed, low_hz: float | None, high_hz: float | None) -> tuple[float | None, float | None]:
    """Corner frequencies in order and within what the record holds."""
    owner = f"band-pass filter of {record.name or 'a record'}"
    low, high = (
        None if value is None else as_number(value, name, owner, InvalidOption)
        for name, value in (("low_hz", low_hz), ("high_hz", high_hz))
    )
    if low is None and high is None:
        raise refusal(InvalidOption, "corners", owner, "one frequency or two", "none")
    nyquist = 0.5 / record.dt
    least = 1.0 / (LONGEST_PERIODS * record.samples * record.dt)
    for name, value in (("low_hz", low), ("high_hz", high)):
        if value is not None and not least <= value < nyquist:
            requirement = f"from {least:.3g} Hz, a tenth of one over the duration, to below {nyquist:g} Hz, 1/(2 dt)"
            raise refusal(InvalidOption, name, owner, requirement, f"{value:g}")
    if low is not None and high is not None and low >= high:
        raise refusal(InvalidOption, "low_hz", owner, f"below high_hz, {high:g}", f"{low:g}")
    return low, high
