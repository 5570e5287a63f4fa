"""The eleven motions of the built-in suite: the recipes, and the generators that made them, seven by version 1.

Method of version 1
-------------------
1. Gaussian white noise times the envelope of Saragoni & Hart (1974) as parametrised by Boore (2003, Pure Appl. Geophys.
   160:635, eqs. 6-9), coloured by the filter of Clough & Penzien (Kanai-Tajimi and a high-pass oscillator).
2. Its Fourier amplitudes are corrected towards a target response spectrum, phases kept (`shaping`). Each motion has a
   target of its own: the two-period shape of ASCE 7 times a smooth lognormal wander over period.
3. Some motions carry a velocity pulse of Mavroeidis & Papageorgiou (`near_fault`).
4. A taper and a baseline correction that ends the motion at rest at its starting place (`ends`).

Stationary frequency content except for the pulse, one component, no source, path or site behind it.

Method of version 2, motions 8 to 11
------------------------------------
1. White noise through a filter whose frequency changes over time, modulated in intensity (`process`), after two quiet
   seconds.
2. The motion is the high-passed process plus the near-fault pulse, where there is one. The Fourier amplitudes of the
   process alone are corrected such that the spectrum of the whole comes near the motion's target, as above. Phases
   stay, and with them the course of intensity and frequency over time; the pulse stays as it is.
3. Taper and baseline as above. The accelerations are rounded to 1e-7 g, as the files have them.
"""

from __future__ import annotations

import csv
import io
import math
import random
from collections.abc import Iterable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from seismass.base.files import write_file
from seismass.base.units import STANDARD_GRAVITY
from seismass.motions.records.builtin import MICRO
from seismass.motions.records.record import Record
from seismass.motions.records.synthetic.process import (
    HIGH_PASS,
    LEVEL,
    LEVEL_SPREAD,
    LOW_PASS,
    MATCHED_PERIODS,
    SHAPE_CORRELATION,
    SHAPE_SPREAD,
    NearFaultPulse,
    SyntheticParameters,
    asce7_shape,
    at_rest_in_the_end,
    filtered_noise,
    frequencies,
    gain_over_frequency,
    high_passed,
    normals,
    parameters_text,
    pulse,
    ramp,
    sample_times,
    shaped,
    spectrum,
    tapered,
)
from seismass.motions.records.synthetic.scenarios import SCENARIOS, generate_scenario, generate_second, seed_of

if TYPE_CHECKING:
    import polars as pl


Array = NDArray[np.float64]

CORRECTIONS_OF_SEVEN: Final = 5
CORRECTIONS: Final = 6
LARGEST_GAIN: Final = 3.0
"""Largest factor by which one correction raises or lowers an amplitude."""

QUIET: Final = 2.0
"""Time (s) before the process, or the strong phase, sets in, for the slow precursors of filters without phase."""

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
    target = _target_of_seven(source)
    noise = normals(source, count) * envelope(np.maximum(time - QUIET, 0.0), recipe.strong_phase)
    motion = _coloured(noise, recipe.dt)
    for _ in range(CORRECTIONS_OF_SEVEN):
        motion = _corrected(motion, recipe.dt, target)
    if recipe.pulse_period is not None:
        motion = motion + pulse(time, QUIET + 0.4 * recipe.strong_phase, recipe.pulse_period, recipe.pulse_velocity)
    motion = tapered(_high_passed(tapered(motion, time), recipe.dt), time)
    motion = at_rest_in_the_end(motion, recipe.dt)
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


def _target_of_seven(source: random.Random) -> Array:
    """Return a motion's own target at the matched periods: the shape times a lognormal wander."""
    log_period = np.log(MATCHED_PERIODS)
    covariance = np.exp(-0.5 * ((log_period[:, None] - log_period[None, :]) / SHAPE_CORRELATION) ** 2)
    factor = np.linalg.cholesky(covariance + 1e-6 * np.eye(len(log_period)))
    wander = SHAPE_SPREAD * factor @ normals(source, len(log_period))
    level = LEVEL * math.exp(LEVEL_SPREAD * float(normals(source, 1)[0]))
    return level * asce7_shape(MATCHED_PERIODS) * np.exp(wander)


def _coloured(noise: Array, dt: float) -> Array:
    """Filter white noise by Clough & Penzien's ground: 2.4 Hz and 60 % damping, high-passed at 0.24 Hz."""
    frequency = 2.0 * np.pi * frequencies(len(noise), dt)
    ground, soft, damping = 15.0, 1.5, 0.6
    tajimi = (ground**2 + 2j * damping * ground * frequency) / (
        ground**2 - frequency**2 + 2j * damping * ground * frequency
    )
    high_pass = frequency**2 / (soft**2 - frequency**2 + 2j * damping * soft * frequency)
    return np.fft.irfft(np.fft.rfft(noise) * np.abs(tajimi * high_pass), len(noise))


