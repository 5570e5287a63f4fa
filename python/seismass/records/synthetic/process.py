"""The site-based stochastic model of ground motion of Rezaeian and Der Kiureghian, and motions made by it.

Rezaeian & Der Kiureghian 2008 (Earthquake Engng Struct. Dyn. 37:1617) give the process, 2010 (39:1155) its parameters
by Arias intensity, duration and middle of the strong shaking. Nothing here is of a source, a path or a site: the
parameters are inputs, and the published equations that predict them from magnitude and distance are not included.
"""

from __future__ import annotations

import math
import random
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray

from seismass.base.errors import InvalidMotion
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import as_count, as_number, brief, refusal
from seismass.records.record import Record
from seismass.records.synthetic.ends import at_rest_in_the_end, ramp
from seismass.records.synthetic.near_fault import NearFaultPulse
from seismass.records.synthetic.noise import normals, sample_times

Array = NDArray[np.float64]

LEAST_FREQUENCY: Final = 0.3
"""Frequency of the filter (Hz) below which it does not fall however long its rate of change lasts."""

NEGLIGIBLE: Final = 1e-17
"""Size of the filter's response to one pulse, relative to its first swing, from which it is left out."""

INTENSITY_AT_THE_END: Final = 0.9999
"""Share of the Arias intensity after which the intensity fades out."""

REST: Final = 2.0
"""Time that the high-pass oscillator has to come to rest after that, in its periods."""

LONGEST: Final = 1_000_000
"""Most samples of one motion."""


@dataclass(frozen=True)
class SyntheticParameters:
    """Parameters of the process: intensity over time, frequency over time, bandwidth, and what is done afterwards.

    The published parameters are omega_mid = 2 pi `frequency`, omega' = 2 pi `frequency_rate` and zeta_f = `damping`.

    Parameters
    ----------
    arias : float
        Expected Arias intensity pi / (2 g) int a^2 dt of the process before its high-pass (m/s).
    d5_95 : float
        Time between 5 and 95 % of that intensity (s); 0.01 to 4.9 times `t_mid`.
    t_mid : float
        Time from the start until 45 % of it (s).
    frequency : float
        Frequency of the filter at `t_mid` (Hz), about the rate at which the process crosses zero upwards.
    frequency_rate : float
        Its change (Hz/s), mostly negative. The filter keeps at least 0.3 Hz.
    damping : float
        Damping ratio of the filter, between 0 and 1: the larger the broader the band.
    corner : float
        Frequency of the critically damped oscillator that takes off long periods (Hz), below `frequency`.
    pulse : NearFaultPulse, optional
        Velocity pulse that is added.

    Raises
    ------
    InvalidMotion
        A parameter is not finite or out of its range.

    Notes
    -----
    The code of the SCEC Broadband Platform for Rezaeian, Zhong and Zareian's later regression gives the ranges of the
    recorded sample as 5 to 45 s for D5-95, 0.5 to 40 s for t_mid, -2 to 0.5 Hz/s for the rate and 0.02 to 1 for the
    damping, and a gamma distribution of mean 5.9 Hz for the frequency. They were not compared with the paper, and are
    not enforced here.
    """

    arias: float
    d5_95: float
    t_mid: float
    frequency: float
    frequency_rate: float = 0.0
    damping: float = 0.3
    corner: float = 0.2
    pulse: NearFaultPulse | None = None

    def __post_init__(self) -> None:
        for name in ("arias", "d5_95", "t_mid", "frequency", "frequency_rate", "damping", "corner"):
            value = as_number(getattr(self, name), name, _OWNER, InvalidMotion)
            if not math.isfinite(value) or (value <= 0.0 and name != "frequency_rate"):
                requirement = "a finite number" if name == "frequency_rate" else "a positive number"
                raise refusal(InvalidMotion, name, _OWNER, requirement, brief(value))
            object.__setattr__(self, name, value)
        if self.damping >= 1.0:
            raise refusal(InvalidMotion, "damping", _OWNER, "between 0 and 1", f"{self.damping:g}")
        if self.frequency < LEAST_FREQUENCY:
            raise refusal(
                InvalidMotion, "frequency", _OWNER, f"at least {LEAST_FREQUENCY:g} Hz", f"{self.frequency:g} Hz"
            )
        if self.corner >= self.frequency:
            requirement = f"below the frequency, {self.frequency:g} Hz"
            raise refusal(InvalidMotion, "corner", _OWNER, requirement, f"{self.corner:g} Hz")
        if not 0.01 <= self.d5_95 / self.t_mid <= 4.9:
            raise refusal(
                InvalidMotion, "d5_95", _OWNER, "0.01 to 4.9 times t_mid", f"{self.d5_95:g} s beside {self.t_mid:g} s"
            )
        if self.pulse is not None and not isinstance(self.pulse, NearFaultPulse):
            raise refusal(InvalidMotion, "pulse", _OWNER, "a NearFaultPulse or None", brief(self.pulse))

    @cached_property
    def modulation(self) -> tuple[float, float]:
        """Shape k and scale (s) of the gamma density that the squared modulation is proportional to.

        Their relation to the published form q = a1 t^(a2 - 1) exp(-a3 t) is k = 2 a2 - 1 and scale = 1 / (2 a3). The
        ratio of D5-95 to t_mid is a function of k alone, and falls with it.
        """
        from scipy.optimize import brentq  # scipy takes longer to import than everything else here
        from scipy.special import gammaincinv

        def excess(log_shape: float) -> float:
            early, middle, late = gammaincinv(math.exp(log_shape), (0.05, 0.45, 0.95))
            return float((late - early) / middle) - self.d5_95 / self.t_mid

        shape = math.exp(brentq(excess, 0.0, math.log(1e6), xtol=1e-14, rtol=1e-14))
        return shape, self.t_mid / float(gammaincinv(shape, 0.45))

    @property
    def intensity_end(self) -> float:
        """Time (s) at which 99.99 % of the expected intensity has come."""
        from scipy.special import gammaincinv

        shape, scale = self.modulation
        return scale * float(gammaincinv(shape, INTENSITY_AT_THE_END))

    @property
    def duration(self) -> float:
        """Duration (s) of a motion: that of the intensity, two periods of the high-pass oscillator, and the pulse."""
        end = self.intensity_end + REST / self.corner
        return end if self.pulse is None else max(end, self.pulse.end)

    def filter_frequency(self, time: Array) -> Array:
        """Return the frequency of the filter (Hz) at times (s), of the shape of `time`."""
        return np.maximum(self.frequency + self.frequency_rate * (time - self.t_mid), LEAST_FREQUENCY)

    def standard_deviation(self, time: Array) -> Array:
        """Return the modulation q (m/s2), the standard deviation of the process, at times (s); zero before t = 0.

        q^2 is 2 g I_a / pi times the gamma density, so that the expected Arias intensity is `arias`.
        """
        from scipy.special import gammaln

        shape, scale = self.modulation
        total = 2.0 * STANDARD_GRAVITY * self.arias / math.pi
        with np.errstate(divide="ignore"):
            log_time = np.log(np.maximum(time, 0.0) / scale)
        log_density = (shape - 1.0) * log_time - np.maximum(time, 0.0) / scale - gammaln(shape) - math.log(scale)
        q: Array = np.sqrt(total) * np.exp(0.5 * log_density)
        return q


