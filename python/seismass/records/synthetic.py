"""The generator of the built-in suite: synthetic motions of fixed seeds. No instrument recorded any of them.

Method
------
1. Gaussian white noise times the envelope of Saragoni & Hart (1974) as parametrised by Boore (2003, Pure Appl. Geophys.
   160:635, eqs. 6-9), coloured by the filter of Clough & Penzien (Kanai-Tajimi and a high-pass oscillator).
2. Its Fourier amplitudes are corrected towards a target response spectrum, phases kept (the iteration of SIMQKE,
   Gasparini & Vanmarcke 1976). Each motion has a target of its own: the two-period shape of ASCE 7 times a smooth
   lognormal wander over period, so that motions differ from each other and from the shape, as records do.
3. Some motions carry a velocity pulse of Mavroeidis & Papageorgiou (2003, BSSA 93:1099, eq. 3).
4. A taper and a baseline correction that ends the motion at rest at its starting place.

Limitations
-----------
Stationary frequency content but for the pulse, one component, no source, path or site behind it. They stand in where no
recordings are at hand; they are no substitute for them.

`python -m seismass.records.synthetic DIRECTORY` writes the files again.
"""

from __future__ import annotations

import csv
import math
import random
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from seismass.records.record import Record
from seismass.units import STANDARD_GRAVITY

Array = NDArray[np.float64]

GENERATOR_VERSION: Final = 1
DAMPING: Final = 0.05

SDS_G, SD1_G, LONG_PERIOD = 1.07, 0.61, 8.0
"""The ASCE 7 shape aimed at (11.4.5): S_DS, S_D1 in g, T_L in s."""

LEVEL, LEVEL_SPREAD, SHAPE_SPREAD, SHAPE_CORRELATION = 0.85, 0.12, 0.25, 0.6
"""Median level of a motion against the shape, as of records before scaling; lognormal spread of that level and of the
wander over period; correlation length of the wander in ln T."""

CORRECTIONS: Final = 5
MATCHED_PERIODS: Final = np.geomspace(0.05, 5.0, 90)
HIGH_PASS: Final = (0.08, 0.20)
LOW_PASS: Final = (12.0, 25.0)
"""Frequencies (Hz) between which the two ends of the content rise from nothing to full, and fall to nothing."""


QUIET: Final = 2.0
"""Time (s) before the strong phase sets in, for the slow precursors of filters without phase."""


@dataclass(frozen=True)
class Recipe:
    """What makes one motion: seed, step and duration (s), strong-phase length (s), pulse period (s) and speed (m/s)."""

    number: int
    seed: int
    dt: float
    duration: float
    strong_phase: float
    pulse_period: float | None = None
    pulse_velocity: float = 0.0

    @property
    def name(self) -> str:
        """The name of the motion and of its file."""
        return f"synthetic-{self.number}"

    @property
    def note(self) -> str:
        """What a reader should know of it, in a few words."""
        pulse = f"velocity pulse of {self.pulse_period:g} s" if self.pulse_period else "no pulse"
        return f"SYNTHETIC motion {self.number}: not a recording; seed {self.seed}; {pulse}"


RECIPES: Final = (
    Recipe(1, 1101, 0.01, 36.0, 12.0),
    Recipe(2, 1102, 0.005, 34.0, 9.0, pulse_period=2.6, pulse_velocity=0.30),
    Recipe(3, 1103, 0.01, 38.0, 10.0, pulse_period=4.2, pulse_velocity=0.35),
    Recipe(4, 4008, 0.01, 40.0, 16.0),
    Recipe(5, 1105, 0.005, 30.0, 8.0, pulse_period=1.8, pulse_velocity=0.25),
    Recipe(6, 6011, 0.01, 40.0, 18.0),
    Recipe(7, 1107, 0.01, 35.0, 11.0),
)


