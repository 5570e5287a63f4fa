"""The paper's shaking table (Fig. 4): a platform at 1:15 with a sliding block, under the compressed Erzincan record.

The paper gives the mass ratios of the block and that the platform stayed elastic, but neither its period and damping
nor the friction. They are varied here, to separate what depends on them from what does not.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import product
from typing import Any, Final, Literal, TypeAlias

import numpy as np
import polars as pl

from seismass.base.arguments import as_word
from seismass.base.errors import InvalidMotion
from seismass.base.statistics import quantile
from seismass.base.values import FloatArray, as_list, as_one_of, brief, refusal
from seismass.base.views import Card
from seismass.model.block import blocks_on_floors
from seismass.model.building import Building
from seismass.model.scene import Scene
from seismass.motions.records import Record, Suite, builtin_record, read_suite
from seismass.runs.batch import solve_many
from seismass.runs.simulate import simulate

Station: TypeAlias = Literal["Brawley Airport", "Erzincan"]
"""Stations of records 3 and 5 of the paper's Table 1."""

STAND_INS: Final[dict[Station, str]] = {"Brawley Airport": "synthetic-3", "Erzincan": "synthetic-5"}
"""Built-in motion that is used where there is no recording of a station."""


def components(station: Station, suite: Suite | None = None) -> tuple[Record, ...]:
    """Return the horizontal components of a station, or its stand-in.

    Parameters
    ----------
    station : {"Brawley Airport", "Erzincan"}
        The station.
    suite : Suite, optional
        Recordings. Where one is of the station, other components of it in the same folder are read too.

    Returns
    -------
    tuple of Record
        In the order of their names. The stand-in alone, which is synthetic, where the suite has no such recording.

    Raises
    ------
    RecordFormatError
        As for `read_suite`.
    """
    as_word(station, STAND_INS, "station", "validation")
    as_one_of(suite, (Suite, type(None)), "suite", "validation", InvalidMotion)
    records: dict[str, Record] = {}
    for record in suite or ():
        if record.station != station or record.synthetic:
            continue
        records[record.name] = record
        if record.source is not None:
            records_beside = read_suite(record.source.parent)
            records |= {other.name: other for other in records_beside if other.station == station}
    if not records:
        return (builtin_record(STAND_INS[station]),)
    return tuple(records[name] for name in sorted(records))


def label(record: Record) -> str:
    """Return what tables call a component: its direction, or the name of a built-in motion."""
    return record.name if record.synthetic else record.component or record.name


LENGTH_RATIO: Final = 15.0
MASS_RATIOS: Final = (1.51, 1.77)
"""Length of the prototype over that of the model, and mass of the block over that of the platform, of the paper."""
PERIODS: Final = tuple(round(0.05 + 0.025 * step, 3) for step in range(11))
"""Periods of the platform alone (s): 0.05 to 0.30, 0.19 to 1.16 s at full scale."""
FRICTIONS: Final = (0.2, 0.25, 0.3, 0.35, 0.4)
DAMPINGS: Final = (0.01, 0.02, 0.05)
AMPLITUDES: Final = (1.0, 1.5)
"""Friction coefficients, damping ratios of the platform alone, and factors of the accelerations."""
CENTRAL: Final = (0.15, 0.3, 0.02, 1.0)
"""Period, friction coefficient, damping ratio and amplitude of the histories in the middle of the band."""
ATTACHED_MU: Final = 1e3
"""Friction coefficient that no acceleration overcomes."""


@dataclass(frozen=True, eq=False)
class Band(Card):
    """Drift histories with one mass ratio, at the central period and amplitude.

    Attributes
    ----------
    component : str
        Component of the record.
    mass_ratio : float
        Mass of the block over that of the platform.
    time : ndarray, shape (samples,)
        Time of the model (s).
    low, high : ndarray, shape (samples,)
        Least and largest drift over all friction coefficients and damping ratios (m).
    central, attached : ndarray, shape (samples,)
        Drift with the central values, and with the block attached (m).
    """

    component: str
    mass_ratio: float
    time: FloatArray = field(repr=False)
    low: FloatArray = field(repr=False)
    high: FloatArray = field(repr=False)
    central: FloatArray = field(repr=False)
    attached: FloatArray = field(repr=False)


@dataclass(frozen=True, eq=False)
class Platform(Card):
    """What the platform does over the ranges.

    Attributes
    ----------
    runs : polars.DataFrame
        One row per component, mass ratio, period, friction coefficient, damping ratio and amplitude: `peak_drift`,
        `peak_slip` and, with the block attached, `attached_drift` (m).
    bands : tuple of Band
        Histories, per component and mass ratio.
    robust : dict
        What the ranges do, computed from the runs; see `robust_numbers`.
    synthetic : bool
        Whether a built-in motion stands in for the recording.
    """

    runs: pl.DataFrame
    bands: tuple[Band, ...]
    robust: dict[str, Any]
    synthetic: bool


