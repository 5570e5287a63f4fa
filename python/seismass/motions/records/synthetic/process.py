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
from seismass.motions.records.intensity import integrals
from seismass.motions.records.record import Record

Array = NDArray[np.float64]


def ramp(values: Array, low: float, high: float) -> Array:
    """Rise smoothly from 0 at `low` to 1 at `high`."""
    return np.sin(0.5 * np.pi * np.clip((values - low) / (high - low), 0.0, 1.0)) ** 2


def tapered(motion: Array, time: Array) -> Array:
    """Let the motion rise within 1.5 s and end within the last three."""
    return motion * ramp(time, 0.0, 1.5) * ramp(time[-1] - time, 0.0, 3.0)


def end_state(acceleration: Array, dt: float) -> tuple[float, float]:
    """Return velocity and displacement at the last sample, exact for accelerations linear between samples."""
    velocity, displacement = integrals(acceleration, dt)
    return float(velocity[-1]), float(displacement[-1])


def at_rest_in_the_end(motion: Array, dt: float) -> Array:
    """Take off a smooth acceleration such that the final velocity and displacement vanish."""
    along = np.linspace(0.0, 1.0, len(motion))
    shapes = [np.sin(np.pi * along) ** 2, np.sin(np.pi * along) ** 2 * (along - 0.5)]
    ends = np.array([end_state(shape, dt) for shape in shapes]).T
    amounts = np.linalg.solve(ends, np.array(end_state(motion, dt)))
    corrected: Array = motion - amounts[0] * shapes[0] - amounts[1] * shapes[1]
    return corrected


def pulse(time: Array, centre: float, period: float, velocity: float) -> Array:
    """Return the ground acceleration of a Mavroeidis-Papageorgiou pulse with gamma = 2 and a phase of 90 degrees: odd
    about its centre, so that its displacement ends where it began.
    """
    gamma, phase = 2.0, 0.5 * math.pi
    circular = 2.0 * math.pi / period
    since = time - centre
    inside = np.abs(since) <= 0.5 * gamma * period
    carrier = circular * since + phase
    bell = circular * since / gamma
    rate = -circular * (np.sin(carrier) * (1.0 + np.cos(bell)) + np.cos(carrier) * np.sin(bell) / gamma)
    return np.where(inside, 0.5 * velocity * rate, 0.0)


@dataclass(frozen=True)
class NearFaultPulse:
    """A velocity pulse v(t) = -A/2 (1 + cos(2 pi s / (gamma T))) sin(2 pi s / T), s = t - centre, gamma = 2.

    It lasts two periods. Velocity and displacement are zero before and after it: of the phases of the published form
    only this one, 90 degrees, leaves no displacement.

    Parameters
    ----------
    period : float
        T (s).
    velocity : float
        A (m/s); the largest velocity is 0.87 A.
    centre : float
        Time of its middle (s), at least one period after the start of the motion.

    Raises
    ------
    InvalidMotion
        Period or velocity are not positive and finite, or the pulse begins before the motion.
    """

    period: float
    velocity: float
    centre: float

    def __post_init__(self) -> None:
        for name in ("period", "velocity", "centre"):
            value = as_number(getattr(self, name), name, "near-fault pulse", InvalidMotion)
            if not (math.isfinite(value) and value > 0.0):
                raise refusal(InvalidMotion, name, "near-fault pulse", "a positive number", brief(value))
            object.__setattr__(self, name, value)
        if self.centre < self.period:
            raise refusal(
                InvalidMotion,
                "centre",
                "near-fault pulse",
                f"at least its period, {self.period:g} s, so that the pulse begins after the motion",
                f"{self.centre:g} s",
            )

    @property
    def end(self) -> float:
        """Time (s) at which the pulse is over."""
        return self.centre + self.period

    def acceleration(self, time: Array) -> Array:
        """Return the ground acceleration of the pulse (m/s2) at times (s), of the shape of `time`."""
        return pulse(time, self.centre, self.period, self.velocity)


def sample_times(count: int, dt: float) -> NDArray[np.float64]:
    """Return the times (s) of samples from zero on, shape (count,)."""
    return np.arange(count).astype(np.float64) * dt