def generate(recipe: Recipe) -> Record:
    """Make one motion; the same on every machine to rounding, its random numbers being those of `random.Random`."""
    source = random.Random(recipe.seed)
    count = round(recipe.duration / recipe.dt) + 1
    time = np.linspace(0.0, recipe.dt * (count - 1), count)
    target = _target(source)
    noise = _normals(source, count) * envelope(np.maximum(time - QUIET, 0.0), recipe.strong_phase)
    motion = _coloured(noise, recipe.dt)
    for _ in range(CORRECTIONS):
        motion = _corrected(motion, recipe.dt, target)
    if recipe.pulse_period is not None:
        motion = motion + pulse(time, QUIET + 0.4 * recipe.strong_phase, recipe.pulse_period, recipe.pulse_velocity)
    motion = _tapered(_high_passed(_tapered(motion, time), recipe.dt), time)
    motion = _at_rest_in_the_end(motion, recipe.dt)
    return Record(
        acceleration=motion,
        dt=recipe.dt,
        name=recipe.name,
        event="synthetic",
        station="none",
        component="horizontal",
        synthetic=True,
        remarks=(recipe.note,),
    )


def envelope(time: Array, strong_phase: float) -> Array:
    """Return Saragoni & Hart's envelope: largest (1) at 0.2 and down to 0.05 at 1.0 of twice the strong phase."""
    early, final = 0.2, 0.05
    b = -early * math.log(final) / (1.0 + early * (math.log(early) - 1.0))
    c = b / early
    a = (math.e / early) ** b
    tau = time / (2.0 * strong_phase)
    shape: Array = a * tau**b * np.exp(-c * tau)
    return shape


def pulse(time: Array, centre: float, period: float, velocity: float) -> Array:
    """Return the ground acceleration of a Mavroeidis-Papageorgiou pulse with gamma = 2 and a phase of 90 degrees.

    That phase makes the pulse odd about its centre, so that its displacement ends where it began.
    """
    gamma, phase = 2.0, 0.5 * math.pi
    circular = 2.0 * math.pi / period
    since = time - centre
    inside = np.abs(since) <= 0.5 * gamma * period
    carrier = circular * since + phase
    bell = circular * since / gamma
    rate = -circular * (np.sin(carrier) * (1.0 + np.cos(bell)) + np.cos(carrier) * np.sin(bell) / gamma)
    return np.where(inside, 0.5 * velocity * rate, 0.0)


def end_state(acceleration: Array, dt: float) -> tuple[float, float]:
    """Return velocity and displacement at the last sample, exact for accelerations linear between samples."""
    increments = 0.5 * dt * (acceleration[1:] + acceleration[:-1])
    velocity = np.concatenate(([0.0], np.cumsum(increments)))
    steps = dt * velocity[:-1] + dt**2 * (2.0 * acceleration[:-1] + acceleration[1:]) / 6.0
    return float(velocity[-1]), float(np.sum(steps))


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
    frequency = 2.0 * np.pi * _frequencies(length, dt)
    values = np.empty(len(periods))
    for i, natural in enumerate(2.0 * np.pi / periods):
        transfer = natural**2 / (natural**2 - frequency**2 + 2j * DAMPING * natural * frequency)
        values[i] = np.max(np.abs(np.fft.irfft(transform * transfer, length)))
    return values


def _frequencies(length: int, dt: float) -> Array:
    """Return the frequencies (Hz) of a real Fourier transform."""
    return np.fft.rfftfreq(length, dt).astype(np.float64)