_OWNER: Final = "synthetic motion"


def filtered_noise(parameters: SyntheticParameters, noise: Array, dt: float, start: float = 0.0) -> Array:
    """Return noise (..., samples) through the varying filter h = omega exp(-zeta omega t) sin(omega sqrt(1 - zeta^2)
    t), as at each pulse's arrival, over its standard deviation: unit variance; the first sample is 0.
    """
    count = noise.shape[-1]
    since = sample_times(count, dt)
    circular = 2.0 * np.pi * parameters.filter_frequency(start + since)
    decay, damped = parameters.damping * circular, math.sqrt(1.0 - parameters.damping**2) * circular
    lasting = np.ceil(-math.log(NEGLIGIBLE) / (decay * dt)).astype(np.int64) + 1
    response, variance = np.zeros_like(noise), np.zeros(count)
    for i in range(count):
        time = since[: min(int(lasting[i]), count - i)]
        # The factor 1 / sqrt(1 - zeta^2) of the published h is the same for all and cancels.
        impulse = circular[i] * (np.exp(-decay[i] * time) * np.sin(damped[i] * time))
        response[..., i : i + len(time)] += noise[..., i, None] * impulse
        variance[i : i + len(time)] += impulse**2
    variance[0] = 1.0
    process: Array = response / np.sqrt(variance)
    return process