def normals(source: random.Random, count: int) -> NDArray[np.float64]:
    """Return standard normal numbers by Box and Muller's formula, shape (count,)."""
    pairs = [(source.random(), source.random()) for _ in range((count + 1) // 2)]
    radius = np.sqrt(-2.0 * np.log(1.0 - np.array([p for p, _ in pairs])))
    angle = 2.0 * np.pi * np.array([q for _, q in pairs])
    return np.stack((radius * np.cos(angle), radius * np.sin(angle)), axis=1).ravel()[:count]


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
    frequency_rate : float, default 0.0
        Its change (Hz/s), mostly negative. The filter keeps at least 0.3 Hz.
    damping : float, default 0.3
        Damping ratio of the filter, between 0 and 1: the larger the broader the band.
    corner : float, default 0.2
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
    dt : float, default 0.01
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


DAMPING: Final = 0.05

SDS_G, SD1_G, LONG_PERIOD = 1.07, 0.61, 8.0
"""The ASCE 7 shape aimed at (11.4.5): S_DS, S_D1 in g, T_L in s."""

LEVEL, LEVEL_SPREAD, SHAPE_SPREAD, SHAPE_CORRELATION = 0.85, 0.12, 0.25, 0.6
"""Median level of a motion against the shape, as of records before scaling; lognormal spread of that level and of the
wander over period; correlation length of the wander in ln T."""

MATCHED_PERIODS: Final = np.geomspace(0.05, 5.0, 90)
HIGH_PASS: Final = (0.08, 0.20)
LOW_PASS: Final = (12.0, 25.0)
"""Frequencies (Hz) between which the content rises from zero at its low end and falls to zero at its high end."""


def asce7_shape(period: Array) -> Array:
    """Return the ASCE 7 design spectrum (11.4.5) of this suite (m/s2)."""
    corner = SD1_G / SDS_G
    rising = SDS_G * (0.4 + 0.6 * period / (0.2 * corner))
    falling = np.where(period <= LONG_PERIOD, SD1_G / period, SD1_G * LONG_PERIOD / period**2)
    return STANDARD_GRAVITY * np.minimum(np.minimum(rising, SDS_G), falling)


def spectrum(acceleration: Array, dt: float, periods: Array) -> Array:
    """Return the pseudo-acceleration (m/s2) by Fourier transform, peaks at samples: good enough to shape a motion."""
    length = 2 ** math.ceil(math.log2(len(acceleration) + 30.0 / dt))
    transform = np.fft.rfft(acceleration, length)
    frequency = 2.0 * np.pi * frequencies(length, dt)
    values = np.empty(len(periods))
    for i, natural in enumerate(2.0 * np.pi / periods):
        transfer = natural**2 / (natural**2 - frequency**2 + 2j * DAMPING * natural * frequency)
        values[i] = np.max(np.abs(np.fft.irfft(transform * transfer, length)))
    return values


def frequencies(length: int, dt: float) -> Array:
    """Return the frequencies (Hz) of a real Fourier transform."""
    return np.fft.rfftfreq(length, dt).astype(np.float64)


def gain_over_frequency(log_ratio: Array, frequency: Array) -> Array:
    """Return exp(log_ratio), given at the matched periods, at frequencies (Hz); constant beyond its ends."""
    log_frequency = np.log(np.maximum(frequency, 1e-3))
    return np.exp(np.interp(log_frequency, -np.log(MATCHED_PERIODS[::-1]), log_ratio[::-1]))


def shaped(process: Array, dt: float, log_ratio: Array) -> Array:
    """Multiply the Fourier amplitudes by the ratio at the period 1 / frequency, and take off the highest."""
    length = 2 * len(process)  # zeros beside the motion keep it from wrapping round
    frequency = frequencies(length, dt)
    gain = gain_over_frequency(log_ratio, frequency) * (1.0 - ramp(frequency, *LOW_PASS))
    return np.fft.irfft(np.fft.rfft(process, length) * gain, length)[: len(process)]
