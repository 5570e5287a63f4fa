"""The paper's section 4: three storeys with sliding blocks under the Brawley record, by three programs (Fig. 5).

The paper compared its model with ANSYS and PERFORM. Here the exact kernel stands beside OpenSees, whose results are
kept as data, and beside a program of our own that puts stiff elastic-plastic springs in the place of friction.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from itertools import product
from pathlib import Path
from typing import Any, Final

import numpy as np
import polars as pl

from seismass import _kernel
from seismass.base.arguments import Progress, ProgressLike
from seismass.base.errors import InvalidOption, SimulationError
from seismass.base.values import FloatArray, as_count, as_list, as_number, brief, refusal
from seismass.base.views import Card
from seismass.model.block import blocks_on_floors
from seismass.model.building import Building
from seismass.model.scene import Scene
from seismass.motions.motion import Motion
from seismass.motions.records import Record
from seismass.runs.simulate import simulate
from seismass.studies.validation.shaking_table import Band, Platform, check_components, label, robust_numbers

STOREYS: Final = 3
PERIOD: Final = 0.60
YIELD_SHEAR_OVER_WEIGHT: Final = (0.24, 0.20, 0.12)
MASS_RATIO: Final = 1.0
MU: Final = 0.3
"""The building of section 4: first period (s), V_y/W of the storeys, block over floor mass, friction coefficient."""
PEAK_G: Final = 0.7
"""Peak of the record in the comparison of programs (g); the paper does not give its scale."""
PEAKS_G: Final = (0.35, 0.5, 0.6, 0.7, 0.8, 0.9)
SECOND_SLOPES: Final = (0.02, 0.05, 0.1, 0.2, 0.5, 1.0)
"""Peaks (g) and second slopes r2 for which the paper's statements are checked; the paper states neither."""
COMPARED_SLOPES: Final = (0.05, 0.5)
"""Second slopes of the comparison of programs."""
SPRINGS: Final = ((1e2, 5), (1e3, 20), (1e4, 50), (1e5, 200))
"""Stiffness of friction springs over that of storey 1, and steps per sample interval, of the stiff-spring variant."""
EXACT: Final = "exact kernel"
FRICTION_SPRINGS: Final = "friction springs"
OPENSEES: Final = "OpenSees"
_NOTHING: Final = np.zeros((0, STOREYS))
KEPT: Final = Path(__file__).parent / "opensees.parquet"


@dataclass(frozen=True, eq=False)
class Histories(Card):
    """Response by one program.

    Attributes
    ----------
    program, setting : str
        Which, and how it was run.
    component : str
        Component of the record.
    second_slope : float
        Second slope r2.
    every : int
        Sample intervals between two instants of the histories.
    time : ndarray, shape (instants,)
        Instants (s).
    drift, slip : ndarray, shape (instants, 3)
        Drift of the storeys and slip of the blocks (m).
    """

    program: str
    setting: str
    component: str
    second_slope: float
    every: int
    time: FloatArray = field(repr=False)
    drift: FloatArray = field(repr=False)
    slip: FloatArray = field(repr=False)


@dataclass(frozen=True, eq=False)
class Section4(Card):
    """What the section-4 building does.

    Attributes
    ----------
    runs : polars.DataFrame
        One row per component, second slope and peak of the record: yields of each storey, `all_yield`, peak drifts and
        slips (m), `slides_most` (the floor with the largest slip, null where no block slides).
    differences : polars.DataFrame
        One row per component, second slope, program and setting: the largest difference of the histories from those of
        the exact kernel, in mm and in percent of the largest drift, or slip, of the building; null where the program
        did not converge.
    histories : tuple of Histories
        Histories of the comparison.
    synthetic : bool
        Whether a built-in motion stands in for the recording.
    """

    runs: pl.DataFrame
    differences: pl.DataFrame
    histories: tuple[Histories, ...]
    synthetic: bool

    def of(self, component: str, second_slope: float) -> tuple[Histories, ...]:
        """Return the histories of one run by all programs, the exact kernel first."""
        return tuple(
            item for item in self.histories if item.component == component and item.second_slope == second_slope
        )