def platform_scene(mass_ratio: float, period: float, mu: float, damping: float) -> Scene:
    """Return the platform, elastic, with its block.

    Parameters
    ----------
    mass_ratio : float
        Mass of the block over that of the platform.
    period : float
        Period of the platform without the block (s).
    mu : float
        Friction coefficient, static and kinetic.
    damping : float
        Damping ratio of the platform without the block.
    """
    return Scene(Building.uniform(1, period, damping=damping), blocks_on_floors([mass_ratio], mu=mu))


def check_components(components: Sequence[Record]) -> list[Record]:
    """Return the components of a station, at least one."""
    requirement = "a list of at least one Record"
    records = as_list(components, "components", "validation", InvalidMotion, requirement)
    if not records or not all(isinstance(record, Record) for record in records):
        raise refusal(InvalidMotion, "components", "validation", requirement, brief(components))
    return records


def platform(components: Sequence[Record]) -> Platform:
    """Solve the platform over the ranges.

    Parameters
    ----------
    components : sequence of Record
        Components of the Erzincan record at full scale, or a stand-in. The time step is divided by sqrt(15).

    Returns
    -------
    Platform
        Runs, bands of histories, and what does not depend on the ranges.
    """
    records = check_components(components)
    models = [record.similitude(LENGTH_RATIO) for record in records]
    runs = _runs(models)
    bands = [_band(model, ratio) for model, ratio in product(models, MASS_RATIOS)]
    return Platform(runs, tuple(bands), robust_numbers(runs), any(record.synthetic for record in records))


def _runs(models: Sequence[Record]) -> pl.DataFrame:
    grid = list(product(MASS_RATIOS, PERIODS, (*FRICTIONS, ATTACHED_MU), DAMPINGS))
    scenes = [platform_scene(*values) for values in grid]
    driven = [(label(model), factor, model.scaled(factor).motion) for model, factor in product(models, AMPLITUDES)]
    table = solve_many(scenes, [motion for *_, motion in driven])
    rows = [
        {"component": name, "mass_ratio": ratio, "period": period, "mu": mu, "damping": damping, "amplitude": factor}
        for (ratio, period, mu, damping), (name, factor, _) in product(grid, driven)
    ]
    solved = pl.DataFrame(rows).with_columns(
        peak_drift=table["peak_drift"].list.first(), peak_slip=table["peak_slip"].list.first()
    )
    keys = ["component", "mass_ratio", "period", "damping", "amplitude"]
    attached = solved.filter(mu=ATTACHED_MU).select(*keys, attached_drift="peak_drift")
    return solved.filter(pl.col("mu") != ATTACHED_MU).join(attached, on=keys, maintain_order="left")


def _band(model: Record, mass_ratio: float) -> Band:
    period, mu, damping, amplitude = CENTRAL
    motion = model.scaled(amplitude).motion

    def drift(mu: float, damping: float) -> FloatArray:
        response = simulate(platform_scene(mass_ratio, period, mu, damping), motion, histories=True)
        assert response.drift is not None
        return response.drift[:, 0]

    every = np.array([drift(*values) for values in product(FRICTIONS, DAMPINGS)])
    return Band(
        component=label(model),
        mass_ratio=mass_ratio,
        time=motion.time,
        low=every.min(axis=0),
        high=every.max(axis=0),
        central=drift(mu, damping),
        attached=drift(ATTACHED_MU, damping),
    )


def robust_numbers(runs: pl.DataFrame) -> dict[str, Any]:
    """Return what the runs of `Platform.runs` have in common and what decides between them: shares that slide,
    fractiles of drift over that with attached block, and mean ranges by period, mu, damping and amplitude.
    """
    sliding = runs.filter(pl.col("peak_slip") > 0.0)
    ratio = sliding["peak_drift"] / sliding["attached_drift"]
    keys = ["component", "period", "mu", "damping", "amplitude"]
    drifts = ["peak_drift", "attached_drift", "peak_slip"]
    lighter, heavier = (runs.filter(mass_ratio=value).select(*keys, *drifts) for value in MASS_RATIOS)
    both = lighter.join(heavier, on=keys, suffix="_heavier")
    both = both.filter((pl.col("peak_slip") > 0.0) & (pl.col("peak_slip_heavier") > 0.0))
    varied = ("period", "mu", "damping", "amplitude")
    return {
        "runs": runs.height,
        "slides": sliding.height,
        "below_attached": int((ratio < 1.0).sum()),
        "over_attached": _fractiles(ratio),
        "heavier": _fractiles(both["peak_drift_heavier"] / both["peak_drift"]),
        "heavier_attached": _fractiles(both["attached_drift_heavier"] / both["attached_drift"]),
        **{f"by_{name}": _spread(runs, name) for name in varied},
    }


def _fractiles(values: pl.Series) -> list[float]:
    """5, 50 and 95 % fractiles."""
    return [float(quantile(values.to_numpy(), share)) for share in (0.05, 0.5, 0.95)]


def _spread(runs: pl.DataFrame, name: str) -> float:
    """Geometric mean over all else of the largest peak drift over the least along one range."""
    keys = [key for key in ("component", "mass_ratio", "period", "mu", "damping", "amplitude") if key != name]
    ratio = runs.group_by(keys).agg(ratio=pl.col("peak_drift").max() / pl.col("peak_drift").min())["ratio"]
    return float(np.exp(np.log(ratio.sort().to_numpy()).mean()))