def high_passed(acceleration: Array, dt: float, corner: float) -> Array:
    """Return the acceleration (m/s2) u'' of u'' + 2 w u' + w^2 u = x, w = 2 pi corner (Hz), exact for x linear between
    samples: velocity and displacement return to zero (2008, post-processing).
    """
    w = 2.0 * math.pi * corner
    fade = math.exp(-w * dt)
    stay, move, pull = fade * (1.0 + w * dt), fade * dt, fade * w * w * dt
    u, v = 0.0, 0.0
    result = np.empty(len(acceleration))
    values = acceleration.tolist()
    result[0] = values[0]
    for k in range(1, len(values)):
        # The particular solution under x0 + slope t is (x - 2 slope / w) / w^2; the rest decays freely.
        slope = (values[k] - values[k - 1]) / dt
        du, dv = u - (values[k - 1] - 2.0 * slope / w) / w**2, v - slope / w**2
        u = stay * du + move * dv + (values[k] - 2.0 * slope / w) / w**2
        v = -pull * du + fade * (1.0 - w * dt) * dv + slope / w**2
        result[k] = values[k] - 2.0 * w * v - w * w * u
    return result


def synthetic_motion(parameters: SyntheticParameters, seed: int, dt: float = 0.01) -> Record:
    """Make one motion by the site-based stochastic model; it is not a recording.

    White noise passes a filter whose frequency changes over time (`filtered_noise`), is divided by its own standard
    deviation and multiplied by the modulation (`SyntheticParameters.standard_deviation`), passes a high-pass
    (`high_passed`), and a near-fault pulse is added. What velocity and displacement are left at the end, less than a
    ten-thousandth of their peaks, is taken off by a smooth acceleration over the whole motion, and both are zero
    there.

    Parameters
    ----------
    parameters : SyntheticParameters
        What the motion is like.
    seed : int
        Seed of the random numbers, those of `random.Random`; the same seed gives the same motion, to rounding.
    dt : float
        Time step (s); at most a tenth of the filter's shortest period.

    Returns
    -------
    Record
        Labelled as synthetic, with its parameters in the remarks and the steps in the history. The Arias intensity of
        one motion scatters about the expected one, and the high-pass takes a few per cent off.

    Raises
    ------
    InvalidMotion
        The seed is not a whole number from 0 on, or the step is not positive or too long.
    """
    if not isinstance(parameters, SyntheticParameters):
        raise refusal(InvalidMotion, "parameters", _OWNER, "a SyntheticParameters", brief(parameters))
    seed = as_count(seed, "seed", _OWNER, InvalidMotion)
    dt = as_number(dt, "dt", _OWNER, InvalidMotion)
    ends = parameters.filter_frequency(np.array([0.0, parameters.intensity_end]))
    longest = 0.1 / float(np.max(ends))
    if not 0.0 < dt <= longest:
        requirement = f"positive and at most {longest:.4g} s, a tenth of the filter's shortest period"
        raise refusal(InvalidMotion, "dt", _OWNER, requirement, brief(dt))
    if parameters.duration / dt > LONGEST:
        got = f"{parameters.duration:g} s in steps of {dt:g} s"
        raise refusal(InvalidMotion, "duration", _OWNER, f"at most {LONGEST} samples", got)
    time = sample_times(math.ceil(parameters.duration / dt) + 1, dt)
    process = filtered_noise(parameters, normals(random.Random(seed), len(time)), dt)
    end = parameters.intensity_end
    fading = 1.0 - ramp(time, end, end + 0.5 * REST / parameters.corner)
    acceleration = high_passed(parameters.standard_deviation(time) * fading * process, dt, parameters.corner)
    if parameters.pulse is not None:
        acceleration = acceleration + parameters.pulse.acceleration(time)
    return Record(
        acceleration=at_rest_in_the_end(acceleration, dt),
        dt=dt,
        name=f"synthetic, seed {seed}",
        event="synthetic",
        station="none",
        component="horizontal",
        synthetic=True,
        remarks=(f"SYNTHETIC motion: not a recording; seed {seed}; {parameters_text(parameters)}",),
        history=(
            f"high-passed by a critically damped oscillator of {parameters.corner:g} Hz",
            "velocity and displacement at the end taken off by a smooth acceleration",
        ),
    )


def parameters_text(parameters: SyntheticParameters) -> str:
    """Return the parameters in one line, as remarks have them."""
    pulse = parameters.pulse
    return (
        f"I_a {parameters.arias:g} m/s, D5-95 {parameters.d5_95:g} s, t_mid {parameters.t_mid:g} s, "
        f"filter {parameters.frequency:g} Hz {parameters.frequency_rate:+g} Hz/s, damping {parameters.damping:g}; "
        + ("no pulse" if pulse is None else f"velocity pulse of {pulse.period:g} s")
    )