def section4_scene(second_slope: float) -> Scene:
    """Return the building of section 4 with its blocks.

    Parameters
    ----------
    second_slope : float
        Second slope r2 of the storeys over the first. The paper does not give it.
    """
    building = Building.uniform(
        STOREYS, PERIOD, yield_shear_over_weight=YIELD_SHEAR_OVER_WEIGHT, second_slope=second_slope
    )
    return Scene(building, blocks_on_floors([MASS_RATIO] * STOREYS, mu=MU))


def samples_digest(record: Record) -> str:
    """Return a digest of the samples of a record and their step."""
    return hashlib.sha256(record.acceleration.tobytes() + np.float64(record.dt).tobytes()).hexdigest()


SPRINGS_ARE: Final = "a list of ratios and numbers of steps"


def _checked_spring(pair: Any) -> tuple[float, int]:
    """Return a stiffness ratio and a number of steps."""
    if not isinstance(pair, tuple | list) or len(pair) != 2:
        raise refusal(InvalidOption, "springs", "validation", SPRINGS_ARE, brief(pair))
    ratio = as_number(pair[0], "springs", "validation", InvalidOption)
    return ratio, as_count(pair[1], "springs", "validation", InvalidOption, least=1)


def section4(
    components: Sequence[Record],
    *,
    springs: Sequence[tuple[float, int]] = SPRINGS,
    progress: ProgressLike = None,
) -> Section4:
    """Solve the building of section 4 for all components, peaks and second slopes, and compare the programs.

    Parameters
    ----------
    components : sequence of Record
        Components of the Brawley record, unscaled, or a stand-in.
    springs : sequence of (float, int), optional
        Stiffness of friction springs over that of storey 1, and steps per sample interval; the stiffest takes most of
        the time.
    progress : callable, optional
        Called with (histories solved, histories in all), before the first and after each.

    Returns
    -------
    Section4
        Runs, differences and histories. OpenSees has its part where its kept results are of these samples.
    """
    records = check_components(components)
    pairs = [_checked_spring(pair) for pair in as_list(springs, "springs", "validation", InvalidOption, SPRINGS_ARE)]
    compared = list(product(records, COMPARED_SLOPES))
    whole = Progress(progress, len(compared) * (1 + len(pairs)), "validation")
    whole.tell(0)
    grid = product(records, SECOND_SLOPES, PEAKS_G)
    runs = [_run(label(record), record, slope, peak) for record, slope, peak in grid]
    histories: list[Histories] = []
    differences: list[dict[str, Any]] = []
    for record, slope in compared:
        exact = _exact(record, slope)
        whole.tell()
        others: list[Histories] = []
        for ratio, steps in pairs:
            others.append(_springs(record, slope, ratio, steps))
            whole.tell()
        others += _opensees(record, slope)
        histories += [exact, *(item for item in others if item.time.size)]
        differences += [_difference(item, exact) for item in others]
    return Section4(
        pl.DataFrame(runs),
        pl.DataFrame(differences, schema=_DIFFERENCES),
        tuple(histories),
        any(record.synthetic for record in records),
    )


_DIFFERENCES: Final[Any] = {
    "component": pl.String,
    "second_slope": pl.Float64,
    "program": pl.String,
    "setting": pl.String,
    "drift_mm": pl.Float64,
    "drift_percent": pl.Float64,
    "slip_mm": pl.Float64,
    "slip_percent": pl.Float64,
}