def _normals(source: random.Random, count: int) -> Array:
    """Return standard normal numbers by Box and Muller's formula: Python promises the stream of `random` only."""
    pairs = [(source.random(), source.random()) for _ in range((count + 1) // 2)]
    radius = np.sqrt(-2.0 * np.log(1.0 - np.array([p for p, _ in pairs])))
    angle = 2.0 * np.pi * np.array([q for _, q in pairs])
    return np.stack((radius * np.cos(angle), radius * np.sin(angle)), axis=1).ravel()[:count]


def _target(source: random.Random) -> Array:
    """Return a motion's own target at the matched periods: the shape times a lognormal wander."""
    log_period = np.log(MATCHED_PERIODS)
    covariance = np.exp(-0.5 * ((log_period[:, None] - log_period[None, :]) / SHAPE_CORRELATION) ** 2)
    factor = np.linalg.cholesky(covariance + 1e-6 * np.eye(len(log_period)))
    wander = SHAPE_SPREAD * factor @ _normals(source, len(log_period))
    level = LEVEL * math.exp(LEVEL_SPREAD * float(_normals(source, 1)[0]))
    return level * asce7_shape(MATCHED_PERIODS) * np.exp(wander)


def _coloured(noise: Array, dt: float) -> Array:
    """Filter white noise by Clough & Penzien's ground: 2.4 Hz and 60 % damping, high-passed at 0.24 Hz."""
    frequency = 2.0 * np.pi * _frequencies(len(noise), dt)
    ground, soft, damping = 15.0, 1.5, 0.6
    tajimi = (ground**2 + 2j * damping * ground * frequency) / (
        ground**2 - frequency**2 + 2j * damping * ground * frequency
    )
    high_pass = frequency**2 / (soft**2 - frequency**2 + 2j * damping * soft * frequency)
    return np.fft.irfft(np.fft.rfft(noise) * np.abs(tajimi * high_pass), len(noise))


def _corrected(motion: Array, dt: float, target: Array) -> Array:
    """Multiply the Fourier amplitudes by target over response spectrum, and take off both ends of the content."""
    ratio = np.log(target / spectrum(motion, dt, MATCHED_PERIODS))
    frequency = _frequencies(len(motion), dt)
    log_frequency = np.log(np.maximum(frequency, 1e-3))
    gain = np.exp(np.interp(log_frequency, -np.log(MATCHED_PERIODS[::-1]), ratio[::-1]))
    gain *= _ramp(frequency, *HIGH_PASS) * (1.0 - _ramp(frequency, *LOW_PASS))
    return np.fft.irfft(np.fft.rfft(motion) * gain, len(motion))


def _ramp(values: Array, low: float, high: float) -> Array:
    """Rise smoothly from 0 at `low` to 1 at `high`."""
    return np.sin(0.5 * np.pi * np.clip((values - low) / (high - low), 0.0, 1.0)) ** 2


def _high_passed(motion: Array, dt: float) -> Array:
    """Take off the longest periods once more, which a taper and a pulse bring back."""
    length = 2 * len(motion)  # zeros beside the motion keep it from wrapping round
    ramp = _ramp(_frequencies(length, dt), *HIGH_PASS)
    return np.fft.irfft(np.fft.rfft(motion, length) * ramp, length)[: len(motion)]


def _tapered(motion: Array, time: Array) -> Array:
    """Let the motion rise within 1.5 s and end within the last three."""
    return motion * _ramp(time, 0.0, 1.5) * _ramp(time[-1] - time, 0.0, 3.0)


def _at_rest_in_the_end(motion: Array, dt: float) -> Array:
    """Take off a smooth acceleration such that the final velocity and displacement vanish."""
    along = np.linspace(0.0, 1.0, len(motion))
    shapes = [np.sin(np.pi * along) ** 2, np.sin(np.pi * along) ** 2 * (along - 0.5)]
    ends = np.array([end_state(shape, dt) for shape in shapes]).T
    amounts = np.linalg.solve(ends, np.array(end_state(motion, dt)))
    corrected: Array = motion - amounts[0] * shapes[0] - amounts[1] * shapes[1]
    return corrected


def at2_text(record: Record) -> str:
    """Return the record as an .AT2 file in units of g, eight digits, labelled as synthetic in its first line."""
    rows = record.acceleration / STANDARD_GRAVITY + 0.0  # no minus sign before a zero
    header = (
        f"SYNTHETIC MOTION, NOT A RECORDING (seismass generator, version {GENERATOR_VERSION})",
        f"{record.event}, {record.station}, {record.component}",
        "ACCELERATION TIME SERIES IN UNITS OF G",
        f"NPTS= {record.samples:6d}, DT= {record.dt:9.5f} SEC",
    )
    lines = ("".join(f"{value:16.7E}" for value in rows[i : i + 5]) for i in range(0, len(rows), 5))
    return "\n".join((*header, *lines)) + "\n"


def write_suite(directory: Path, recipes: Iterable[Recipe] = RECIPES) -> None:
    """Write every motion as an .AT2 file, and the list suite.csv that names them in order."""
    directory.mkdir(parents=True, exist_ok=True)
    with (directory / "suite.csv").open("w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(("number", "event", "station", "file", "note"))
        for recipe in recipes:
            record = generate(recipe)
            (directory / f"{recipe.name}.AT2").write_text(at2_text(record), encoding="utf-8", newline="\n")
            rows.writerow((recipe.number, record.event, record.station, f"{recipe.name}.AT2", recipe.note))


if __name__ == "__main__":
    write_suite(Path(sys.argv[1]))