def _corrected(motion: Array, dt: float, target: Array) -> Array:
    """Multiply the Fourier amplitudes by target over response spectrum, and take off both ends of the content."""
    ratio = np.log(target / spectrum(motion, dt, MATCHED_PERIODS))
    frequency = frequencies(len(motion), dt)
    gain = gain_over_frequency(ratio, frequency)
    gain *= ramp(frequency, *HIGH_PASS) * (1.0 - ramp(frequency, *LOW_PASS))
    return np.fft.irfft(np.fft.rfft(motion) * gain, len(motion))


def _high_passed(motion: Array, dt: float) -> Array:
    """Take off the longest periods once more, which a taper and a pulse bring back."""
    length = 2 * len(motion)  # zeros beside the motion keep it from wrapping round
    gain = ramp(frequencies(length, dt), *HIGH_PASS)
    return np.fft.irfft(np.fft.rfft(motion, length) * gain, length)[: len(motion)]


ALL_RECIPES: Final = (*RECIPES, *SITE_RECIPES)

LISTS: Final = {"seven.csv": RECIPES, "suite.csv": ALL_RECIPES}
"""Lists of motions and what they name, in order."""


def version(recipe: Recipe | SiteRecipe) -> int:
    """Return the version of the generator that a recipe is for, as the first line of its file gives it."""
    return 1 if isinstance(recipe, Recipe) else 2


def made(recipe: Recipe | SiteRecipe) -> Record:
    """Make the motion of a recipe."""
    return generate(recipe) if isinstance(recipe, Recipe) else generate_site(recipe)


def at2_text(record: Record, generator: int = 1) -> str:
    """Return the record as .AT2 in g, labelled as synthetic in its first line. Version 1 has eight digits of a number,
    version 2 seven decimals: 1e-7 g is far above differences between machines.
    """
    rows = record.acceleration / STANDARD_GRAVITY + 0.0  # no minus sign before a zero
    if generator > 1:
        rows = rows.round(7) + 0.0
    header = (
        f"SYNTHETIC MOTION, NOT A RECORDING (seismass generator, version {generator})",
        f"{record.event}, {record.station}, {record.component}",
        "ACCELERATION TIME SERIES IN UNITS OF G",
        f"NPTS= {record.samples:6d}, DT= {record.dt:9.5f} SEC",
    )
    form = "16.7E" if generator == 1 else "12.7f"
    lines = ("".join(f"{value:{form}}" for value in rows[i : i + 5]) for i in range(0, len(rows), 5))
    return "\n".join((*header, *lines)) + "\n"


def write_motion(directory: Path, recipe: Recipe | SiteRecipe) -> None:
    """Write the motion of a recipe as an .AT2 file."""
    write_file(directory / f"{recipe.name}.AT2", at2_text(made(recipe), version(recipe)))


def write_list(file: Path, recipes: Iterable[Recipe | SiteRecipe]) -> None:
    """Write a list of motions as `read_suite` takes it."""
    stream = io.StringIO(newline="")
    rows = csv.writer(stream, lineterminator="\n")
    rows.writerow(("number", "event", "station", "file", "note"))
    rows.writerows((recipe.number, "synthetic", "none", f"{recipe.name}.AT2", recipe.note) for recipe in recipes)
    write_file(file, stream.getvalue())


def forty_table() -> pl.DataFrame:
    """Make the forty motions: a row each, with its class and its samples as whole numbers of 1e-6 g."""
    import polars as pl

    rows = []
    for scenario in SCENARIOS:
        record = generate_scenario(scenario)
        samples = _stored(record)
        row = {name: getattr(scenario, name) for name in ("name", "seed", "magnitude", "distance", "site", "note")}
        rows.append({**row, "parameters": record.remarks[1], "dt": record.dt, "acceleration": samples})
    return pl.DataFrame(rows, schema_overrides={"acceleration": pl.List(pl.Int32)})


def seconds_table() -> pl.DataFrame:
    """Make the second components of the forty: a row each, with the name of the first and its samples as of that."""
    import polars as pl

    rows = []
    for scenario in SCENARIOS:
        record = generate_second(scenario)
        labels = {"name": record.name, "first": scenario.name, "seed": seed_of(scenario), "note": record.remarks[0]}
        rows.append({**labels, "parameters": record.remarks[1], "dt": record.dt, "acceleration": _stored(record)})
    return pl.DataFrame(rows, schema_overrides={"acceleration": pl.List(pl.Int32)})


def _stored(record: Record) -> NDArray[np.int32]:
    """Samples as whole numbers of 1e-6 g."""
    return np.rint(record.acceleration / (MICRO * STANDARD_GRAVITY)).astype(np.int32)


def write_suite(directory: Path) -> None:
    """Write every motion as an .AT2 file, the lists that name them, and the tables of the forty and their seconds."""
    directory.mkdir(parents=True, exist_ok=True)
    for recipe in ALL_RECIPES:
        write_motion(directory, recipe)
    for name, recipes in LISTS.items():
        write_list(directory / name, recipes)
    for name, table in (("forty.parquet", forty_table()), ("forty_second.parquet", seconds_table())):
        write_file(directory / name, partial(table.write_parquet, compression="zstd", compression_level=19))