def _run(component: str, record: Record, second_slope: float, peak_g: float) -> dict[str, Any]:
    response = simulate(section4_scene(second_slope), record.scaled(peak_g / record.pga_g))
    yields = response.events.filter(kind="yield")["number"]
    counts = [int((yields == storey).sum()) for storey in range(1, STOREYS + 1)]
    slip = response.peak_slip
    return {
        "component": component,
        "second_slope": second_slope,
        "peak_g": peak_g,
        "yields": counts,
        "all_yield": all(counts),
        "peak_drift": response.peak_drift.tolist(),
        "peak_slip": slip.tolist(),
        "slides_most": int(slip.argmax()) + 1 if slip.max() > 0.0 else None,
    }


def _scaled(record: Record) -> Motion:
    """The record with the peak of the comparison."""
    return record.scaled(PEAK_G / record.pga_g).motion


def _exact(record: Record, second_slope: float) -> Histories:
    motion = _scaled(record)
    response = simulate(section4_scene(second_slope), motion, histories=True)
    return Histories(EXACT, "", label(record), second_slope, 1, motion.time, response.drift, response.slip)


def _springs(record: Record, second_slope: float, ratio: float, substeps: int) -> Histories:
    """Histories with friction springs, without an instant where Newton's method did not converge."""
    motion = _scaled(record)
    scene = section4_scene(second_slope)
    time, drift, slip = motion.time, _NOTHING, _NOTHING
    try:
        result = _kernel.integrate_reference(
            scene._kernel, motion._kernel, "friction_springs", substeps, stiffness_ratio=ratio
        )
        drift, slip = result.drift, result.slip
    except SimulationError:
        time = time[:0]
    return Histories(
        FRICTION_SPRINGS, setting_label(ratio, substeps), label(record), second_slope, 1, time, drift, slip
    )


def _opensees(record: Record, second_slope: float) -> Iterator[Histories]:
    """Histories of OpenSees, where they are kept for these samples."""
    for row in opensees_results().filter(samples=samples_digest(record), second_slope=second_slope).rows(named=True):
        drift, slip = (np.array(row[name], dtype=np.float64).reshape(-1, STOREYS) for name in ("drift", "slip"))
        setting = setting_label(row["stiffness_ratio"], row["substeps"])
        time = np.asarray(np.arange(len(drift)) * (row["every"] * row["dt"]), dtype=np.float64)
        yield Histories(OPENSEES, setting, label(record), second_slope, row["every"], time, drift, slip)


def setting_label(ratio: float, substeps: int) -> str:
    """Return what tables call a stiffness of friction springs over that of storey 1, and a step."""
    return f"{ratio:.0e} k, dt / {substeps}".replace("e+0", "e")


@cache
def opensees_results() -> pl.DataFrame:
    """Return the kept results of OpenSees, one row per component, second slope and setting; `every` is sample intervals
    between kept instants, drift and slip (m) are instants times storeys, peaks those of all steps.
    """
    return pl.read_parquet(KEPT)


def _difference(item: Histories, exact: Histories) -> dict[str, Any]:
    row: dict[str, Any] = {
        "component": item.component,
        "second_slope": item.second_slope,
        "program": item.program,
        "setting": item.setting,
    }
    for name in ("drift", "slip"):
        row[f"{name}_mm"] = row[f"{name}_percent"] = None
        if not item.time.size:
            continue
        true: FloatArray = getattr(exact, name)
        largest = float(np.abs(true).max())
        difference = float(np.abs(getattr(item, name) - true[:: item.every]).max())
        row[f"{name}_mm"] = 1e3 * difference
        row[f"{name}_percent"] = 100.0 * difference / largest if largest > 0.0 else None
    return row


MOST_INSTANTS: Final = 1000
"""Most instants that are kept of a history, for figures: a few dozen in a period."""
DRAWN_PROGRAMS: Final = (EXACT, OPENSEES, FRICTION_SPRINGS)
"""Programs whose histories are drawn, of a later one on top."""
_BAND: Final = ("low", "high", "central", "attached")
_LISTS: Final = ("yields", "peak_drift", "peak_slip")


def section4_tables(section4: Section4) -> dict[str, pl.DataFrame]:
    """Return `section4_runs`, `section4_differences` and `section4_histories`, without lists in their cells."""
    flat = [pl.col(name).list.get(i).alias(f"{name}_{i + 1}") for name in _LISTS for i in range(STOREYS)]
    histories = [_history_table(item) for item in stiffest(section4.histories)]
    return {
        "section4_runs": section4.runs.with_columns(flat).drop(_LISTS),
        "section4_differences": section4.differences,
        "section4_histories": pl.concat(histories),
    }


def section4_of(tables: Mapping[str, pl.DataFrame], *, synthetic: bool) -> Section4:
    """Return the comparison of programs of its tables; its histories are those that are drawn."""
    runs = tables["section4_runs"].with_columns(
        pl.concat_list([f"{name}_{i + 1}" for i in range(STOREYS)]).alias(name) for name in _LISTS
    )
    keys = ("program", "setting", "component", "second_slope", "every")
    histories = [
        Histories(
            program,
            setting,
            component,
            second_slope,
            every,
            rows["time"].to_numpy(),
            rows.select(f"drift_{i + 1}" for i in range(STOREYS)).to_numpy(),
            rows.select(f"slip_{i + 1}" for i in range(STOREYS)).to_numpy(),
        )
        for (program, setting, component, second_slope, every), rows in tables["section4_histories"].group_by(
            *keys, maintain_order=True
        )
    ]
    return Section4(runs, tables["section4_differences"], tuple(histories), synthetic)


def platform_tables(platform: Platform) -> dict[str, pl.DataFrame]:
    """Return `platform_runs`, and `platform_bands` at no more instants than figures need."""
    return {
        "platform_runs": platform.runs,
        "platform_bands": pl.concat([_band_table(band) for band in platform.bands]),
    }


def platform_of(tables: Mapping[str, pl.DataFrame], *, synthetic: bool) -> Platform:
    """Return the platform of its tables."""
    bands = [
        Band(component, ratio, rows["time"].to_numpy(), *(rows[name].to_numpy() for name in _BAND))
        for (component, ratio), rows in tables["platform_bands"].group_by(
            "component", "mass_ratio", maintain_order=True
        )
    ]
    runs = tables["platform_runs"]
    return Platform(runs, tuple(bands), robust_numbers(runs), synthetic)


def stiffest(histories: Iterable[Histories]) -> list[Histories]:
    """Return of each run the histories by the programs that are drawn, each with its last setting."""
    last = {(item.component, item.second_slope, item.program): item for item in histories if item.time.size}
    runs = dict.fromkeys(key[:2] for key in last)
    return [last[*run, program] for run in runs for program in DRAWN_PROGRAMS if (*run, program) in last]


def _history_table(item: Histories) -> pl.DataFrame:
    rows = slice(None, None, max(1, math.ceil(len(item.time) / MOST_INSTANTS)))
    values = {f"{name}_{i + 1}": getattr(item, name)[rows, i] for name in ("drift", "slip") for i in range(STOREYS)}
    frame = pl.DataFrame({"time": item.time[rows], **values})
    keys = {name: getattr(item, name) for name in ("component", "second_slope", "program", "setting", "every")}
    return frame.select(*(pl.lit(value).alias(name) for name, value in keys.items()), pl.all())


def _band_table(band: Band) -> pl.DataFrame:
    """The band with its least and largest drift over each window of instants."""
    every = max(1, math.ceil(len(band.time) / MOST_INSTANTS))
    starts = np.arange(0, len(band.time), every)
    ends: dict[str, FloatArray] = {
        "low": np.minimum.reduceat(band.low, starts),
        "high": np.maximum.reduceat(band.high, starts),
    }
    frame = pl.DataFrame(
        {"time": band.time[starts], **ends, **{name: getattr(band, name)[starts] for name in ("central", "attached")}}
    )
    return frame.select(
        pl.lit(band.component).alias("component"), pl.lit(band.mass_ratio).alias("mass_ratio"), pl.all()
    )
